"""Every builtin can be written in every target, with every signature it has."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import product

import pytest

import burnish
from burnish.compiler.ir.stages import COMPUTE
from burnish.stdlib.builtins import BUILTINS
from burnish.stdlib.builtins.facts import UNKNOWN, Fact, Kind
from burnish.stdlib.builtins.row import Builtin, nowhere
from burnish.targets import registry
from burnish.targets.emit.natives import spelling_of
from burnish.targets.emit.precedence import INFIX, PREFIX
from burnish.targets.legalise.definitions import has_meaning

from .kit import BY_NAME, PROFILES, Selected, emitted, has, instances, is_native, program_of_rows

NATIVES = [row for row in BUILTINS.values() if row.domain is not nowhere and row.of_group is None]
"""The builtins for which languages have words.

A builtin that joins a work group is a function of the text.
"""


@pytest.mark.parametrize("selected", PROFILES, ids=str)
def test_profiles_with_kernels_write_images(selected: Selected) -> None:
    profile = selected.profile
    assert bool(profile.image_formats) == (COMPUTE in profile.stages)


@pytest.mark.parametrize("selected", PROFILES, ids=str)
@pytest.mark.parametrize("row", NATIVES, ids=lambda row: row.name)
def test_row_is_spelled(row: Builtin, selected: Selected) -> None:
    table = {**selected.language.natives, **selected.profile.natives}
    functions = selected.language.reserved().words
    for operands, result in instances(row):
        if not is_native(row, operands) or not has(selected.profile, row, operands):
            continue
        if not has_meaning(selected.profile, (row.name, operands)):
            continue  # It is a function of the text.
        spelled = spelling_of(row.name, operands, table)
        arity = len(operands)
        known = (
            (arity == 2 and spelled in INFIX)
            or (arity == 1 and spelled in PREFIX)
            or "{" in spelled
            or functions.issuperset(spelled.split("::"))
        )
        assert known, f"{selected} has no {row.name} of {operands} -> {result}: {spelled!r}"


NUMBERS = (-(2.0**31), -1.0, 0.0, 1.0, 31.0, 32.0, 2.0**31 - 1)
KINDS: tuple[Kind, ...] = ("float", "int", "uint")


def known(count: int) -> Iterator[tuple[Fact, ...]]:
    """The possible facts about operands of one kind: each is a number or between two."""
    for kind in KINDS:
        ends = [n for n in NUMBERS if kind != "uint" or n >= 0]
        facts = [Fact(low, high, kind=kind) for low in ends for high in ends if low <= high]
        yield from product([*facts, UNKNOWN.as_kind(kind)], repeat=count)


@pytest.mark.parametrize("selected", PROFILES, ids=str)
def test_what_a_profile_promises_is_looked_at(selected: Selected) -> None:
    """Types decide where there is a definition; elsewhere a profile only promises more."""
    for name, domain in selected.profile.agrees.items():
        row = BUILTINS[name]
        assert row.definition or row.by_profile is not nowhere
        if not row.definition:
            assert all(domain(facts) for facts in known(2) if row.domain(facts))


def test_wgsl_divides_whole_numbers_by_anything() -> None:
    text = "material M { alpha = float(int(9 * uv.x) / int(3 * uv.y)) }"
    (material,) = burnish.compile(text, "wgsl").materials
    written = material.text("wgsl", "fragment")
    assert " / i32(" in written and "select(" not in written


def test_what_is_defined_stands_before_its_users_and_once() -> None:
    es = BY_NAME["glsl:es300"]
    text = emitted(program_of_rows(es.profile), es)["fragment"]
    made = re.findall(r"^\w+ (count_bits|first_leading_bit)\w*\(uint x\)", text, re.MULTILINE)
    assert made == ["count_bits", "first_leading_bit"]
    assert "bitCount" not in text


def test_what_es_computes_in_low_precision_is_defined() -> None:
    es = BY_NAME["glsl:es310"]
    text = emitted(program_of_rows(es.profile), es)["fragment"]
    assert "bitfieldReverse(" in text
    assert not re.search(r"bitCount|findMSB|findLSB", text)


@pytest.mark.parametrize("selected", PROFILES, ids=str)
def test_rows_print(selected: Selected) -> None:
    text = emitted(program_of_rows(selected.profile), selected)["fragment"]
    assert re.search(r"\bnormalize\(", text)


def test_targets_are_found_by_their_folders() -> None:
    assert {"glsl", "hlsl", "wgsl"} <= set(registry.names())
    assert registry.select("glsl:es300")[1].name == "es300"
    assert registry.select("hlsl")[1].name == "sm6"
    for unknown in ("emit", "toolchain", "no_such_language", "glsl:gl999", "../glsl"):
        with pytest.raises(KeyError):
            registry.select(unknown)


def test_attributes_have_semantics() -> None:
    semantic = registry.load("hlsl").semantic
    assert semantic("attribute", "texcoord1", 3) == "TEXCOORD1"
    assert semantic("attribute", "sv_position", 0) == "ATTRIBUTE_SV_POSITION"
    assert semantic("attribute", "w" * 1000, 3) == "W" * 40 + "_AT3_"
    assert semantic("varying", "normal", 2) == "TEXCOORD2"
    assert semantic("render target", "color", 1) == "SV_Target1"
