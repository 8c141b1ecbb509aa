"""Every statement of every emitted text has its place in Burnish text."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest

import burnish
from burnish.compiler.ir.node import Node
from burnish.targets.emit.origins import Marks

from .kit import VARIANTS, Variant

FUNCTION = re.compile(r"(?!struct|cbuffer|layout|uniform)\S.*\{$")
HELPER = re.compile(r"int\d? texture_\w+\(\w+<\w+> texels")
"""The head of a function by which a language asks for a texture's size; it is of no material."""
NO_STATEMENT = re.compile(r"\s*(//.*|\}|\} else \{|)$")


def statements(text: str) -> Iterator[int]:
    """The numbers of all lines inside of functions that say something, by their looks."""
    inside = False
    for number, line in enumerate(text.split("\n"), start=1):
        if line.startswith("}"):
            inside = False
        elif inside and not NO_STATEMENT.match(line):
            yield number
        elif FUNCTION.match(line) and not HELPER.match(line):
            inside = True


@pytest.mark.parametrize("variant", VARIANTS, ids=str)
def test_every_statement_has_a_place(variant: Variant) -> None:
    for material in variant.compile():
        for file in material.files:
            found = list(statements(file.text))
            assert found
            assert found == sorted(file.spans), file.name
            assert all(span.start < span.end for span in file.spans.values())


def test_a_branch_begins_with_its_condition() -> None:
    text = """
        material M {
            map m : texture2d = white
            color = if uv.x > 0.5 then sin(m.level(uv, 2).rgb) else cos(m.level(uv.yx, 1).rgb)
        }
    """
    (material,) = burnish.compile(text, "glsl").materials
    file = next(file for file in material.files if file.stage == "fragment")
    lines = file.text.split("\n")
    places = {lines[number - 1].strip(): span for number, span in file.spans.items()}
    condition = places["if (v_uv.x > 0.5) {"]
    assert text[condition.start : condition.end] == "uv.x > 0.5"


def test_a_definition_stands_where_it_is_used() -> None:
    """A builtin that a profile lacks is a function of no material: it is one with its use."""
    text = """
        material M {
            param far : uint = 6
            alpha = float(count_bits(far + 1))
            color = vec3(float(first_trailing_bit(far)))
        }
    """
    (material,) = burnish.compile(text, "glsl:gl330", hoist=False).materials
    file = next(file for file in material.files if file.stage == "fragment")
    lines = file.text.split("\n")
    places: dict[str, set[str]] = {}
    for number, span in file.spans.items():
        above = (line for line in reversed(lines[:number]) if FUNCTION.match(line))
        places.setdefault(next(above), set()).add(text[span.start : span.end])
    assert places["int count_bits(uint x) {"] == {"count_bits(far + 1)"}
    assert places["int first_trailing_bit(uint x) {"] == {"first_trailing_bit(far)"}


def test_source_maps_are_made_when_somebody_looks_into_them(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    read: list[Marks] = []
    origins = Marks.origins

    def counted(marks: Marks) -> dict[int, Node]:
        read.append(marks)
        return origins(marks)

    monkeypatch.setattr(Marks, "origins", counted)
    (material, *_) = VARIANTS[0].compile()
    first, second = material.files[:2]
    assert not read
    assert first.spans and first.spans
    assert len(read) == 1
    assert second.spans
    assert len(read) == 2
