"""Long lines are broken where a person would, and mean what they meant."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

import burnish
from burnish.targets.emit import wrapping
from burnish.targets.emit.wrapping import WIDTH, broken, moved, wrapped
from burnish.targets.toolchain import Toolchain

from ..suite.verdicts import refused
from .kit import PROFILES, Selected, can_have
from .programs import odd, plastic
from .test_accepted import jobs

BROKEN = {
    name: lines
    for block in Path(__file__).with_name("broken_lines.txt").read_text("utf-8").split("\n\n")
    for name, *lines in [block.strip().split("\n")]
}
"""The lines that result from breaking each line that is too long."""


def joined(lines: list[str]) -> str:
    """The one line that a person would have had to break."""
    text = " ".join(line.strip() for line in lines)
    text = text.replace(" /// ", " ") if text.startswith("///") else text
    return text.replace("( ", "(").replace(" )", ")")


@pytest.mark.parametrize("expected", BROKEN.values(), ids=BROKEN)
def test_where_lines_are_broken(expected: list[str]) -> None:
    line = joined(expected)
    assert len(line) > WIDTH
    assert broken(line) == expected


def test_a_comment_behind_a_declaration_moves_above_it() -> None:
    line = "    float3 tint;  /// " + "One word after another. " * 5
    assert broken(line.rstrip()) == [
        "    /// " + ("One word after another. " * 4).rstrip() + " One",
        "    /// word after another.",
        "    float3 tint;",
    ]


def test_a_line_of_110_characters_is_not_too_long() -> None:
    line = "    float wide = " + " + ".join(["first", "x" * 84]) + ";"
    assert len(line) == 110
    assert wrapped(line) == (line, {})
    assert len(broken(line.replace("x;", "xx;"))) == 2


def test_both_lines_around_a_bracket_may_be_as_long() -> None:
    head = f"    vec3 tint = {'a' * 87} * mix("
    lines = broken(f"{head}{'b' * 60}, {'c' * 60}) * shade;")
    assert len(head) == 110
    assert lines[0] == head


@pytest.mark.parametrize("line", ["#extension " + "x " * 80, "    " + "x" * 120 + ";"])
def test_what_cannot_be_broken_stays(line: str) -> None:
    assert broken(line) == [line]


def test_no_comment_line_ends_in_a_backslash() -> None:
    lines = broken("// " + "back\\ slash\\  " * 20 + "end")
    assert not any(line.rstrip().endswith("\\") for line in lines)


NESTED = st.recursive(
    st.sampled_from(["a_name", "-1.0", "v.xyz", "array<vec4f, 3>", "m[i + 1]"]),
    lambda inner: st.one_of(
        st.lists(inner, min_size=1, max_size=6).map(lambda items: f"f({', '.join(items)})"),
        st.lists(inner, min_size=2, max_size=6).map(lambda items: f"({' + '.join(items)})"),
        st.lists(inner, min_size=2, max_size=6).map(" * ".join),
        st.tuples(inner, inner, inner).map(lambda parts: "({} ? {} : {})".format(*parts)),
    ),
    max_leaves=60,
)


@given(NESTED)
def test_only_blanks_and_line_ends_are_put_in(value: str) -> None:
    line = f"    let value = {value};"
    lines = broken(line)
    assert "".join("".join(lines).split()) == "".join(line.split())
    assert all(text.startswith("    ") and text == text.rstrip() for text in lines)


def test_all_lines_of_a_statement_have_its_place() -> None:
    long = "    x = " + " + ".join(["something_long"] * 9) + ";"
    text, breaks = wrapped(f"// One\n{long}\n    y = 1;\n}}")
    places = moved({2: "x", 3: "y"}, breaks)
    lines = text.split("\n")
    assert len(lines) == 12
    assert places == {**dict.fromkeys(range(2, 11), "x"), 11: "y"}


LONG = "material M { color = " + " + ".join(f"sin(uv.xyx * {k}.5)" for k in range(1, 9)) + " }"


@pytest.mark.parametrize("target", ["glsl", "hlsl"])
def test_statements_behind_line_directives_stay_whole(target: str) -> None:
    plain, directed = (
        burnish.compile(LONG, [target], line_directives=directives).materials[0]
        for directives in (False, True)
    )
    assert max(map(len, plain.text(target, "fragment").split("\n"))) <= WIDTH
    assert max(map(len, directed.text(target, "fragment").split("\n"))) > WIDTH


@pytest.fixture(scope="module")
def toolchain() -> Iterator[Toolchain]:
    with Toolchain() as tools:
        yield tools


@pytest.mark.parametrize("selected", PROFILES, ids=str)
def test_compilers_take_lines_broken_everywhere(
    selected: Selected, toolchain: Toolchain, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(wrapping, "WIDTH", 24)
    monkeypatch.setattr(wrapping, "_known", broken)  # What is known is as wide as ever.
    asked = [
        job
        for program in (plastic(), odd())
        if can_have(selected, program)
        for job in jobs(selected, program)
    ]
    found = refused(asked, toolchain)
    assert not found, found[0].messages[:3]
