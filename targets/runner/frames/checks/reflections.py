"""Checks a reflection by itself: that its parts fit each other, and how much memory they take.

Reflections come from files, too. A host makes room for all values of a shader before it sets any,
so what would be too large is refused here.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import NoReturn

from .....compiler.budget import check
from ...instances.shapes import MOST_LANES
from ...textures.texture import DEFAULTS
from .rows import PlanError, Row
from .steps import check_steps

LANE = 4
"""The bytes of a lane."""
KEPT = 16
"""How much more memory a host needs for a value than a GPU."""
MOST_CORNERS = 32
"""Of a patch: as many as all devices know."""


def check_reflection(where: str, reflection: Row) -> None:
    """Raise ``PlanError`` for a reflection whose parts do not fit each other. Raises
    ``BudgetError`` if its values take too much memory."""
    _Reflection(where, reflection).check()


class Values:
    """The parameters, lights and buffers of a reflection, or of a plan, which a host sets."""

    def __init__(self, where: str, document: Row) -> None:
        self._where = where
        self._document = document
        self._parameters = _named(document["parameters"])

    def check(self) -> None:
        """Raise ``PlanError`` for parameters and lights that do not fit each other."""
        rows = self._document["parameters"]
        for row in rows:
            self.check_row(row["name"], row)
        taken = KEPT * sum(row["size"] for row in rows)
        check("memory", taken, f"{self._where}: the values of its parameters take")
        for row in self._document["lights"]:
            self._check_light(row)

    def check_buffers(self, rows: Iterable[Row]) -> None:
        """Raise ``PlanError`` unless parameters count the elements of buffers, each those of
        one."""
        counters: set[str] = set()
        for row in rows:
            name, count = row["name"], row["count"]
            if count not in self._parameters or count in counters:
                self.fail(name, f"`{count}` does not count its elements")
            counters.add(count)
            self.check_element(row)

    def check_element(self, row: Row) -> None:
        """Raise ``PlanError`` unless an element lies within the bytes to the next one."""
        if self._bytes_of(row["name"], row) > row["stride"]:
            self.fail(row["name"], f"its elements have more than {row['stride']} bytes")

    def _check_light(self, row: Row) -> None:
        name, capacity = row["name"], row["capacity"]
        named = row["parameters"] if row["count"] is None else [*row["parameters"], row["count"]]
        for each in named:
            if each not in self._parameters:
                self.fail(name, f"there is no parameter `{each}`")
        if capacity is not None:
            layout = self._parameters.get(name, {}).get("layout", {})
            if row["parameters"] != [name] or layout.get("count") != capacity:
                self.fail(name, f"no parameter has {capacity} of them")

    def check_textures(self, rows: Iterable[Row]) -> None:
        """Raise ``PlanError`` for a texture that is nothing until a host binds one."""
        for row in rows:
            known = DEFAULTS.get(row["sample"], (row["default"],))
            if row["default"] not in known:
                self.fail(row["name"], f"nothing {row['sample']} is called `{row['default']}`")

    def check_row(self, name: str, row: Row) -> None:
        """Raise ``PlanError`` unless a value lies within its own bytes."""
        if self._bytes_of(name, row) > row["size"]:
            self.fail(name, f"its value has more than {row['size']} bytes")

    def _bytes_of(self, name: str, row: Row) -> int:
        """How many bytes a value spans, from its first to its last."""
        layout = row["layout"]
        one = self._of_members(name, row["members"]) if row.get("members") else (
            self._of_numbers(name, layout)
        )  # fmt: skip
        if "count" not in layout:
            return one
        if layout["count"] < 1 or layout["stride"] < one:
            self.fail(name, f"{layout['count']} elements do not lie every {layout['stride']} bytes")
        return int((layout["count"] - 1) * layout["stride"] + one)

    def _of_members(self, name: str, members: Sequence[Row]) -> int:
        for row in members:
            self.check_row(f"{name}.{row['name']}", row)
        return max(int(row["offset"] + row["size"]) for row in members)

    def _of_numbers(self, name: str, layout: Row) -> int:
        lanes, columns = layout.get("lanes", 0), layout.get("columns", 0)
        if not 1 <= lanes <= MOST_LANES:
            self.fail(name, f"it has {lanes} lanes")
        if columns > 1 and layout["column_stride"] < LANE * lanes:
            self.fail(name, f"its columns do not lie every {layout['column_stride']} bytes")
        further = max(columns - 1, 0) * layout.get("column_stride", 0)
        return int(LANE * lanes + further)

    def fail(self, name: str, text: str) -> NoReturn:
        raise PlanError(f"{self._where}, {name}: {text}")


class _Reflection:
    def __init__(self, where: str, reflection: Row) -> None:
        self._where = where
        self._reflection = reflection
        self._values = Values(where, reflection)
        self._parameters = _named(reflection["parameters"])
        self._textures = _named(reflection["textures"])

    def check(self) -> None:
        reflection = self._reflection
        for table in _UNIQUE:
            self._no_two(table, [row["name"] for row in reflection[table]])
        self._values.check()
        self._values.check_buffers(reflection["buffers"])
        self._values.check_textures(reflection["textures"])
        for row in reflection["results"]:
            self._values.check_element(row)
        self._check_blocks()
        for name, steps in _computed(reflection):
            self._check_steps(name, steps)
        for row in reflection["samplers"]:
            if row["texture"] not in self._textures:
                self._fail("samplers", f"there is no texture `{row['texture']}`")
        self._check_draw(reflection["draw"])

    def _check_blocks(self) -> None:
        """What lies in blocks lies within them."""
        sizes = {row["name"]: row["size"] for row in self._reflection["blocks"]}
        check("memory", sum(sizes.values()), f"{self._where}: its blocks take")
        for row in (*self._reflection["parameters"], *self._reflection["derived"]):
            name, block = row["name"], row["block"]
            if block is None:
                continue
            if block not in sizes or row["offset"] is None:
                self._fail(name, f"there is no place in the block `{block}`")
            if row["offset"] + row["size"] > sizes[block]:
                self._fail(name, f"it is not within the {sizes[block]} bytes of `{block}`")
        for row in self._reflection["derived"]:
            self._values.check_row(row["name"], row)

    def _check_steps(self, name: str, steps: Sequence[Row]) -> None:
        if not steps:
            self._fail(name, "no steps compute it")
        check_steps(f"{self._where}, {name}", steps)
        for step in steps:
            if step["op"] == "parameter" and step["parameter"] not in self._parameters:
                self._fail(name, f"there is no parameter `{step['parameter']}`")
            if step["op"] == "resource" and step["texture"] not in self._textures:
                self._fail(name, f"there is no texture `{step['texture']}`")

    def _check_draw(self, row: Row) -> None:
        if row["corners"] > MOST_CORNERS:
            self._fail("draw", f"no primitive has {row['corners']} corners")
        division = row["tessellation"]
        if division is not None and not all(end < row["corners"] for end in division["ends"]):
            self._fail("draw", "the ends of patches are not among their corners")

    def _no_two(self, table: str, names: Sequence[str]) -> None:
        if len(set(names)) < len(names):
            self._fail(table, "two of them have one name")

    def _fail(self, name: str, text: str) -> NoReturn:
        raise PlanError(f"{self._where}, {name}: {text}")


_UNIQUE = ("blocks", "parameters", "lights", "buffers", "results", "textures", "targets",
           "vertex_inputs")  # fmt: skip
"""The tables of a reflection whose rows are named."""


def _computed(reflection: Row) -> Iterable[tuple[str, Sequence[Row]]]:
    """The steps of all that a host computes, each with what messages call it."""
    for row in reflection["derived"]:
        yield row["name"], row["steps"]
    if reflection["extent"] is not None:
        yield "extent", reflection["extent"]
    for row in reflection["results"]:
        yield row["name"], row["count"]
    for levels in ((reflection["draw"]["tessellation"] or {}).get("levels") or {}).values():
        for steps in levels:
            yield "levels", steps


def _named(rows: Iterable[Row]) -> Mapping[str, Row]:
    return {row["name"]: row for row in rows}
