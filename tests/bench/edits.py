"""Files that are edited again and again, one declaration at a time, as in an editor."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import count
from pathlib import Path

_PART = """
/// A thing.
material M{n} : Surface {{
    param tint{n} : rgb = #c03a2b
    param rough{n} : float in 0..1 = 0.4
    a = tint{n} * 0.5
    b = bent{n}(rough{n})
    color = lambert(a * b) + phong(a, 20 * rough{n} + 1)
}}
fn bent{n}(x: float) -> float = pow(x, 2) * sin(x) + {n}
"""
_HEAD = """burnish 1
import std.lights.{Directional}
import std.terms.{lambert, phong}
rig R { key : Directional }
"""


@dataclass(slots=True)
class Edit:
    """A file in which one number changes with every edit."""

    what: str
    """The row of the table."""
    aim: float
    path: Path
    before: str
    """The text up to the number."""
    after: str
    is_checked: bool
    """True if the file is checked only, instead of compiled."""
    _numbers: Iterator[int] = field(default_factory=lambda: count(1000))

    def make(self) -> None:
        """Write the file with a number that it did not have before."""
        text = f"{self.before}0.{next(self._numbers)}{self.after}"
        self.path.write_text(text, encoding="utf-8")


def principled_edit(source: Path, path: Path) -> Edit:
    """The default of a parameter of ``principled`` changes."""
    before, marked, after = source.read_text("utf-8").partition("float in 0..1 = 0.4\n")
    head = marked.removesuffix("0.4\n")
    what = "principled after an edit of one declaration, three targets"
    return Edit(what, 10.0, path, before + head, f"\n{after}", is_checked=False)


def long_edit(path: Path, lines: int) -> Edit:
    """A function in the middle of a long file changes, on which one of many materials depends."""
    parts = [_PART.format(n=n) for n in range(-(-lines // _PART.count("\n")))]
    middle = len(parts) // 2
    before = _HEAD + "".join(parts[: middle + 1]).removesuffix(f"{middle}\n")
    what = f"check of {lines} lines after an edit of one declaration"
    return Edit(what, 30.0, path, before, "\n" + "".join(parts[middle + 1 :]), is_checked=True)
