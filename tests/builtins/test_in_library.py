"""Names of other systems for what the library has are told with its declaration and import."""

from __future__ import annotations

from collections.abc import Iterable

import pytest

import burnish
from burnish.compiler import library
from burnish.compiler.diagnostics.fixes import Edit
from burnish.compiler.semantics.types.typenames import NAMED
from burnish.stdlib.builtins.elsewhere import FUNCTIONS
from burnish.stdlib.builtins.in_library import IN_LIBRARY, folded

from .test_elsewhere import CALLED

OFFERS = library.standard_library(library.FOLDER).offers()


def hint(call: str, head: str = "") -> str:
    """The hint about a call of an unknown function."""
    (found,) = burnish.check(f"{head}\nmaterial M {{ a = {call}  color = #fff }}")
    return found.hint


def edited(text: str, edits: Iterable[Edit]) -> str:
    """A text with edits made, the last one first, so that the others' places stay."""
    for edit in sorted(edits, key=lambda edit: edit.span.start, reverse=True):
        text = text[: edit.span.start] + edit.text + text[edit.span.end :]
    return text


def test_all_that_is_named_is_declared() -> None:
    for name, meant in IN_LIBRARY.items():
        offered = {offer.path: offer for offer in OFFERS.get(meant.name, ())}
        assert meant.path in offered, name
        assert offered[meant.path].kind in ("fn", "term"), name


def test_no_name_has_two_answers() -> None:
    """A name of the library itself, of a builtin or of a shading language needs no row."""
    names = {folded(name) for name in IN_LIBRARY}
    here = set(CALLED) | NAMED.keys() | FUNCTIONS.keys() | OFFERS.keys()
    assert names & {folded(name) for name in here} == set()
    answers = {(folded(name), meant) for name, meant in IN_LIBRARY.items()}
    assert len(answers) == len(names)


@pytest.mark.parametrize(
    ("call", "expected"),
    [
        (
            "sdCircle(uv, 1)",
            "it is `circle(p, radius)` of the library: add `import std.distances.{circle}`",
        ),
        (
            "op_smooth_union(1, 2, 3)",
            "it is `smooth_union(a, b, k)` of the library: "
            "add `import std.distances.{smooth_union}`",
        ),
        (
            "rotateVector(normal, vec4(0))",
            "it is `rotate(q, v)` of the library (the quaternion comes first, and then the "
            "vector): add `import std.quaternions.{rotate}`",
        ),
        ("triplanar(1)", "add `import std.mapping.{triplanar}`"),
        ("smoothUnion(1, 2, 3)", "did you mean `smooth_union`? add `import std.distances.{smooth_"),
    ],
)
def test_the_declaration_and_its_import_are_told(call: str, expected: str) -> None:
    assert hint(call).startswith(expected)


def test_what_is_imported_needs_no_import() -> None:
    said = hint("sdCircle(uv, 1)", "import std.distances.{circle}")
    assert said == "it is `circle(p, radius)` of the library"
    own = "fn circle(p: vec2) -> float = p.x"
    assert hint("sdCircle(uv, 1)", own).endswith("add `import std.distances.{circle}`")


def test_its_edits_mend_the_text() -> None:
    for head in ("", "import std.distances.{smooth_union}\n"):
        text = f"burnish 1\n{head}material M {{ color = vec3(smin(uv.x, uv.y, 0.1)) }}"
        (found,) = burnish.check(text)
        (fix,) = found.fixes
        mended = edited(text, fix.edits)
        assert "smooth_union(uv.x, uv.y, 0.1)" in mended
        assert burnish.check(mended) == ()


def test_other_arguments_are_left_to_a_person() -> None:
    (found,) = burnish.check("material M { color = qrot(vec4(0, 0, 0, 1), normal) }")
    assert "the quaternion comes first" in found.hint
    assert found.fixes == ()


def test_only_calls_are_meant() -> None:
    assert "of the library" not in hint("bump")
