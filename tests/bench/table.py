"""Measurements as rows, for people and for programs."""

from __future__ import annotations

from dataclasses import dataclass

Cell = str | int | float | bool | None
Row = dict[str, Cell]


@dataclass(frozen=True, slots=True)
class Section:
    """A titled table; every row has the same columns."""

    name: str
    """The key in the JSON file."""
    title: str
    rows: list[Row]

    def text(self) -> str:
        """The table in aligned columns, numbers to the right."""
        if not self.rows:
            return f"{self.title}\n  none\n"
        columns = list(self.rows[0])
        shown = [columns, *([_cell(row[column]) for column in columns] for row in self.rows)]
        widths = [max(map(len, column)) for column in zip(*shown, strict=True)]
        lines = [
            "  ".join(
                cell.ljust(width) if isinstance(self.rows[0][column], str) else cell.rjust(width)
                for column, cell, width in zip(columns, line, widths, strict=True)
            ).rstrip()
            for line in shown
        ]
        return "\n".join([self.title, *(f"  {line}" for line in lines), ""])


def _cell(value: Cell) -> str:
    if value is None:
        return "-"
    if isinstance(value, bool):
        return "yes" if value else "NO"
    return f"{value:.3f}" if isinstance(value, float) else str(value)
