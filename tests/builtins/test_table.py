"""The table of builtins is whole: every row is documented, and has a meaning."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import pytest

from burnish import stdlib
from burnish.compiler.ir.types import MATRICES, TEXTURES
from burnish.compiler.reference import functions
from burnish.stdlib.builtins import BUILTINS, Builtin
from burnish.stdlib.builtins.facts import SMALLEST_NORMAL
from burnish.stdlib.builtins.row import everywhere, nowhere

from ..suite.processes import run

MEANING = (Path(stdlib.__file__).parent / "meaning.burnish").read_text(encoding="utf-8")
WORDS = (
    {*"TVSMCOAZYNLIBPQUJFDGHXKWE", "float", "int", "uint", "bool"}
    | set(map(str, TEXTURES))
    | {f"{kind}{width}" for kind in ("vec", "ivec", "uvec", "bvec") for width in (2, 3, 4)}
    | set(map(str, MATRICES))
)
rows = pytest.mark.parametrize("row", BUILTINS.values(), ids=BUILTINS.keys())


def declared_functions() -> dict[str, int]:
    """The functions of ``meaning.burnish`` and how many parameters each has."""
    found = re.findall(r"^fn (\w+)(?:<[^>]*>)?\(([^)]*)\)", MEANING, re.MULTILINE)
    return {name: parameters.count(":") for name, parameters in reversed(found)}


def test_every_row_has_a_meaning_and_every_meaning_a_row() -> None:
    meant: set[str] = set().union(
        functions._FLOATS, functions._INTEGERS, functions._OF_ANOTHER_KIND,
        functions._CONVERSIONS, functions.WHOLE, functions._OF_GROUPS,
    )  # fmt: skip
    assert BUILTINS.keys() == meant | {"dot"}


@rows
def test_expansion_is_declared_with_the_rows_operands(row: Builtin) -> None:
    operands = row.signatures[0].split(" -> ")[0].split(", ")
    for function in filter(None, (row.expansion, row.definition)):
        assert declared_functions()[function] == len(operands)


def test_every_declared_function_is_an_expansion_or_helps_one() -> None:
    expansions = {f for row in BUILTINS.values() for f in (row.expansion, row.definition)}
    for name in declared_functions().keys() - expansions:
        uses = re.findall(rf"(?<!fn )\b{name}\(", MEANING)
        assert uses, name


@rows
def test_a_limited_domain_comes_with_an_expansion_and_a_line_for_the_manual(row: Builtin) -> None:
    limited = row.domain is not everywhere
    assert limited == bool(row.expansion)
    # What no language has may still be defined for all operands alike.
    assert bool(row.outside) or row.domain in (everywhere, nowhere)


@rows
def test_row_is_documented(row: Builtin) -> None:
    assert row.doc.endswith(".")
    assert row.outside == "" or row.outside.endswith(".")
    assert row.cost == 0 if row.is_promise else row.cost >= 1


@rows
def test_signatures_use_known_words(row: Builtin) -> None:
    for signature in row.signatures:
        operands, result = signature.split(" -> ")
        assert {*operands.split(", "), result} <= WORDS


@rows
def test_samples_have_the_rows_operands(row: Builtin) -> None:
    operands = row.signatures[0].split(" -> ")[0].split(", ")
    assert all(len(sample) == len(operands) for sample in row.samples)


def test_smallest_normal_is_the_same_number_in_the_language() -> None:
    (literal,) = re.findall(r"^smallest_normal = (\S+)$", MEANING, re.MULTILINE)
    assert float(literal) == SMALLEST_NORMAL


def test_table_and_folding_do_without_numpy() -> None:
    program = (
        "import sys, burnish.stdlib.builtins, burnish.compiler.reference.functions;"
        "sys.exit('numpy' in sys.modules)"
    )
    run([sys.executable, "-c", program], check=True)
