"""Checks a plan before it is executed: every step finds what it reads, where it reads it.

A plan may come from a file, and from a faulty compiler. What it says is executed here in thought,
for a first frame and for a second one: which result each texture holds, and how it is used.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any

Row = Mapping[str, Any]


class PlanError(ValueError):
    """A plan cannot be executed; the text tells people why."""


def check_plan(plan: Row) -> None:
    """Raise ``PlanError`` for a plan that no host can execute."""
    _Checking(plan).check()


class _Checking:
    def __init__(self, plan: Row) -> None:
        self._plan = plan
        self._uses: dict[int, str] = {}
        self._holds: dict[int, dict[tuple[int, int], str]] = {}
        """For each texture which result each layer and level holds."""
        self._kept = {row["result"]: row for row in plan["kept"]}
        self._step = ""
        self._waited: set[int] = set()
        """Textures with a barrier before this step."""

    def check(self) -> None:
        for row in self._plan["kept"]:
            if row["previous"] is not None:
                self._uses[row["previous"]] = "sampled"
        for is_first in (True, False):
            for step in self._plan["steps"]:
                if is_first or not step.get("only_first", False):
                    self._do(step, is_first)
            for output in self._plan["outputs"]:
                self._step = f"output {output['name']}"
                self._finds(output["texture"], output["result"])
            for row in self._plan["kept"]:
                self._exchange(row)

    def _exchange(self, row: Row) -> None:
        one, other = row["texture"], row["previous"]
        if one is None:
            return
        self._holds[one], self._holds[other] = self._holds.get(other, {}), self._holds[one]
        self._uses[one], self._uses[other] = "sampled", "sampled"

    def _do(self, step: Row, is_first: bool) -> None:
        self._step = step.get("name", "a copy")
        self._waited = set()
        for barrier in step["barriers"]:
            if is_first or not barrier["only_first"]:
                self._wait(barrier)
        for row in _inputs(step):
            self._read(row, is_first)
        match step["kind"]:
            case "copy":
                self._used(step["from"]["texture"], "copied_from")
                self._written(step["to"]["texture"], "copied_to")
                texture, result = step["to"]["texture"], step["to"]["result"]
                self._holds[texture] = dict.fromkeys(self._parts(texture), result)
            case "run":
                for image in step["images"]:
                    self._written(image["texture"], "image")
                    self._holds[image["texture"]] = {(0, 0): image["result"]}
            case _:
                for target in step["targets"]:
                    self._draw(target, "target")
                if step["depth"] is not None:
                    self._draw(step["depth"], "depth")

    def _wait(self, barrier: Row) -> None:
        texture, before = barrier["texture"], barrier["from"]
        known = self._uses.get(texture, "undefined")
        if before not in (known, "undefined"):
            self._fail(f"texture {texture} is used as {known} before, and not as {before}")
        if before == "undefined":
            self._holds[texture] = {}
        self._uses[texture] = barrier["to"]
        self._waited.add(texture)

    def _used(self, texture: int, use: str) -> None:
        known = self._uses.get(texture, "undefined")
        if known != use:
            self._fail(f"texture {texture} is used as {use}, and no barrier says so: it is {known}")

    def _written(self, texture: int, use: str) -> None:
        self._used(texture, use)
        if texture not in self._waited:
            self._fail(f"nothing waits for what was done to texture {texture} before")

    def _read(self, row: Row, is_first: bool) -> None:
        source = row
        if is_first and row.get("initially") is not None:
            source = row["initially"]
        texture = source.get("texture")
        if texture is None:
            return
        self._used(texture, "sampled")
        if "previous" in source:
            kept = self._kept.get(source["previous"])
            if kept is None or kept["previous"] != texture:
                self._fail(f"texture {texture} does not keep `{source['previous']}`")
            if not is_first:
                self._finds(texture, source["previous"])
        else:
            self._finds(texture, source["result"])

    def _finds(self, texture: int | None, result: str) -> None:
        """Check that a texture holds a result, all of it."""
        if texture is None:
            return
        held = self._holds.get(texture, {})
        for part in self._parts(texture):
            if held.get(part) != result:
                found = held.get(part)
                what = f"`{found}`" if found else "nothing"
                self._fail(f"texture {texture} should hold `{result}`, and holds {what}")

    def _draw(self, target: Row, use: str) -> None:
        texture, result = target["texture"], target["result"]
        self._written(texture, use)
        held = self._holds.setdefault(texture, {})
        layers = (
            range(self._plan["textures"][texture]["layers"])
            if target["layer"] is None
            else (target["layer"],)
        )
        for layer in layers:
            part = layer, target["level"]
            found = held.get(part)
            if target["load"] == "load" and (not found or found not in (result, target["over"])):
                self._fail(f"`{result}` is drawn over something else: {found or 'nothing'}")
            if target["load"] == "clear" and (found == result or target["over"] is not None):
                self._fail(f"`{result}` is cleared, and should be drawn over")
            held[part] = result if target["store"] else ""

    def _parts(self, texture: int) -> Iterator[tuple[int, int]]:
        row = self._plan["textures"][texture]
        for layer in range(row["layers"]):
            for level in range(row["levels"]):
                yield layer, level

    def _fail(self, text: str) -> None:
        raise PlanError(f"{self._plan['frame']}, {self._step}: {text}")


def _inputs(step: Row) -> Iterator[Row]:
    """What the frame sets in a step."""
    yield from step.get("inputs", ())
    for drawn in step.get("draws", ()):
        for use in drawn["uses"]:
            yield from use["inputs"]
