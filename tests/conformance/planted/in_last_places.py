"""Planted errors of four units in the last place, where operations promise less.

The operands of the materials are exact. Functions whose rows allow more than that, such as ``sin``
and ``pow``, are left out.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from burnish.targets.description.spellings import Spelling

from .planting import QUICKEST, Planted, spelling

FACTOR = "1.0000005"
"""Four steps of a float32 above one."""

OPERATORS: Mapping[str, str] = {"add": "+", "sub": "-", "mul": "*", "div": "/"}

FUNCTIONS: Mapping[str, int] = {
    "floor": 1, "ceil": 1, "trunc": 1, "round": 1, "fract": 1, "abs": 1, "sign": 1, "saturate": 1,
    "min": 2, "max": 2, "step": 2, "clamp": 3, "inversesqrt": 1, "exp2": 1, "log2": 1,
}  # fmt: skip
"""Builtins, and how many operands they have."""

CLOSE = {"div", "inversesqrt", "exp2", "log2"}
"""The builtins that are not correctly rounded."""

NAMES: Mapping[str, Mapping[str, str]] = {
    "glsl": {"round": "roundEven"},
    "hlsl": {"fract": "frac"},
    "wgsl": {"inversesqrt": "inverseSqrt"},
}
"""The names of builtins that languages call otherwise."""


ALLOWED = {("hlsl", name) for name in ("inversesqrt", "exp2", "log2")}
"""The builtins for which Direct3D promises less than that."""


def _right(language: str, builtin: str) -> str:
    """The text of a builtin in a language."""
    if builtin in OPERATORS:
        return f"({{0:p}} {OPERATORS[builtin]} {{1:p}})"
    if (language, builtin) == ("glsl", "saturate"):
        return "clamp({0}, 0.0, 1.0)"
    operands = ", ".join(f"{{{number}}}" for number in range(FUNCTIONS[builtin]))
    return f"{NAMES[language].get(builtin, builtin)}({operands})"


def _planted() -> Iterator[Planted]:
    for language, route in QUICKEST.items():
        for builtin in (*OPERATORS, *FUNCTIONS):
            if (language, builtin) in ALLOWED:
                continue
            material = f"exact: {'Close' if builtin in CLOSE else 'Correct'}"
            matrix = "mul" if (language, builtin) == ("hlsl", "mul") else ""
            wrong = Spelling(floats=f"({_right(language, builtin)} * {FACTOR})", matrix=matrix)
            plant = spelling(language, builtin, wrong)
            yield Planted(f"{builtin}, off by four steps", material, route, plant)


PLANTED = list(_planted())
