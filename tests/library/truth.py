"""Says which declarations of the library a test holds against values from elsewhere.

Devices and the reference draw the same library, so no comparison of pictures finds a wrong formula
in it. Each declaration needs a test whose expected values do not come from the library itself:
published formulas, written anew with NumPy; tables of papers; or symmetries, such as that a
mirrored scene gives the mirrored picture. A test says so with ``@truth("std.lights.Spot")``.

``test_declarations.py`` names what has no such test, and ``mutants.py`` plants errors in the
library and runs these tests.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from importlib import import_module
from itertools import product
from pathlib import Path
from typing import Any, TypeVar

HERE = Path(__file__).parent

Test = Callable[..., None]
Check = Callable[[], None]
Marked = TypeVar("Marked", bound=Test)

TRUTHS: dict[str, list[Test]] = {}
"""The tests of each declaration, by its name: ``std.lights.Spot``."""


def truth(*names: str) -> Callable[[Marked], Marked]:
    """Note that a test knows these declarations from elsewhere.

    It stands above ``parametrize``. Such a test takes no fixture, since mutants call it.
    """

    def note(test: Marked) -> Marked:
        for name in names:
            TRUTHS.setdefault(name, []).append(test)
        return test

    return note


def load_all() -> None:
    """Import all tests of this folder, so that ``TRUTHS`` is complete."""
    for path in sorted(HERE.glob("test_*.py")):
        import_module(f"{__package__}.{path.stem}")


def checks(test: Test) -> Iterator[Check]:
    """The calls of a test: one for each combination of its parameters."""
    marks = [mark for mark in getattr(test, "pytestmark", ()) if mark.name == "parametrize"]
    for chosen in product(*(_rows(mark) for mark in marks)):
        yield partial(test, **{name: value for row in chosen for name, value in row.items()})


def _rows(mark: Any) -> list[dict[str, Any]]:
    """The parameters of each case of a mark ``parametrize``, by name."""
    names, cases = mark.args
    if isinstance(names, str):
        names = [name.strip() for name in names.split(",")]
    return [dict(zip(names, case if len(names) > 1 else [case], strict=True)) for case in cases]
