"""Prints what ``burnish conform`` has found, and writes its report."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from .console import Styled, remark, say

if TYPE_CHECKING:
    from ..targets.conformance.rows import Row
    from ..targets.conformance.summary import Unfinished
    from ..targets.runner.routes import Route

COLORS = {
    "agrees": "green", "differs": "red", "proves little": "yellow", "overflows": "red",
    "failed": "red", "not run": "yellow",
}  # fmt: skip


class Table:
    """A table that is printed row by row, as soon as each row is known.

    Each material has a heading, and below it a line for each route.
    """

    def __init__(self, routes: Sequence[Route]) -> None:
        """``routes`` are those of the rows."""
        from ..targets.conformance.rows import STATUSES
        from ..targets.conformance.summary import HEADINGS

        # No text below the other headings is longer than they are, but the last one's.
        self._widths = [*map(len, HEADINGS)]
        self._widths[0] = max(len(HEADINGS[0]), *(len(route.name) for route in routes))
        self._widths[1] = max(map(len, STATUSES))
        self._material: str | None = None
        self._count = 0

    def add(self, row: Row) -> None:
        """Print the next row."""
        from ..targets.conformance.summary import HEADINGS, cells

        if self._material is None:
            self._print_line(HEADINGS)
        if self._material != row.material:
            say(Styled(row.material, is_bold=True))
            self._material = row.material
        self._print_line(cells(row))
        self._count += 1

    def end(self, rows: Sequence[Row]) -> None:
        """Print those of all rows that were not printed yet, which are the last ones."""
        for row in rows[self._count :]:
            self.add(row)
        if rows:
            say()

    def _print_line(self, texts: Sequence[str]) -> None:
        route, status, *others = map(str.ljust, texts, self._widths)
        numbers = "  ".join(["", *others]).rstrip()
        shown = Styled(status if numbers else texts[1], COLORS.get(texts[1]))
        say(f"  {route}  ", shown, numbers)


def print_summary(rows: Sequence[Row], unfinished: Unfinished | None, *, strict: bool) -> None:
    """Print what there is to say about the rows beside the table."""
    from ..targets.conformance.summary import (
        by_material,
        devices,
        is_failure,
        lacking,
        messages,
        outcome,
        tools,
        unmeasured,
    )  # fmt: skip

    for driver, device in devices(rows).items():
        say(f"drawn by {driver}: {device}")
    if versions := tools(rows):
        say(f"with {', '.join(f'{name} {version}' for name, version in versions.items())}")
    for problem, names in lacking(rows).items():
        say(f"not run by {', '.join(names)}: {problem}")
    for material, own in by_material(rows).items():
        for said, lines in messages(own):
            routes = ", ".join(row.route.name for row in said)
            heading = f"{material}, {routes}: {said[0].status}"
            failed = is_failure(said[0], strict=strict)
            remark("error" if failed else "warning", "\n  ".join([heading, *lines]))
    if drivers := unmeasured(rows):
        say(
            "bounds of a device are narrower once it is measured: "
            f"`burnish conform --measure --routes {','.join(drivers)}`"
        )
    say(outcome(rows, unfinished))


def passed(rows: Sequence[Row], *, asked: bool, strict: bool) -> bool:
    """True if no row fails, and something was run; all routes, if they were ``asked`` for."""
    from ..targets.conformance.summary import is_failure

    if any(is_failure(row, strict=strict) for row in rows):
        return False
    statuses = {row.status for row in rows}
    return bool(statuses - {"not run"}) and not (asked and "not run" in statuses)


def write_report(
    folder: Path, rows: Sequence[Row], unfinished: Unfinished | None, *, strict: bool
) -> None:
    """Write the files of ``--report``. Raises ``CompileError`` if that is not possible."""
    import json

    from ..targets.conformance.junit import as_junit
    from ..targets.conformance.report import as_json, page
    from .output import write_all

    data = as_json(rows, unfinished, strict=strict)
    texts = {
        "report.json": json.dumps(data, indent=2, ensure_ascii=False) + "\n",
        "junit.xml": as_junit(rows, unfinished, strict=strict),
        "index.html": page(rows, unfinished),
    }
    write_all(folder, texts)
    say(f"report: {folder / 'index.html'}")
