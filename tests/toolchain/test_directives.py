"""Texts whose directives would make a compiler read files or take all memory reach no compiler."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from burnish.targets.toolchain import CHECKERS, Job, Toolchain
from burnish.targets.toolchain.directives import foreign_directive

FOREIGN = (
    '#include "x"',
    "#include <x>",
    '#include_next "x"',
    '#import "x"',
    '#embed "x"',
    "  \t#\tinclude <x>",
    "# /* spaces */ include <x>",
    "/* one */ /* two */ # include <x>",
    "/* one\n two */ #include <x>",
    "// */ #include <x>",
    "#inc\\\nlude <x>",
    "#\\\ninclude <x>",
    "/\\\n* two *\\\n/ #include <x>",
    "#inc\\  \nlude <x>",
    "#inc??/\nlude <x>",
    "%:include <x>",
    "??=include <x>",
    "// a comment that goes on for some compilers \\\n#include <x>",
    '" /*\n#include <x>\n*/ "',
    "void main() { }\r#include <x>",
    "\ufeff#include <x>",
    "\0#include <x>",
    "\x0b\x0c#include <x>",
    "#extension GL_GOOGLE_include_directive : enable",
    "#extension GL_ARB_shading_language_include : require",
    "#extension GL_GOOGLE_INC\\\nLUDE_directive : enable",
    "#version 450 \\\n#include <x>",
    "#define A B",
    "#pragma once",
    '#if __has_include("x")',
    "#",
)
FINE = (
    "",
    "#version 300 es",
    "#extension all : disable",
    '#line 7 "includes.burnish"',
    '#line 7 "#a.burnish"',
    "// #include <x>",
    "//# of things, #ffffff and #define",
    "color = 1.0; // 50%: half",
    "x = a % b; # in the midst",
)


LONG = {
    "in a comment": ("// " + "#" * 1_000_000, None),
    "behind a comment": ("*/" + "#version " * 100_000, None),
    "extensions": ("*/" + "#extension " * 100_000, None),
    "spliced": ("// #\\\n" * 200_000, None),
    "at the end": ("// " + "#" * 1_000_000 + "*/ #define", "#define"),
}
"""Lines that take minutes if each beginning of a directive looks at all of its line."""


@pytest.mark.parametrize("case", LONG)
def test_long_lines_are_read_once(case: str) -> None:
    text, expected = LONG[case]
    found = foreign_directive(text)
    assert (found and found[1]) == expected


@pytest.mark.parametrize("text", FOREIGN)
def test_foreign_directives_are_found(text: str) -> None:
    for before, after in (("", ""), ("#version 450\n", "\nvoid main() { }\n")):
        found = foreign_directive(before + text + after)
        assert found is not None
        line, directive = found
        assert before.count("\n") < line <= (before + text).replace("\r", "\n").count("\n") + 1
        assert directive[:1] in "#%?"


@pytest.mark.parametrize("text", FINE)
def test_what_is_emitted_is_fine(text: str) -> None:
    assert foreign_directive(f"{text}\nvoid main() {{ }}\n") is None
    assert foreign_directive(f"/* x */\nint y;\n{text}") is None


def test_only_known_headers_may_be_included() -> None:
    headers = ("metal_stdlib",)
    assert foreign_directive("#include <metal_stdlib>\n", headers) is None
    for other in ('"metal_stdlib"', "<metal_stdlib> // x", "<other>", "</etc/passwd>"):
        assert foreign_directive(f"int x;\n#include {other}\n", headers) is not None


WITH_DIRECTIVES = [name for name, row in CHECKERS.items() if row.has_directives]


@pytest.mark.parametrize("checker", CHECKERS)
def test_no_compiler_reads_a_file(checker: str, tmp_path: Path, toolchain: Toolchain) -> None:
    """A pipe to which nobody writes would keep a compiler waiting."""
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    text = f'#version 450\n#extension GL_GOOGLE_include_directive : enable\n#include "{pipe}"\n'
    [verdict] = toolchain.check([Job(checker, "frag", text)])
    assert verdict.status == "rejected"
    if checker in WITH_DIRECTIVES:
        said = "no emitted text has the directive"
        assert f":2: error: {said} '#extension GL_GOOGLE" in verdict.report()


def bomb(words: int = 40) -> str:
    """A macro that stands for 2 to the 40 sums."""
    lines = [f"#define A{number + 1} A{number} + A{number}" for number in range(words)]
    return "\n".join(["#define A0 1.0 + x", *lines])


@pytest.mark.parametrize("checker", WITH_DIRECTIVES)
def test_a_macro_bomb_is_refused_among_other_texts(checker: str, toolchain: Toolchain) -> None:
    jobs = [Job(checker, "frag", text) for text in (bomb(), "nonsense", bomb())]
    first, second, third = toolchain.check(jobs)
    assert {each.status for each in (first, second, third)} == {"rejected"}
    assert "the directive '#define A0 1.0 + x'" in first.report()
    assert "the directive" not in second.report()
    assert first.job is jobs[0] and second.job is jobs[1] and third.job is jobs[2]
