"""The table of the fields of forms is whole, and spellings use only fields that there are."""

from __future__ import annotations

from collections.abc import Iterator
from string import Formatter

import pytest

from burnish.stdlib.builtins import BUILTINS
from burnish.targets.description.form_fields import FIELDS, NEEDED
from burnish.targets.description.forms import Forms
from burnish.targets.description.spellings import Read, Spelling, Spellings

from .kit import PROFILES, Selected

OF_NATIVES = {"type", "lanes", "lane", "sampler", *map(str, range(6))}


def fields_of(form: str) -> frozenset[str]:
    """The names of the fields in a form; those of operands are numbers."""
    return frozenset(name for _text, name, _spec, _conversion in Formatter().parse(form) if name)


def spellings(table: Spellings) -> Iterator[str]:
    for row in table.values():
        match row:
            case Spelling():
                yield from (row.usual, row.floats, row.integers, row.vectors, row.matrix)
            case Read():
                yield from (row.plain, row.layered, *row.types.values())
            case str():
                yield row


def test_every_row_is_a_form_or_a_plain_text() -> None:
    plain = {
        "else_", "end", "discard", "position", "emit_vertex", "end_strip", "barrier", "member_end",
        "struct_end", "lanes", "lane_words",
    }  # fmt: skip
    flags = {"splat_constant", "matrix_by_rows", "array_of_block"}
    assert {*FIELDS, *plain, *flags} == set(Forms.__match_args__)


def test_what_a_form_has_to_have_is_what_it_can_have() -> None:
    assert NEEDED.keys() <= FIELDS.keys()
    for form, needed in NEEDED.items():
        assert frozenset[str]().union(*needed) <= FIELDS[form], form


@pytest.mark.parametrize("selected", PROFILES, ids=str)
def test_spellings(selected: Selected) -> None:
    profile = selected.profile
    for table in (selected.language.natives, profile.natives, profile.framebuffer.natives):
        assert table.keys() <= BUILTINS.keys()
        for text in spellings(table):
            assert fields_of(text) <= OF_NATIVES, text


def test_wrong_fields_are_seen() -> None:
    assert fields_of("if ({condition:p}) {{") == {"condition"}
    assert fields_of("{0:p} + {1}") == {"0", "1"}
