"""Odd names of files, and names and comments that would upset a backend."""

from __future__ import annotations

import json
import os
from collections.abc import Iterator
from pathlib import Path

import pytest

import burnish
from burnish.compiler.diagnostics.display import harmless as escaped
from burnish.targets.toolchain import Job, Toolchain, Verdict, count_instructions

from ..suite.verdicts import refused
from .kit import PLAIN, invoke, shell, tree

TARGETS = ("hlsl", "glsl", "glsl:gl330", "glsl:gl450", "glsl:es300", "glsl:es310", "wgsl")
WORDS = ("texture", "sample", "filter", "input", "matrix", "main", "gl_x", "a__b")


@pytest.mark.parametrize("name", ["a b.burnish", "größe 大.burnish", "noending", "{x}.burnish"])
def test_odd_file_names(name: str, tmp_path: Path) -> None:
    (tmp_path / name).write_text(PLAIN)
    run = shell("compile", name, "-t", "wgsl", "-o", "out put", folder=tmp_path)
    assert (run.returncode, run.stderr) == (0, "")
    assert tree(tmp_path / "out put") == {"Plain.vert.wgsl", "Plain.frag.wgsl", "Plain.json"}


def test_a_leading_dash(tmp_path: Path) -> None:
    (tmp_path / "-dash.burnish").write_text("material M { color = tnt }")
    run = shell("check", "--", "-dash.burnish", folder=tmp_path)
    assert run.returncode == 1
    assert " --> -dash.burnish:1:22" in run.stderr


NAMES = {
    b"caf\xe9.burnish": r"caf\xe9.burnish",
    b"\xff\xfe": r"\xff\xfe",
    b"a\nb.burnish": "a\nb.burnish",
    b'it\'s "so".burnish': 'it\'s "so".burnish',
    b"C:a:1:2.burnish": "C:a:1:2.burnish",
    b"-dash.burnish": "-dash.burnish",
    b".burnish": ".burnish",
    b"back\\slash.burnish": "back\\slash.burnish",
    b"\xe2\x80\xaeright.burnish": "\u202eright.burnish",
    b"a" * 247 + b".burnish": "a" * 247 + ".burnish",
}
"""Names of files, and what outputs call them."""


@pytest.mark.parametrize(("name", "shown"), NAMES.items(), ids=ascii)
def test_names_that_are_no_plain_text(name: bytes, shown: str, tmp_path: Path) -> None:
    """File names are any bytes. Outputs are UTF-8 and JSON all the same, and name the file."""
    file = tmp_path / os.fsdecode(name)
    try:
        file.write_text("/// größe\nmaterial Plain { a = sin(uv.x) color = vec3(a * a) }", "utf-8")
    except OSError:
        pytest.skip("this file system has no such names")
    options = ("-t", "hlsl,glsl,wgsl", "--line-directives", "-o", "out")
    run = shell("compile", *options, "--", file.name, folder=tmp_path)
    assert run.returncode == 0, run.stderr
    for path in (tmp_path / "out").iterdir():
        path.read_text("utf-8")
    reflection = json.loads((tmp_path / "out" / "Plain.json").read_text("utf-8"))
    maps = reflection["backends"]["wgsl:webgpu"]["source_maps"]
    assert shown in maps["Plain.frag.wgsl"]["sources"]
    for form in ("text", "dot", "svg"):
        run = shell(
            "graph", "-o", f"graph.{form}", "--format", form, "--", file.name, folder=tmp_path
        )
        assert run.returncode == 0, run.stderr
        assert "Traceback" not in run.stderr
        (tmp_path / f"graph.{form}").read_text("utf-8")


@pytest.mark.parametrize(("name", "shown"), NAMES.items(), ids=ascii)
def test_errors_in_files_of_such_names(name: bytes, shown: str, tmp_path: Path) -> None:
    file = tmp_path / os.fsdecode(name)
    try:
        file.write_text("material M { color = tnt }", "utf-8")
    except OSError:
        pytest.skip("this file system has no such names")
    run = shell("check", "--", file.name, folder=tmp_path)
    assert run.returncode == 1
    assert f" --> {escaped(shown)}:1:22\n" in run.stderr
    run = shell("check", "--format", "json", "--", file.name, folder=tmp_path)
    (found,) = json.loads(run.stdout)["diagnostics"]
    assert found["span"]["file"] == shown


@pytest.fixture(scope="module")
def toolchain() -> Iterator[Toolchain]:
    with Toolchain() as tools:
        yield tools


def jobs(*sources: str) -> list[Job]:
    """The texts of the only material of each source, for the compilers of all profiles."""
    stages = {"vertex": "vert", "fragment": "frag"}
    return [
        Job(checker, stages[file.stage], file.text, name=file.name)
        for source in sources
        for file in burnish.compile(source, TARGETS).materials[0].files
        for checker in file.checkers
    ]


@pytest.mark.parametrize("word", WORDS)
def test_reserved_words_are_names_like_any_other(word: str, toolchain: Toolchain) -> None:
    asked = jobs(
        f"material M {{ param {word} : rgb = #fff\n color = {word} * {word}.r }}",
        f"material M {{ {word} = uv.x * 0.5\n color = vec3({word}, {word}, 1) }}",
        f"material M {{ map {word} : texture2d\n color = {word}(uv).rgb }}",
        f"material {word} {{ color = vec3(uv, 1) }}",
        f"fn {word}(x: float) -> float = x + 1\nmaterial M {{ color = vec3({word}(uv.x)) }}",
    )
    assert_accepted(refused(asked, toolchain))


def assert_accepted(verdicts: list[Verdict]) -> None:
    wrong = [verdict.report() for verdict in verdicts if verdict.status != "accepted"]
    assert not wrong, "\n".join(wrong)


def documented(doc: str) -> str:
    """A material with a comment wherever one is carried into the text."""
    lines = "".join(f"/// {line}\n" for line in doc.split("\n"))
    return (
        f"{lines}material M {{\n{lines}param base : rgb = #fff\n{lines}map albedo : texture2d\n"
        f"{lines}tint = base * albedo(uv).rgb * tone(uv.x)\n color = tint * tint.r }}\n"
        f"{lines}fn tone(x: float) -> float = x * x\n"
    )


HARMFUL = {
    "trailing backslash": "ends in \\",
    "trigraph backslash": "ends in ??/",
    "backslash and blanks": "ends in \\  \t",
    "closed comment": "*/ discard; /*",
    "next line": "one\x85discard;",
    "line separator": "one\u2028discard;",
    "paragraph separator": "one\u2029discard;",
    "form feed": "one\fdiscard;\vdiscard;",
    "bidirectional": "\u202eesrever\u2066\u2069",
    "template": "{{ 1 / 0 }} {% raw %} {# #}",
    "format": "{} {0} %s",
}


def sizes(toolchain: Toolchain, source: str) -> list[int]:
    """The number of instructions of each text for which the checker makes SPIR-V."""
    verdicts = toolchain.check(jobs(source), keep_modules=True)
    assert_accepted(verdicts)
    return [count_instructions(verdict.spirv) for verdict in verdicts if verdict.spirv]


@pytest.fixture(scope="module")
def harmless(toolchain: Toolchain) -> list[int]:
    """The sizes of the texts with a comment that nobody could take for code."""
    return sizes(toolchain, documented("harmless"))


@pytest.mark.parametrize("doc", HARMFUL.values(), ids=HARMFUL)
def test_comments_do_nothing(doc: str, toolchain: Toolchain, harmless: list[int]) -> None:
    assert sizes(toolchain, documented(doc)) == harmless != []


def test_harmful_comments_do_not_disturb_the_terminal(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text("material M { color = tnt /// \u202e\x1b[31m\n}", "utf-8")
    shown = invoke("check", file).stderr
    assert "<U+202E><U+001B>[31m" in shown
    assert "\x1b" not in shown
