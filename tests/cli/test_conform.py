"""``burnish conform``: the table, the report, and what counts as a pass."""

from __future__ import annotations

import json
import os
import re
import sys
from collections.abc import Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest

from burnish.commands import judge
from burnish.commands.compared import subjects_in
from burnish.compiler.reference.picture import Expected
from burnish.targets.conformance import contents
from burnish.targets.runner import routes
from burnish.targets.runner.reference import remembered
from burnish.targets.toolchain import tools
from burnish.targets.toolchain.tools import Tool, ToolState, tool_named

from ..suite import browsers
from .kit import invoke, tree

UP = "material Up { color = 0.5 + 0.5 * normal }\n"
NUMBER = r"\d\.\d[eE][-+]\d\d"


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder with a material."""
    monkeypatch.chdir(tmp_path)
    Path("m.burnish").write_text(UP)
    return tmp_path


def test_agreement() -> None:
    """A heading for each material, a line for each route, and what drew; nothing else."""
    result = invoke("conform", "m.burnish", "--routes", "llvmpipe:gl330,lavapipe:glsl")
    assert (result.exit_code, result.stderr) == (0, "")
    table, told = result.stdout.split("\n\n")
    heading, material, *rows = table.splitlines()
    assert heading == (
        "  route           result         max |difference|  of bound  bound in steps  unproven"
    )
    assert material == "m.burnish: Up"
    assert [row.split()[0] for row in rows] == ["lavapipe:glsl", "llvmpipe:gl330"]
    for row in rows:
        line = rf"  \S+ +agrees         {NUMBER} {{11}}\d+% {{5,8}}\d+ {{5,16}}\d+ of \d{{4,}}"
        assert re.fullmatch(line, row), row
    lavapipe, llvmpipe, tools, count = told.splitlines()
    assert re.fullmatch(r"drawn by lavapipe: llvmpipe \(LLVM .*\), Mesa [\d.]+.*", lavapipe)
    assert re.fullmatch(r"drawn by llvmpipe: llvmpipe \(LLVM .*\), .* Mesa [\d.]+", llvmpipe)
    assert re.fullmatch(r"with glslang [\d.]+, lavapipe .*, moderngl .*, vulkan-val\S+ \S+", tools)
    assert count == "2 agree"


def test_a_file_whose_name_is_no_text(folder: Path) -> None:
    name = os.fsdecode(b"caf\xe9.burnish")
    try:
        (folder / name).write_text(UP)
    except OSError:
        pytest.skip("this file system has no such names")
    result = invoke("conform", name, "--routes", "llvmpipe:gl330", "--report", "report")
    assert (result.exit_code, result.stderr) == (0, "")
    assert r"caf\xe9.burnish: Up" in result.stdout
    (row,) = json.loads((folder / "report" / "report.json").read_text("utf-8"))["rows"]
    assert row["material"] == r"caf\xe9.burnish: Up"


def test_without_hoisting() -> None:
    """The shaders compute by themselves what a host would have, and draw the same."""
    Path("m.burnish").write_text(
        "material Up { param tilt : angle = 20deg  color = 0.5 + 0.5 * cos(tilt) * normal }\n"
    )
    result = invoke("conform", "m.burnish", "--routes", "lavapipe:glsl", "--no-hoist")
    assert (result.exit_code, result.stderr) == (0, "")


def test_rigs_and_passes() -> None:
    """All that the file declares, or those that are named."""
    Path("m.burnish").write_text(
        "import std.lights.{Point}\nimport std.terms.{lambert}\n"
        "material Wall { color = lambert(vec3(1)) }\n"
        "rig Day { sun : Point }\nrig Dusk { moon : Point }\n"
        "pass Cut : Forward { discard when alpha < 0.5 }\n"
    )
    result = invoke("conform", "m.burnish", "--routes", "llvmpipe:gl330")
    headings = re.findall(r"^m\.burnish: .*", result.stdout, re.MULTILINE)
    assert headings == [
        "m.burnish: Wall × Day", "m.burnish: Wall × Day × Cut",
        "m.burnish: Wall × Dusk", "m.burnish: Wall × Dusk × Cut",
    ]  # fmt: skip
    assert result.stdout.endswith("\n4 agree\n")
    result = invoke(
        "conform", "m.burnish", "--routes", "llvmpipe:gl330", "--rig", "Day", "--pass", "Cut"
    )
    assert "m.burnish: Wall × Day × Cut\n" in result.stdout
    assert result.stdout.endswith("\n1 agrees\n")


GLOW = """\
material Plain { color = vec3(0.5) }
material Lit { glow = 0.25  color = vec3(0.5) }
pass Glow { target shine : rgba32f = vec4(material.glow) }
"""


def test_a_pass_that_fits_some_materials() -> None:
    """The others are told, and are not drawn with it."""
    Path("m.burnish").write_text(GLOW)
    result = invoke("conform", "m.burnish", "--routes", "llvmpipe:gl330", "--pass", "Glow")
    assert result.exit_code == 0
    assert "\nm.burnish: Lit × Glow\n" in result.stdout
    assert result.stdout.endswith("\n1 agrees\n")
    assert result.stderr == (
        "warning: m.burnish: Plain × Glow: not drawn, as it does not fit this pass: "
        "unknown slot of `Plain` `glow`\n"
    )


def test_the_errors_of_all_files_are_told() -> None:
    """An unknown slot in one file does not hide the errors of another file."""
    Path("a.burnish").write_text(GLOW.replace("material.glow", "material.gleam"))
    Path("b.burnish").write_text(UP.replace("normal", "norml"))
    result = invoke("conform", "a.burnish", "m.burnish", "b.burnish", "--routes", "llvmpipe:gl330")
    assert (result.exit_code, result.stdout) == (1, "")
    assert "unknown slot of `Plain` `gleam`" in result.stderr
    assert "unknown name `norml`" in result.stderr


def test_routes_whose_profile_lacks_something() -> None:
    """Only these routes are not run."""
    Path("m.burnish").write_text(
        "material Four { map t : texture2d  color = t.gather(uv, 0).rgb }\n"
    )
    result = invoke("conform", "m.burnish", "--routes", "llvmpipe:gl330,lavapipe:glsl")
    assert (result.exit_code, result.stderr) == (1, "")
    assert re.search(r"^  lavapipe:glsl   agrees ", result.stdout, re.MULTILINE)
    assert re.search(r"^  llvmpipe:gl330  not run$", result.stdout, re.MULTILINE)
    told = "not run by llvmpipe:gl330: glsl:gl330 has no gathering of texels\n"
    assert result.stdout.endswith(f"{told}1 agrees, 1 not run\n")


def test_values_that_overflow() -> None:
    """A value beyond float32 has no promise: no agreement, and no fault of the driver."""
    Path("m.burnish").write_text(
        "material Hot { param heat : float = 1e30  color = vec3(heat * heat) }\n"
    )
    result = invoke("conform", "m.burnish", "--routes", "llvmpipe:gl330")
    assert result.exit_code == 1
    assert result.stdout.endswith("\n1 overflows\n")
    assert "the value leaves what float32 holds, where nothing is promised" in result.stderr


def test_values_that_nobody_has_set() -> None:
    """Parameters without a default, of all shapes, and vertex inputs that no mesh has."""
    Path("m.burnish").write_text(
        "struct Coat { tint : rgb on : bool weights : float[2] }\n"
        "material Bare {\n"
        "    param time : float param coat : Coat param coats : Coat[2] param turns : mat3[2]\n"
        "    attribute groove : float attribute bone : ivec2\n"
        "    color = coat.tint * time + (if coats[1].on then coats[0].tint else turns[1][0])\n"
        "        + groove * coat.weights[1] + 0.01 * float(bone.y)\n"
        "}\n"
    )
    result = invoke("conform", "m.burnish", "--routes", "llvmpipe:gl330", "--seed", "5")
    assert (result.exit_code, result.stderr) == (0, "")


def test_warnings_are_told_once() -> None:
    """The number of rigs with which a file is compiled does not matter."""
    Path("m.burnish").write_text(
        f"import std.lights.{{Point}}\n{UP}rig A {{ p : Point }}\nrig B {{ p : Point }}\n/// lost\n"
    )
    for command in (
        ("conform", "--routes", "llvmpipe:gl330"),
        ("render", "-o", "x.png", "--size", 4),
    ):
        result = invoke(*command, "m.burnish")
        assert result.exit_code == 0
        assert result.stderr.startswith("warning[B0113]")
        assert result.stderr.endswith("\n1 warning\n")
        assert result.stderr.count("B0113") == 1


def test_disagreement(monkeypatch: pytest.MonkeyPatch) -> None:
    """If devices are not allowed to round, some pixel is wrong; the report shows which one."""

    def exactly(*of: Any) -> Expected:
        found = remembered(*of)
        return replace(found, low=found.targets, high=found.targets)

    monkeypatch.setattr(contents, "remembered", exactly)
    result = invoke("conform", "m.burnish", "--routes", "llvmpipe:gl330", "--report", "out")
    assert result.exit_code == 1
    assert re.search(rf"^  llvmpipe:gl330  differs        {NUMBER}  ", result.stdout, re.MULTILINE)
    assert result.stdout.endswith(f"\n1 differs\nreport: {Path('out/index.html')}\n")
    lanes = r"\((-?[\d.]+(e-\d+)?, ){3}1\)"
    detail = (
        rf"\d+ of \d+ pixels are out of bounds; the worst, at \(\d+, \d+\), is {lanes} and must be "
        rf"exactly {lanes}"
    )
    assert re.match(rf"error: m\.burnish: Up, llvmpipe:gl330: differs\n  defaults: {detail}\n",
                    result.stderr)  # fmt: skip

    (row,) = json.loads(Path("out/report.json").read_text())["rows"]
    assert (row["material"], row["route"], row["status"]) == (
        "m.burnish: Up", "llvmpipe:gl330", "differs",
    )  # fmt: skip
    assert row["cases"]["defaults"]["wrong"] > 0
    page = Path("out/index.html").read_text()
    assert re.search(r"difference × 1e\+0[4-9]", page)
    assert '<failure type="differs"' in Path("out/junit.xml").read_text()
    assert tree(Path("out")) == {"report.json", "junit.xml", "index.html"}


FAR_AWAY = "material Afar { position = vec3(0, 0, 9) color = #ffffff }\n"
HASH = "material Hash { color = vec3(fract(sin(dot(uv, vec2(12.9898, 78.233))) * 43758.5453)) }\n"


def test_what_proves_little_is_a_warning() -> None:
    """The warning names the place in the source; only with --strict it is a failure."""
    Path("m.burnish").write_text(HASH)
    result = invoke("conform", "m.burnish", "--routes", "llvmpipe:gl330,lavapipe:glsl")
    assert result.exit_code == 0
    assert result.stdout.endswith("\n2 prove little\n")
    heading, *cases, reason = result.stderr.splitlines()
    assert heading == "warning: m.burnish: Hash, lavapipe:glsl, llvmpipe:gl330: proves little"
    assert all(" may have nearly any value, and at " in line for line in cases) and len(cases) == 4
    expression = "`fract(sin(dot(uv, vec2(12.9898, 78.233))) * 43758.5453)`"
    assert re.fullmatch(
        rf"  {re.escape(expression)} magnifies rounding (\d·)?10\^\d times \(m\.burnish:1\)", reason
    )
    result = invoke(
        "conform", "m.burnish", "--routes", "llvmpipe:gl330", "--strict", "--report", "out"
    )
    assert result.exit_code == 1
    assert result.stderr.startswith("error: m.burnish: Hash, llvmpipe:gl330: proves little\n")
    assert '<failure type="proves little"' in Path("out/junit.xml").read_text()


def test_what_is_nowhere_to_be_seen_proves_little() -> None:
    Path("m.burnish").write_text("material Far { position = vec3(0, 0, 9) color = #ffffff }")
    result = invoke("conform", "m.burnish", "--routes", "llvmpipe:gl330")
    assert result.exit_code == 0
    assert result.stderr == (
        "warning: m.burnish: Far, llvmpipe:gl330: proves little\n"
        "  no scene shows anything of it, which proves nothing\n"
    )
    assert result.stdout.endswith("\n1 proves little\n")


def test_a_driver_that_breaks_down(monkeypatch: pytest.MonkeyPatch) -> None:
    worker = [sys.executable, "-c", "import os; os.kill(os.getpid(), 9)"]
    monkeypatch.setattr(routes.DriverRow, "command", lambda *_: worker)
    result = invoke("conform", "m.burnish", "--routes", "llvmpipe:gl330")
    assert result.exit_code == 1
    assert "\n  llvmpipe:gl330  failed\n" in result.stdout
    assert result.stdout.endswith("\n1 failed\n")
    assert result.stderr == (
        "error: m.burnish: Up, llvmpipe:gl330: failed\n"
        "  llvmpipe crashed: killed by signal 9 (Killed)\n"
    )


@pytest.mark.usefixtures("no_tools")
def test_nothing_to_draw_with() -> None:
    result = invoke("conform", "m.burnish")
    assert (result.exit_code, result.stderr) == (1, "")
    assert result.stdout.count(" not run\n") == len(routes.ROUTES) + 1
    packages = f"{sys.executable} -m pip install 'burnish[run]'"
    assert (
        "not run by chromium:webgpu, chromium:webgl2: chromium is missing; to install it: "
        f"{tool_named('chromium').install}; playwright, numpy, pillow are missing; "
        f"to install them: {packages}\n"
    ) in result.stdout, result.stdout
    assert result.stdout.endswith(f"\n{len(routes.ROUTES)} not run\n")


def without(monkeypatch: pytest.MonkeyPatch, tool: str) -> None:
    """Makes one tool seem to be missing."""
    find = tools.inspect_all

    def found(wanted: Iterable[Tool]) -> Mapping[str, ToolState]:
        states = dict(find(wanted))
        if tool in states:
            states[tool] = ToolState(states[tool].tool, (), None, f"{tool} is missing")
        return states

    monkeypatch.setattr(routes, "inspect_all", found)


def test_a_route_without_its_tools(monkeypatch: pytest.MonkeyPatch) -> None:
    """Among all routes it is only told of; asked for by name, it is an error."""
    without(monkeypatch, "naga")
    result = invoke("conform", "m.burnish", "--routes", "llvmpipe:gl330,lavapipe:wgsl-naga")
    assert (result.exit_code, result.stderr) == (1, "")
    assert "\n  lavapipe:wgsl-naga  not run\n" in result.stdout
    assert (
        "\nnot run by lavapipe:wgsl-naga: naga is missing\n1 agrees, 1 not run\n" in result.stdout
    )


USAGE = "Usage: burnish conform [OPTIONS] FILE…\nTry 'burnish conform --help' for help.\n\nError: "
BAD = {
    "": (2, f"{USAGE}Missing argument 'FILE…'.\n"),
    "m.burnish --routes lavapip": (
        2, f"{USAGE}there is no route `lavapip`; did you mean `lavapipe`?\n"
    ),
    "m.burnish --routes ,": (2, f"{USAGE}--routes names no route\n"),
    "m.burnish --seed x": (2, f"{USAGE}Invalid value for '--seed': 'x' is not a valid integer.\n"),
    "none.burnish": (
        1,
        "error[B0001]: there is no file `none.burnish`\n  = help: Check the path: it is taken "
        "relative to the folder the command is run in.\n\n1 error\n",
    ),
    "m.burnish --report m.burnish": (
        1,
        "error[B0009]: cannot write to `m.burnish`: `m.burnish` is a file, not a folder\n"
        "  = help: The message says what is in the way. Missing folders are made where they are "
        "needed.\n\n1 error\n",
    ),
}  # fmt: skip


@pytest.mark.parametrize(("line", "expected"), BAD.items(), ids=list(BAD))
def test_bad_command_lines(line: str, expected: tuple[int, str], folder: Path) -> None:
    before = tree(folder)
    result = invoke("conform", *line.split())
    assert (result.exit_code, result.stdout, result.stderr) == (expected[0], "", expected[1])
    assert tree(folder) == before


def test_an_error_in_any_file_is_told_before_anything_is_drawn() -> None:
    Path("wrong.burnish").write_text("material M { color = tnt }")
    result = invoke("conform", "m.burnish", "wrong.burnish", "--routes", "llvmpipe:gl330")
    assert (result.exit_code, result.stdout) == (1, "")
    assert result.stderr.startswith("error[B0201]: unknown name `tnt`\n")


def test_the_report_in_a_browser(monkeypatch: pytest.MonkeyPatch) -> None:
    """The report is one complete file, whose links have targets and whose pictures are there."""
    without(monkeypatch, "chromium")
    Path("w.burnish").write_text(
        "pass Two : Forward { target more : rgba16f = vec4(normal, 1) }\nmaterial Wall { }\n"
    )
    line = ("m.burnish", "w.burnish", "--routes", "llvmpipe:gl330,chromium", "--report", "out")
    assert invoke("conform", *line).exit_code == 1
    with browsers.browser() as browser:
        page = browser.new_page(viewport={"width": 500, "height": 600})
        asked: list[str] = []
        page.on("request", lambda request: asked.append(request.url))
        page.goto(Path("out/index.html").absolute().as_uri())
        cells = page.locator("#matrix tbody tr").all_inner_texts()
        targets = page.evaluate(
            "[...document.links].map(link =>"
            " document.querySelector(link.hash)?.querySelector('summary')?.innerText)"
        )
        broken = page.evaluate("[...document.images].filter(i => !i.naturalWidth).length")
        pictures = page.locator("img").count()
        wide = page.evaluate("document.documentElement.scrollWidth")
        text = page.inner_text("body")
    names = ["m.burnish: Up", "w.burnish: Wall", "w.burnish: Wall × Two"]
    assert [re.split(r"\s*\t\s*", row)[0] for row in cells] == names
    assert all(re.search(r"\tagrees\n[\d.]+ steps\n\tnot run\tnot run$", row) for row in cells)
    assert targets == names
    assert (broken, pictures) == (0, 5 * (4 + 4 + 8))
    assert wide <= 500, "what is wide scrolls by itself"
    assert "not run: chromium:webgpu, chromium:webgl2" in text
    assert [url for url in asked if not url.startswith(("file:", "data:"))] == []


EXPANDED = """
material Sprites {
    expand point {
        strip of 4 as i {
            position = corner[0].position + 0.1 * vec3(float(i mod 2), float(i / 2), 0)
        }
    }
    color = 0.5 + 0.5 * normal
}
"""


def test_native_stages(folder: Path) -> None:
    """A geometry stage draws what the reference draws; a profile without one is left out."""
    (folder / "s.burnish").write_text(EXPANDED)
    named = ("lavapipe:glsl", "lavapipe:wgsl-naga")
    result = invoke("conform", "s.burnish", "--native-stages", "--routes", ",".join(named))
    lines = filter(None, map(str.split, result.stdout.splitlines()))
    rows = {words[0]: words[1:3] for words in lines}
    assert rows["lavapipe:glsl"][0] == "agrees"
    assert rows["lavapipe:wgsl-naga"] == ["not", "run"]
    assert "not run by lavapipe:wgsl-naga: wgsl:webgpu has no geometry stage" in result.stdout
    assert result.exit_code == 1  # It was named.


@pytest.mark.parametrize("options", [(), ("--explain", "36,28", "--case", "defaults")])
def test_files_are_compiled_once(options: tuple[str, ...], monkeypatch: pytest.MonkeyPatch) -> None:
    """This process compiles few files, and those whose pixels it explains, and judges them."""
    compiled: list[str] = []

    def noted(path: Path, *of: Any, **options: Any) -> Any:
        compiled.append(path.name)
        return subjects_in(path, *of, **options)

    monkeypatch.setattr(judge, "subjects_in", noted)
    names = [f"m{number}.burnish" for number in range(2 + (judge.KEPT if options else 0))]
    for name in names:
        Path(name).write_text(UP)
    result = invoke("conform", *names, "--routes", "llvmpipe:gl330", *options)
    assert (result.exit_code, result.stderr) == (0, "")
    assert compiled == names
