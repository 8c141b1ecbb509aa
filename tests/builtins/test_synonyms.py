"""Functions of other systems lead to those of the library that do the same."""

from __future__ import annotations

import pytest

import burnish
from burnish.compiler import library
from burnish.compiler.semantics.names.modules import Offers
from burnish.stdlib.builtins import BUILTINS
from burnish.stdlib.builtins.elsewhere import KEYWORDS, TYPES
from burnish.stdlib.other_names import (
    BY_FOLDED,
    FUNCTIONS,
    NODES,
    NODES_BY_FOLDED,
    SYNONYMS,
    folded,
)

OFFERS: Offers = library.standard_library(library.FOLDER).offers()


@pytest.mark.parametrize("name", SYNONYMS)
def test_what_is_meant_is_declared_in_its_file(name: str) -> None:
    meant = SYNONYMS[name]
    for each in meant.names:
        kinds = {offer.kind for offer in OFFERS[each] if offer.path == meant.path}
        assert kinds
        assert kinds <= {"fn", "term"}


def test_names_that_are_known_need_no_row() -> None:
    # A mixin may have the name of what it adds, such as `Sheen`, which others call as a function.
    called = {
        name for name, offers in OFFERS.items() if {each.kind for each in offers} != {"mixin"}
    }
    assert {folded(name) for name in called} & BY_FOLDED.keys() == set()
    for elsewhere in (BUILTINS, FUNCTIONS, KEYWORDS, TYPES):
        assert elsewhere.keys() & SYNONYMS.keys() == set()
    assert NODES_BY_FOLDED.keys() & BY_FOLDED.keys() == set()
    assert len(NODES_BY_FOLDED) == len(NODES), "two rows are the same name in two styles"
    assert len(BY_FOLDED) == len(SYNONYMS), "two rows are the same name in two styles"


@pytest.mark.parametrize(
    ("head", "call", "hint"),
    [
        ("", "luma(#fff)", "did you mean `luminance`? add `import std.color.{luminance}`"),
        ("import std.color", "luma(#fff)", "did you mean `luminance`?"),
        ("", "blendSoftLight(#fff, #000)", "did you mean `soft_light`? add `import std.blending."),
        ("", "cubicInOut(0.3)", "did you mean `ease_in_out_cubic`? add `import std.easing."),
        ("", "ToneMapping(#fff)", "`std.tone_mapping` has `aces`, `agx`, "),
        ("", "sdCircle(uv, 1)", "did you mean `circle`? add `import std.distances.{circle}`"),
        ("", "opXor(1, 2)", "did you mean `exclusion`? add `import std.distances.{exclusion}`"),
        ("", "smin(1, 2, 3)", "did you mean `smooth_union`? add `import std.distances."),
        ("", "rnm(normal, normal)", "did you mean `reoriented_blend`? add `import std.mapping."),
        (
            "import std.blending", "opSubtraction(1, 2)",
            "did you mean `difference`, where the second shape is taken out of the first one? "
            "add `import std.distances.{difference}`",
        ),
        (
            "import std.quaternions", "rotateVector(normal, vec4(0))",
            "did you mean `rotate`, where the quaternion comes first, and then the vector?",
        ),
        (
            "", "difference(1, 2)",
            "add `import std.blending.{difference}` or `import std.distances.{difference}`",
        ),
        ("import std.easing", "ease_in(0.3)", "`std.easing` has `ease_in_sine`, "),
    ],
)  # fmt: skip
def test_a_synonym_is_told(head: str, call: str, hint: str) -> None:
    (found,) = burnish.check(f"{head}\nmaterial M {{ color = vec3({call}) }}")
    assert str(found.hint if isinstance(found.hint, str) else found.hint.text).startswith(hint)


@pytest.mark.parametrize("head", ["", "import std.blending"])
def test_another_style_is_told_whatever_is_imported(head: str) -> None:
    """Another name that is imported, `linear_dodge`, is nearly the same as what is written."""
    (found,) = burnish.check(f"{head}\nmaterial M {{ color = linearToSRGB(#fff) }}")
    assert "`linear_to_srgb`? add `import std.color.{linear_to_srgb}`" in str(found.hint)
    (found,) = burnish.check(f"{head}\nmaterial M {{ color = softLight(#fff, #000) }}")
    assert ("add `import" in str(found.hint)) == (not head)


def test_an_own_function_in_another_style_is_meant_first() -> None:
    text = "fn tone_map(c: rgb) -> rgb = c / (1 + c)\nmaterial M { color = toneMap(#fff) }"
    (found,) = burnish.check(text)
    assert "did you mean `tone_map`?" in str(found.hint)


def test_an_own_function_is_meant_before_a_node() -> None:
    text = "fn one_minus(x: float) -> float = 1 - x\nmaterial M { color = vec3(OneMinus(0.5)) }"
    (found,) = burnish.check(text)
    assert "did you mean `one_minus`?" in str(found.hint)
