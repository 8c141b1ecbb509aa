"""Forms of languages use only fields that there are."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import pytest

from burnish.stdlib.builtins import BUILTINS
from burnish.targets.description.forms import Forms
from burnish.targets.description.spellings import Read, Spelling, Spellings

from .form_fields import FIELDS, fields_of
from .kit import PROFILES, Selected

OF_NATIVES = {"type", "lanes", "lane", "sampler", *map(str, range(6))}


def texts(forms: Forms) -> Iterator[tuple[str, str]]:
    """Each form with the name of its row."""
    for name in FIELDS:
        row = getattr(forms, name)
        for text in row.values() if isinstance(row, Mapping) else (row,):
            yield name, text


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
    flags = {"splat_constant", "matrix_by_rows"}
    assert {*FIELDS, *plain, *flags} == set(Forms.__match_args__)


@pytest.mark.parametrize("selected", PROFILES, ids=str)
def test_forms(selected: Selected) -> None:
    for name, text in texts(selected.language.forms):
        assert fields_of(text) <= FIELDS[name], f"{name}: {text}"


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
