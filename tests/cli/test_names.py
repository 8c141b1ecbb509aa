"""Odd names of files, and names and comments that would upset a backend."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

import burnish
from burnish.targets.toolchain import Job, Toolchain, Verdict, count_instructions

from .kit import PLAIN, invoke, shell, tree

TARGETS = ("hlsl", "glsl", "glsl:gl330", "glsl:es300", "wgsl")
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


def test_a_name_that_is_no_text(tmp_path: Path) -> None:
    """File names are bytes; these are not UTF-8, and errors have to name the file all the same."""
    name = b"\xff.burnish".decode("utf-8", "surrogateescape")
    try:
        (tmp_path / name).write_text("material M { color = tnt }")
    except OSError:
        pytest.skip("this file system has no such names")
    run = shell("check", name, folder=tmp_path)
    assert run.returncode == 1
    assert "--> <U+DCFF>.burnish:1:22" in run.stderr


@pytest.fixture(scope="module")
def toolchain() -> Iterator[Toolchain]:
    with Toolchain() as tools:
        yield tools


def judged(toolchain: Toolchain, *sources: str) -> list[Verdict]:
    """What the compilers of all profiles say about the only material of each source."""
    stages = {"vertex": "vert", "fragment": "frag"}
    jobs = [
        Job(checker, stages[file.stage], file.text, name=file.name)
        for source in sources
        for file in burnish.compile(source, TARGETS).materials[0].files
        for checker in file.checkers
    ]
    verdicts = toolchain.check(jobs, keep_spirv=True)
    refused = [verdict.report() for verdict in verdicts if verdict.status != "accepted"]
    assert not refused, "\n".join(refused)
    return verdicts


@pytest.mark.parametrize("word", WORDS)
def test_reserved_words_are_names_like_any_other(word: str, toolchain: Toolchain) -> None:
    judged(
        toolchain,
        f"material M {{ param {word} : rgb = #fff\n color = {word} * {word}.r }}",
        f"material M {{ {word} = uv.x * 0.5\n color = vec3({word}, {word}, 1) }}",
        f"material M {{ map {word} : texture2d\n color = {word}(uv).rgb }}",
        f"material {word} {{ color = vec3(uv, 1) }}",
        f"fn {word}(x: float) -> float = x + 1\nmaterial M {{ color = vec3({word}(uv.x)) }}",
    )


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


def sizes(verdicts: list[Verdict]) -> list[int]:
    """How many instructions each text became, where the checker makes SPIR-V."""
    return [count_instructions(verdict.spirv) for verdict in verdicts if verdict.spirv]


@pytest.fixture(scope="module")
def harmless(toolchain: Toolchain) -> list[int]:
    """The sizes of the texts with a comment that nobody could take for code."""
    return sizes(judged(toolchain, documented("harmless")))


@pytest.mark.parametrize("doc", HARMFUL.values(), ids=HARMFUL)
def test_comments_do_nothing(doc: str, toolchain: Toolchain, harmless: list[int]) -> None:
    assert sizes(judged(toolchain, documented(doc))) == harmless != []


def test_harmful_comments_do_not_disturb_the_terminal(tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text("material M { color = tnt /// \u202e\x1b[31m\n}", "utf-8")
    shown = invoke("check", file).stderr
    assert "<U+202E><U+001B>[31m" in shown
    assert "\x1b" not in shown
