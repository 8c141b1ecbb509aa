"""``--emit spirv,dxil``: what drivers take, beside the texts that it is made of."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

import burnish
from burnish.targets.toolchain import count_instructions
from burnish.targets.toolchain.spirv import SpirvError, entry_points, insist_on_valid

from .kit import PLAIN, invoke, tree

LIT = """\
import std.lights.{Directional}
import std.terms.{lambert, phong}
rig Day { sun : Directional }
material Lit { color = lambert(#884422) + phong(vec3(0.3), 30) }
"""
TEXTS = {f"Lit.{stage}.{ending}" for stage in ("vert", "frag") for ending in ("glsl", "hlsl")}
MODULES = {f"Lit.{stage}.{ending}" for stage in ("vert", "frag") for ending in ("spv", "dxil")}


@pytest.fixture(autouse=True)
def _place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path / "cache"))
    (tmp_path / "work").mkdir()
    monkeypatch.chdir(tmp_path / "work")
    Path("m.burnish").write_text(LIT)


def contents(folder: str) -> dict[str, bytes]:
    return {path.name: path.read_bytes() for path in Path(folder).iterdir()}


def test_modules_lie_beside_their_texts() -> None:
    line = ("compile", "m.burnish", "-t", "glsl,hlsl", "--emit", "spirv,dxil")
    done = invoke(*line, "-o", "out")
    assert (done.exit_code, done.stderr) == (0, "")
    first, unsigned = done.stdout.splitlines()
    assert first == "Lit: 4 shaders, 4 modules and Lit.json in out"
    assert unsigned.startswith("DXIL is not signed: ")
    found = contents("out")
    assert found.keys() == TEXTS | MODULES | {"Lit.json"}
    backends = json.loads(found["Lit.json"])["backends"]
    rows = [row for backend in backends.values() for row in backend["modules"]]
    assert {row["file"] for row in rows} == MODULES
    for row in rows:
        suffix = {"vertex": "vert", "fragment": "frag"}[row["stage"]]
        if row["format"] == "spirv":
            assert (suffix, row["entry_point"]) in entry_points(found[row["file"]])
            insist_on_valid(found[row["file"]])
        else:
            assert found[row["file"]].startswith(b"DXBC")
    assert invoke(*line, "-o", "again").exit_code == 0
    assert contents("again") == found, "the same tools make the same bytes"


def test_optimized_modules_are_shorter_and_valid() -> None:
    line = ("compile", "m.burnish", "-t", "glsl", "--emit", "spirv")
    assert invoke(*line, "-o", "long").exit_code == 0
    assert invoke(*line, "--optimize", "-o", "short").exit_code == 0
    long, short = (contents(folder)["Lit.frag.spv"] for folder in ("long", "short"))
    assert count_instructions(short) < count_instructions(long)
    insist_on_valid(short)
    with pytest.raises(SpirvError, match="spirv-val refuses it"):
        insist_on_valid(short[:-4])


def test_one_text_of_all_stages_has_a_module_for_each() -> None:
    line = ("compile", "m.burnish", "-t", "hlsl", "--single-file", "--emit", "dxil", "-o", "out")
    assert invoke(*line).exit_code == 0
    assert tree(Path("out")) == {"Lit.hlsl", "Lit.vert.dxil", "Lit.frag.dxil", "Lit.json"}
    (backend,) = json.loads(Path("out/Lit.json").read_text())["backends"].values()
    assert [row["entry_point"] for row in backend["modules"]] == ["vs_main", "fs_main"]


def test_several_files_and_a_list_of_outputs() -> None:
    Path("p.burnish").write_text(PLAIN)
    line = ("compile", "m.burnish", "p.burnish", "-t", "glsl", "--emit", "spirv", "-o", "out")
    listed = invoke(*line, "--list-outputs").stdout.splitlines()
    answer = json.loads(invoke(*line, "--format", "json").stdout)
    assert answer["written"] == listed
    kinds = {row["path"]: row["kind"] for row in answer["result"]["outputs"]}
    assert kinds["out/Plain.vert.spv"] == "module"
    assert sorted(listed) == sorted(f"out/{name}" for name in tree(Path("out")))


def test_without_the_texts_there_are_no_modules() -> None:
    done = invoke("compile", "m.burnish", "-t", "wgsl", "--emit", "spirv", "-o", "out")
    assert (done.exit_code, done.stdout) == (1, "")
    assert done.stderr.startswith(
        "error[B0710]: `--emit spirv` compiles texts of glsl:vulkan, which is not among the "
        "targets\n"
    )
    assert "out" not in tree(Path.cwd())


@pytest.mark.usefixtures("no_tools")
@pytest.mark.parametrize(("form", "tool"), [("spirv", "glslang"), ("dxil", "dxc")])
def test_a_missing_tool_leaves_nothing(form: str, tool: str) -> None:
    done = invoke("compile", "m.burnish", "--emit", form, "-o", "out")
    assert (done.exit_code, done.stdout) == (1, "")
    assert f"cannot be run: {tool} is missing; to install it: " in done.stderr
    assert "out" not in tree(Path.cwd())


@pytest.mark.parametrize(
    ("words", "told"),
    [
        ("--emit metallib", "--emit takes shaders, spirv, dxil or functions, not 'metallib'"),
        ("--emit spirv -o -", "--emit makes files of bytes: it goes with a folder, not with -o -"),
        ("--optimize", "--optimize is for SPIR-V: it goes with --emit spirv"),
        ("--optimize --emit dxil", "--optimize is for SPIR-V: it goes with --emit spirv"),
    ],
)
def test_options_that_do_not_go_together(words: str, told: str) -> None:
    done = invoke("compile", "m.burnish", "-o", "out", *words.split())
    assert (done.exit_code, done.stdout) == (2, "")
    assert told in done.stderr


def test_modules_in_python_are_those_of_the_command() -> None:
    (material,) = burnish.compile("m.burnish", ("glsl", "hlsl"))
    found = burnish.modules(material, ("spirv", "dxil"))
    line = ("compile", "m.burnish", "-t", "glsl,hlsl", "--emit", "spirv,dxil", "-o", "out")
    assert invoke(*line).exit_code == 0
    for module in found:
        assert Path("out", module.row.file).read_bytes() == module.content
    assert {(each.row.stage, each.format.name) for each in found} == {
        (stage, form) for stage in ("vertex", "fragment") for form in ("spirv", "dxil")
    }
    (shorter, _) = burnish.modules(material, "spirv", optimize=True)
    assert len(shorter.content) < len(found[0].content)


def test_what_is_no_module_is_told_in_python() -> None:
    (material,) = burnish.compile("m.burnish", "wgsl")
    with pytest.raises(burnish.CompileError, match="compiles texts of glsl:vulkan"):
        burnish.modules(material)
    with pytest.raises(ValueError, match="no format of modules is called `metallib`"):
        burnish.modules(material, "metallib")
    with pytest.raises(TypeError, match="`material` is a compiled material, not str"):
        burnish.modules("m.burnish")  # type: ignore[arg-type]
