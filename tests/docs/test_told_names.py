"""The names in the left columns of the comparing pages: messages say of them what the pages say."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import burnish
from burnish.stdlib.comparisons import compared, names_in
from burnish.stdlib.other_names import folded

from .comparisons import PAGES

GUESS = re.compile(r"did you mean `(\w+)`\?")
"""A hint that knows nothing of a name but its letters."""


def told_of(written: str) -> list[str]:
    """The hints for unknown names in a material that says ``written``."""
    found = burnish.check(f"material M {{\n    said = {written}\n    color = vec3(0)\n}}\n")
    hints = [getattr(each.hint, "text", each.hint) for each in found if each.rule.code == "B0201"]
    return [str(hint) for hint in hints]


def is_answer(hint: str, name: str) -> bool:
    """True if a hint tells what to write, and does not guess a name of other letters."""
    guess = GUESS.fullmatch(hint)
    is_known = guess is None or folded(guess[1]) == folded(name)
    return bool(hint) and is_known and "nothing declares it" not in hint


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_names_of_the_pages_are_answered(page: Path) -> None:
    names = dict.fromkeys(name for name, _here in names_in(page.read_text(encoding="utf-8")))
    assert len(names) > 60
    for name in names:
        for written in (name, f"{name}(uv)"):
            assert all(is_answer(hint, name) for hint in told_of(written)), told_of(written)


@pytest.mark.parametrize(
    ("written", "told"),
    [
        ("modelWorldMatrix", "here it is `object_to_world`; "),
        ("tangentWorld", "here it is `+ Tangents` of `std.tangents`, `tangent`, `bitangent`; "),
        ("SV_Target0", "here it is `color = a`; "),
        ("ALBEDO", "`burnish docs coming_from_engines`"),
        ("pcurve(uv.x, 2, 3)", "`pow(y + z, y + z) / "),
        ("spiralSDF(uv, 3)", "`abs(sin(fract("),
        ("MagicTexture(uv)", "`domain_warp` of `std.noise`"),
        ("slopeBlur(uv)", "a pass over a whole picture"),
        ("artistic_ior(uv, uv)", "`schlick_f82` of `std.microfacets`"),
        ("mod289(uv)", "`x mod 289`"),
        ("toMat4(uv)", "`to_matrix`"),
        ("viewportLinearDepth", "`std.frames.shown_at`"),
        ("deltaTime", "`param time : float per frame`"),
        ("RadialShear(uv, uv, 1)", "`uv + x * dot(uv, uv) * vec2(uv.y, -uv.x)`"),
        ("crosshatch(uv)", "`stripes` of `std.patterns`"),
    ],
)
def test_what_is_told(written: str, told: str) -> None:
    (hint,) = told_of(written)
    assert told in hint


def test_cells_with_bars_and_calls_are_read() -> None:
    row = "| `f(x) \\| y`, `g(x);`, `h.k` | `a \\| b` |"
    rows = list(names_in(f"| a | here |\n| --- | --- |\n{row}\n"))
    assert rows == [("g", "`a | b`")]
    assert compared()["gl_Position"].page == "coming_from_shading_languages"
