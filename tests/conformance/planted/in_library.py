"""Planted errors in the expansions of builtins: constants, borders and signs.

What the library's lights, terms and mixins compute stands on both sides of a comparison of
pictures, so ``tests/semantics`` holds it against NumPy instead.
"""

from __future__ import annotations

from functools import cache
from inspect import unwrap
from pathlib import Path

import pytest

from burnish.compiler import expansion_templates, library
from burnish.compiler.passes import expand_builtins
from burnish.targets.legalise import definitions

from .planting import QUICKEST, Plant, Planted

GLSL = QUICKEST["glsl"]
OPENGL = "llvmpipe:gl330"
"""A route whose language lacks functions of bits."""


def expanded(old: str, new: str) -> Plant:
    """Replace words in the file of expansions, of which nothing that was read before is kept."""

    def plant(patch: pytest.MonkeyPatch, folder: Path) -> None:
        text = (library.FOLDER / library.MEANING).read_text(encoding="utf-8")
        assert text.count(old) == 1, f"{library.MEANING} does not say {old!r} once any more"
        (folder / library.MEANING).write_text(text.replace(old, new), encoding="utf-8")
        library.conversions()  # It keeps its own file of the folder.
        patch.setattr(library, "FOLDER", folder)
        patch.setattr(library, "_meaning", library.once(unwrap(library._meaning)))
        patch.setattr(library, "_expansion", cache(unwrap(library._expansion)))
        templates = expansion_templates.template, expansion_templates.definition
        for module, name, kept in zip(
            (expand_builtins, definitions), ("template", "definition"), templates, strict=True
        ):
            patch.setattr(module, name, cache(unwrap(kept)))

    return plant


_IN_GLSL = [
    ("the logarithm of 2 in the 6th digit", "operations: Hyperbolic",
     "0.301029995663981195", "0.301031"),
    ("asinh far out", "operations: Hyperbolic",
     "else log(x) + 0.693147180559945309", "else log(x) + 0.6931"),
    ("tanh flat too early", "operations: Hyperbolic",
     "clamp(x, -16.0, 16.0)", "clamp(x, -5.0, 5.0)"),
    ("the last float below 1", "operations: Hyperbolic",
     "below_one = 0.999999940395355224609375", "below_one = 0.9999998"),
    ("half a turn in the 6th digit", "operations: Angles",
     "half_turn = 3.141592653589793", "half_turn = 3.14158"),
    ("an angle of pi at zero", "operations: Angles",
     "if x <= -smallest_normal then half_turn", "if x < smallest_normal then half_turn"),
    ("0 to a negative power", "operations: Powers",
     "if abs(y) < smallest_normal then 1.0 else 0.0", "if y < smallest_normal then 1.0 else 0.0"),
    ("short vectors stay short", "operations: Geometry",
     "inversesqrt(max(dot(v, v), smallest_normal))", "inversesqrt(max(dot(v, v), 1e-8))"),
    ("no highlight at the terminator", "operations: Geometry",
     "if nl < 0 or nh < 0", "if nl <= 0 or nh < 0"),
    ("vectors over zero", "operations: Arithmetic",
     "x: T, y: float) -> T =\n    if abs(y) < smallest_normal then 0 else unguarded",
     "x: T, y: float) -> T =\n    if abs(y) < smallest_normal then x else unguarded"),
    ("vectors modulo negatives", "operations: Arithmetic",
     "x: T, y: float) -> T =\n    if abs(y) < smallest_normal then 0 else x - y * floor",
     "x: T, y: float) -> T =\n    if abs(y) < smallest_normal then 0 else x - abs(y) * floor"),
    ("a lane of a product by lanes", "operations: Outer",
     " mat4(m[0] * n[0], m[1] * n[1], m[2] * n[2], m[3] * n[3])",
     " mat4(m[0] * n[0], m[1] * n[1], m[2] * n[2], m[2] * n[3])"),
    ("steep ramps are made flatter", "exact: Close",
     "narrowest = 5.42101086242752217e-20", "narrowest = 1e-4"),
    ("a row of inverses in the 6th digit", "exact: Inverses",
     "lower(m[0], m[1]), 1.0)", "lower(m[0], m[1]), 1.00001)"),
    ("the remainder 0 of negatives", "integers: Signed",
     "if remainder != 0 and (remainder < 0) != (y < 0)", "if (remainder < 0) != (y < 0)"),
    ("large floats as uint", "integers: Converted",
     "fn to_uint(x: float) -> uint = unguarded(to_uint(clamp(x, 0.0, 4294967040.0)))",
     "fn to_uint(x: float) -> uint = unguarded(to_uint(clamp(x, 0.0, 2147483520.0)))"),
    ("shifts by more than 31", "bits: Shifted",
     "unguarded(x << (n & 31u))", "unguarded(x << min(n, 31u))"),
    ("fields of all bits", "bits: Fields",
     "0xFFFFFFFFu >> (32 - count)", "(1u << count) - 1u"),
    ("exponents beyond 127", "bits: Floats",
     "clamp(n, -252, 254)", "clamp(n, -126, 127)"),
    ("the largest float of 16 bits", "bits: Packed",
     "min(abs(x), 65504.0)", "min(abs(x), 65520.0)"),
    ("the lowest packed number", "bits: Unpacked",
     "/ 32767.0, -1.0)", "/ 32767.0, -2.0)"),
    ("infinite floats of 16 bits", "bits: Unpacked",
     "else if h >= 0x7C00u", "else if h > 0x7C00u"),
    ("the last texel", "gathered: Levels",
     "clamp(place, 0, size - 1)", "clamp(place, 0, max(size - 2, 0))"),
]  # fmt: skip
"""The error, a material that shows it, the correct text, and the wrong text in its place."""

_IN_OPENGL = [
    ("bits of nibbles", "bits: Counted",
     "((x >> 2) & 0x33333333u)", "((x >> 2) & 0x13333333u)"),
    ("the highest bit of many", "bits: Counted",
     "copied(copied(copied(copied(copied(x, 1), 2), 4), 8), 16)",
     "copied(copied(copied(copied(x, 1), 2), 4), 8)"),
    ("the lowest bit of none", "bits: Counted",
     "if x == 0u then -1 else count_bits", "if x == 0u then 32 else count_bits"),
]  # fmt: skip

PLANTED = [
    *(Planted(name, material, GLSL, expanded(*text)) for name, material, *text in _IN_GLSL),
    *(Planted(name, material, OPENGL, expanded(*text)) for name, material, *text in _IN_OPENGL),
]
