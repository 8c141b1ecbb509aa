"""The commands that only tell something, and how all of them behave as programs."""

from __future__ import annotations

import json
import os
import re
import signal
import sys
from pathlib import Path

import pytest

from burnish import __version__
from burnish.commands.group import COMMANDS
from burnish.commands.terminal import wants_color
from burnish.compiler.diagnostics import rules
from burnish.compiler.diagnostics.diagnostic import Rule
from burnish.targets import registry
from burnish.targets.runner.routes import EVERY_ROUTE
from burnish.targets.toolchain import TOOLS, ToolState, tools

from ..suite.processes import run, started, until
from .kit import PLAIN, invoke

RULES = [rule for rule in vars(rules).values() if isinstance(rule, Rule)]


@pytest.mark.parametrize("command", COMMANDS)
def test_help_teaches_by_example(command: str) -> None:
    text = invoke(command, "--help").stdout
    assert f"Example:\n      burnish {command}" in text


def test_version() -> None:
    assert invoke("--version").stdout == f"burnish, version {__version__}\n"


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.code)
def test_every_code_is_explained(rule: Rule) -> None:
    text = invoke("explain", rule.code.lower()).stdout
    assert text.startswith(f"{rule.severity}[{rule.code}]: ")
    assert not re.search(r"\{\w+\}", text.partition("\n")[0]), "no placeholders for a reader"
    assert " ".join(rule.help.split()) in " ".join(text.split())
    assert "\nRight:\n" in text or "\nNo program shows this. " in text


def test_explaining_shows_a_wrong_and_a_right_program() -> None:
    assert (
        invoke("explain", "B0302").stdout
        == """\
error[B0302]: `…` cannot be called with (…)

The number and the types of the arguments have to match one of the candidates.
Arguments that share a type parameter need the same type.

Wrong:

    material M { color = vec3(uv) }

error[B0302]: `vec3` cannot be called with (vec2)
 --> <text>:1:22
  |
1 | material M { color = vec3(uv) }
  |                      ^^^^^^^^
  = help: say what the other lanes are: `vec3(uv, 0)`

Right:

    material M { color = vec3(uv, 0) }
"""
    )


def test_explaining_names_the_target_that_a_program_is_wrong_for() -> None:
    text = invoke("explain", "B0701").stdout
    assert "\nWrong if it is compiled for glsl:es300:\n" in text
    assert "\nerror[B0701]: glsl:es300 has no gathering of texels\n" in text


def test_unknown_code() -> None:
    result = invoke("explain", "B9999")
    assert result.exit_code == 2
    assert "there is no code `B9999`" in result.stderr


def test_check_is_silent_about_good_files(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text(PLAIN)
    result = invoke("check", file)
    assert (result.exit_code, result.output) == (0, "")
    answer = json.loads(invoke("check", file, "--format", "json").stdout)
    assert (answer["exit_code"], answer["diagnostics"], answer["remarks"]) == (0, [], [])


def test_warnings_do_not_fail(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text(PLAIN + "/// of nothing\n")
    for command in (("check", file), ("compile", file, "-o", tmp_path / "out")):
        result = invoke(*command)
        assert result.exit_code == 0
        assert result.stderr.startswith("warning[B0113]")
        assert result.stderr.endswith("\n1 warning\n")


def test_check_for_programs(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text("material M { color = tnt }")
    result = invoke("check", file, "--format", "json")
    (found,) = json.loads(result.stdout)["diagnostics"]
    assert (result.exit_code, result.stderr) == (1, "")
    assert (found["code"], found["severity"]) == ("B0201", "error")
    assert found["span"]["start"] == {"line": 1, "column": 22, "offset": 21}


def test_targets() -> None:
    text = invoke("targets").stdout
    for name in registry.names():
        for profile in registry.load(name).profiles:
            assert f"  {name}:{profile.name}" in text
            assert profile.doc in text


def test_targets_for_programs() -> None:
    answer = json.loads(invoke("targets", "--format", "json").stdout)
    rows = answer["result"]["targets"]
    assert [row["name"] for row in rows] == list(registry.names())
    es = next(p for row in rows for p in row["profiles"] if p["name"] == "es300")
    assert es["clip_depth"] == "-1..1"
    assert es["checkers"] == ["glslang-es300"]
    engines = {row["name"]: row for row in answer["result"]["engines"]}
    assert "clearcoat" in engines["godot"]["values"] and not engines["godot"]["targets"]
    assert engines["unity"]["unproven"]


def test_doctor_finds_what_the_tests_need() -> None:
    result = invoke("doctor")
    assert result.exit_code == 0, result.stdout
    found, _, drawn = result.stdout.partition("\n\n")
    rows = [line for line in found.splitlines() if not line.startswith(" ")]
    assert [line.split()[:2] for line in rows] == [["ok", tool.name] for tool in TOOLS]
    *routes, direct3d = drawn.splitlines()
    assert [line.split()[:2] for line in routes] == [["draws", name] for name in EVERY_ROUTE]
    assert direct3d.startswith("Direct3D itself draws nothing here")


@pytest.mark.usefixtures("no_tools")
def test_doctor_says_how_to_install() -> None:
    result = invoke("doctor")
    assert result.exit_code == 1
    for tool in TOOLS:
        assert f"install it with: {tool.install}\n" in result.stdout
    for route in EVERY_ROUTE.values():
        assert f"{route.title}  (needs {', '.join(route.needs)})\n" in result.stdout
    assert "nothing is checked by dxc-spirv, dxc-dxil\n" in result.stdout
    assert "nothing is drawn by chromium:webgpu, chromium:webgl2\n" in result.stdout


def test_doctor_tells_old_from_missing(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(tools, "inspect", lambda tool: ToolState(tool, (tmp_path,), "0", "old"))
    assert invoke("doctor").stdout.startswith("unusable  glslang")


@pytest.mark.parametrize(("no_color", "wanted"), [("", True), ("1", False)])
def test_colours(no_color: str, wanted: bool, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("NO_COLOR", no_color)
    monkeypatch.setattr(sys.stdout, "isatty", lambda: True)
    assert wants_color(sys.stdout) is wanted
    monkeypatch.setattr(sys.stdout, "isatty", lambda: False)
    assert not wants_color(sys.stdout)


def test_a_reader_that_leaves(tmp_path: Path) -> None:
    """The reader is ``head`` in ``burnish compile … -o - | head -1``."""
    (tmp_path / "m.burnish").write_text(f"/// {'long ' * 50_000}\n{PLAIN}")
    reading, writing = os.pipe()
    os.close(reading)
    command = [sys.executable, "-m", "burnish", "compile", "m.burnish", "-o", "-"]
    ended = run(command, cwd=tmp_path, stdout=writing)
    os.close(writing)
    assert ended.stderr == ""


DRAWING = [
    "render m.burnish -o m.png --size 4", "conform m.burnish --routes llvmpipe:gl330", "targets"
]  # fmt: skip


@pytest.mark.parametrize("line", DRAWING)
def test_a_full_device_for_output(line: str, tmp_path: Path) -> None:
    (tmp_path / "m.burnish").write_text(PLAIN)
    with Path("/dev/full").open("w") as full:
        ended = run([sys.executable, "-m", "burnish", *line.split()], cwd=tmp_path, stdout=full)
    assert (ended.returncode, ended.stderr) == (1, "error: No space left on device\n")


@pytest.mark.parametrize("line", DRAWING)
@pytest.mark.parametrize("stream", [1, 2])
def test_closed_streams(line: str, stream: int, tmp_path: Path) -> None:
    """A shell closes a stream by ``burnish … >&-``."""
    (tmp_path / "m.burnish").write_text(PLAIN)
    command = f'exec "$0" -m burnish {line} {stream}>&-'
    ended = run(["sh", "-c", command, sys.executable], cwd=tmp_path)
    assert (ended.returncode, ended.stderr) == (0, "")


@pytest.mark.parametrize(
    ("encoding", "name"), [("latin-1", r"\u540d.burnish: "), ("utf-8", "名.burnish: ")]
)
def test_terminals_with_few_letters(encoding: str, name: str, tmp_path: Path) -> None:
    (tmp_path / "名.burnish").write_text(PLAIN)
    environment = {**os.environ, "PYTHONIOENCODING": encoding}
    for line, wanted in (("conform --routes llvmpipe 名.burnish", name), ("render --help", "")):
        command = [sys.executable, "-m", "burnish", *line.split()]
        ended = run(command, cwd=tmp_path, env=environment)
        assert (ended.returncode, ended.stderr) == (0, "")
        assert wanted in ended.stdout


WATCH = ["compile", "m.burnish", "-t", "wgsl", "-o", "out", "--watch"]


@pytest.mark.usefixtures("interruptible")
def test_watching(tmp_path: Path) -> None:
    """Follows the file and its imports through errors, until it is interrupted."""
    (tmp_path / "tones.burnish").write_text("tone = 0.5")
    main_file = tmp_path / "m.burnish"
    main_file.write_text('import "tones.burnish"\nmaterial M { color = vec3(tone) }')
    shader = tmp_path / "out" / "M.frag.wgsl"
    said = tmp_path / "said"
    watching = [sys.executable, "-m", "burnish", *WATCH]
    with said.open("w") as stream, started(watching, cwd=tmp_path, stderr=stream) as command:
        await_text(shader, "0.5")
        (tmp_path / "tones.burnish").write_text("tone = tnt")
        await_text(said, "error[B0201]: unknown name `tnt`")
        assert "0.5" in shader.read_text()
        replacement = tmp_path / "new"
        replacement.write_text("tone = 0.25")
        replacement.rename(tmp_path / "tones.burnish")
        await_text(shader, "0.25")
        command.signal(signal.SIGINT)
        assert command.ended().returncode == 130
    assert said.read_text().startswith("error[B0201]: unknown name `tnt`")
    assert "Traceback" not in said.read_text()


def await_text(file: Path, text: str) -> None:
    until(lambda: file.is_file() and text in file.read_text(), f"{text} in {file.name}")


def test_watching_without_its_package(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "watchfiles", None)
    result = invoke(*WATCH)
    assert result.exit_code == 2
    assert f"{sys.executable} -m pip install 'burnish[watch]'" in result.stderr


def test_a_command_that_is_misspelt() -> None:
    assert "No such command 'compil'. Did you mean 'compile'?" in invoke("compil").stderr


LOADED = """
import sys
from burnish.commands.cli import main
try:
    main()
finally:
    print(*sys.modules, file=sys.stderr)
"""
NEVER = {"numpy", "jsonschema", "watchfiles", "hypothesis", "lark", "burnish.targets.toolchain"}
COMPILER = {"burnish.api.entry_points", "burnish.compiler.frontend", "burnish.targets", "jinja2"}


def loaded(folder: Path, *arguments: str) -> set[str]:
    """The modules that a command has loaded in the end."""
    told = run([sys.executable, "-c", LOADED, *arguments], cwd=folder, check=True)
    return set(told.stderr.split())


def test_compiling_loads_no_more_than_it_needs(tmp_path: Path) -> None:
    (tmp_path / "m.burnish").write_text(PLAIN)
    command = ("compile", "m.burnish", "-t", "wgsl", "-o", "out", "--no-cache")
    loaded(tmp_path, *command)
    modules = loaded(tmp_path, *command)
    assert not modules & (NEVER | {"click", "dataclasses", "inspect"})
    assert "burnish.targets.wgsl.language" in modules
    assert "burnish.targets.hlsl.language" not in modules


@pytest.mark.parametrize("arguments", [("--help",), ("--version",), ("compile", "--help")])
def test_help_loads_no_compiler(arguments: tuple[str, ...], tmp_path: Path) -> None:
    assert not loaded(tmp_path, *arguments) & (NEVER | COMPILER)
