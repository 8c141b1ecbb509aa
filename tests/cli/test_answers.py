"""Commands tell what they have found in one form for programs: ``--format json``."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import click
import jsonschema
import pytest

from burnish import __version__
from burnish.commands.group import COMMANDS, burnish

from .kit import PLAIN, invoke

WITHOUT = {
    "export": "its --format chooses the document that it writes, and the JSON has a version",
    "graph": "its --format chooses the picture; `export` has the graph as JSON with a version",
    "view": "it serves pages until it is ended",
}
"""The commands without an answer, each with the reason."""
LINES: dict[str, Sequence[str]] = {
    "bind": ("m.burnish", "-t", "wgsl", "--lang", "cpp", "-o", "m.hpp"),
    "build": ("m.burnish", "-t", "wgsl", "-o", "built"),
    "check": ("m.burnish",),
    "compile": ("m.burnish", "-t", "wgsl", "-o", "out"),
    "conform": ("m.burnish", "--routes", "llvmpipe:gl330"),
    "corpus": ("--only", "mod", "-o", "corpus"),
    "docs": (),
    "doctor": (),
    "example": (),
    "explain": ("B0201",),
    "gallery": (
        ".",
        "-o",
        "pages",
        "--routes",
        "llvmpipe:gl330",
        "--on",
        "llvmpipe:gl330",
        "--size",
        "16",
    ),
    "import": ("chair.mtlx", "-o", "chair"),
    "integration": (),
    "judge": ("golden", "golden"),
    "new": (),
    "render": ("m.burnish", "-o", "m.png", "--size", "4"),
    "same": ("m.burnish", "m.burnish"),
    "schema": ("answer",),
    "targets": (),
}
"""A command line for each of the others."""
CHAIR = """\
<materialx version="1.39">
  <open_pbr_surface name="s" type="surfaceshader">
    <input name="base_weight" type="float" value="0.5"/>
  </open_pbr_surface>
  <surfacematerial name="Chair" type="material">
    <input name="surfaceshader" type="surfaceshader" nodename="s"/>
  </surfacematerial>
</materialx>
"""


@pytest.fixture(autouse=True)
def _place(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path / "cache"))
    (tmp_path / "work").mkdir()
    monkeypatch.chdir(tmp_path / "work")
    Path("m.burnish").write_text(PLAIN)
    Path("chair.mtlx").write_text(CHAIR)


@pytest.fixture(scope="module")
def schema() -> jsonschema.Draft202012Validator:
    """The published schema of answers."""
    found = json.loads(invoke("schema", "answer").stdout)
    jsonschema.Draft202012Validator.check_schema(found)
    return jsonschema.Draft202012Validator(found)


def answer(schema: jsonschema.Draft202012Validator, *line: str) -> dict[str, Any]:
    """What a command line prints, and nothing else, with the exit code that it has."""
    done = invoke(*line, "--format", "json")
    assert done.stderr == ""
    found: dict[str, Any] = json.loads(done.stdout)
    schema.validate(found)
    assert (found["answer"], found["burnish"], found["command"]) == (1, __version__, line[0])
    assert found["exit_code"] == done.exit_code
    return found


def test_each_command_has_an_answer_or_a_reason() -> None:
    """Every option `--format` that says `json` is the one of answers."""
    for name in COMMANDS:
        command = burnish.get_command(click.Context(burnish), name)
        assert command is not None
        forms = [each for each in command.params if "--format" in each.opts]
        documented = [
            each for each in forms if "burnish schema answer" in str(getattr(each, "help", ""))
        ]
        assert bool(documented) == (name not in WITHOUT), name
    assert LINES.keys() | WITHOUT.keys() == set(COMMANDS)


@pytest.mark.parametrize("name", LINES)
def test_answers_follow_the_schema(name: str, schema: jsonschema.Draft202012Validator) -> None:
    if name == "judge":
        assert invoke("conform", "m.burnish", "--golden", "golden").exit_code == 0
    found = answer(schema, name, *LINES[name])
    assert (found["exit_code"], found["diagnostics"], found["remarks"]) == (0, [], [])
    assert found["result"] is not None or found["text"] or found["written"] or name == "check"
    assert all(Path(path).is_file() for path in found["written"])


def test_errors_are_diagnostics(schema: jsonschema.Draft202012Validator) -> None:
    Path("m.burnish").write_text("material M { color = tnt }")
    for line in (
        ("check", "m.burnish"), ("compile", "m.burnish", "-o", "out"),
        ("render", "m.burnish", "-o", "m.png"), ("same", "m.burnish", "m.burnish"),
        ("conform", "m.burnish"),
    ):  # fmt: skip
        found = answer(schema, *line)
        (told,) = found["diagnostics"]
        assert (told["code"], told["severity"], found["written"]) == ("B0201", "error", [])
        assert told["span"]["start"] == {"line": 1, "column": 22, "offset": 21}


def test_messages_without_a_rule_are_remarks(schema: jsonschema.Draft202012Validator) -> None:
    Path("m.png").mkdir()
    found = answer(schema, "render", "m.burnish", "-o", "m.png")
    assert found["remarks"] == [
        {"severity": "error", "text": "cannot write `m.png`: it is a folder"}
    ]
    assert found["exit_code"] == 1


def test_misuse_is_told_to_people() -> None:
    """A command line that makes no sense has no answer."""
    for line in (("check", "--format", "json"), ("explain", "B9999", "--format", "json")):
        done = invoke(*line)
        assert (done.exit_code, done.stdout) == (2, "")
        assert done.stderr.startswith("Usage: ")
    assert invoke("targets").stdout.startswith("glsl  GLSL"), "the next command is told as always"


def test_compile_tells_what_it_reads_and_writes(schema: jsonschema.Draft202012Validator) -> None:
    Path("inc").mkdir()
    Path("inc/a.burnish").write_text("fn half(at: float) = at / 2.0\n")
    Path("u.burnish").write_text(
        'import "a.burnish".{half}\nmaterial U { colour = vec3(1)\n color = vec3(half(uv.x)) }\n'
    )
    line = ("compile", "m.burnish", "u.burnish", "-I", "inc", "-t", "wgsl", "-o", "out")
    found = answer(schema, *line, "--depfile", "all.d")
    assert [each["code"] for each in found["diagnostics"]] == ["B0210"]
    result = found["result"]
    paths = [row["path"] for row in result["outputs"]]
    assert found["written"] == [*paths, "all.d"]
    assert result["outputs"][0] == {
        "path": "out/Plain.vert.wgsl", "kind": "text", "source": "m.burnish"
    }  # fmt: skip
    assert result["outputs"][-1] == {
        "path": "out/U.json", "kind": "reflection", "source": "u.burnish"
    }  # fmt: skip
    assert result["read"][:3] == ["m.burnish", "u.burnish", "inc/a.burnish"]
    assert result["missing"] == [str(Path.cwd() / "a.burnish")]
    assert result["lines"] == [
        "Plain: 2 shaders and Plain.json in out", "U: 2 shaders and U.json in out"
    ]  # fmt: skip
    for path in paths:
        Path(path).unlink()
    listed = answer(schema, *line, "--list-outputs")
    assert (listed["written"], listed["result"]["outputs"]) == ([], result["outputs"])
    assert not list(Path("out").iterdir())


def test_a_printed_shader_is_no_document() -> None:
    for form in ("json", "sarif"):
        done = invoke("compile", "m.burnish", "-o", "-", "--format", form)
        assert done.exit_code == 2
        assert f"--format {form} prints a document: it goes with a folder" in done.stderr
