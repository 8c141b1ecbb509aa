"""Finds what happens to each texture of a frame from step to step; ``build.py`` calls it."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from .model import Column, Life, MarkKind, Row

Rows = Mapping[str, Any]
"""A part of the plan."""


def time_line(
    plan: Rows, groups: Sequence[int], what: Callable[[Rows], str]
) -> tuple[list[Column], list[Row]]:
    """The steps of a plan, and its textures and buffers; ``groups`` says how many steps each
    equation has, and ``what`` describes a texture."""
    columns = [
        Column(number, step.get("name", "copy"), step.get("only_first", False))
        for number, step in enumerate(plan["steps"])
    ]
    at = 0
    for group, size in enumerate(groups):
        for column in columns[at : at + size]:
            column.group = str(group) if size > 1 else ""
        at += size
    textures = [
        Row(f"#{number}", what(texture), number) for number, texture in enumerate(plan["textures"])
    ]
    buffers: dict[str, Row] = {}
    outputs = {row["result"] for row in plan["outputs"]}
    kept = {row["result"]: row for row in plan["kept"]}
    for result in plan["results"]:
        name = result["name"]
        life = Life(name, result["first"], result["last"], after=name in outputs or name in kept)
        if result["texture"] is None:
            buffers[name] = Row(name, "buffer", None, [life])
        else:
            textures[result["texture"]].lives.append(life)
    _mark(plan, textures, buffers)
    for name, row in kept.items():
        if row["previous"] is not None:
            previous = textures[row["previous"]]
            last = max(previous.marks, default=0)
            previous.lives.append(Life(name, 0, last, before=True))
    return columns, [*textures, *buffers.values()]


def _mark(plan: Rows, textures: Sequence[Row], buffers: Mapping[str, Row]) -> None:
    """Say in the rows what each step does with them; of several things, the first counts."""
    for number, step in enumerate(plan["steps"]):
        for texture, result, mark in _touched(step):
            row = buffers.get(result) if texture is None else textures[texture]
            if row is not None:
                row.marks.setdefault(number, mark)


def _touched(step: Rows) -> Iterator[tuple[int | None, str, MarkKind]]:
    """The texture, the result, and what is done with it."""
    if step["kind"] == "copy":
        yield step["to"]["texture"], step["to"]["result"], "written"
        yield step["from"]["texture"], step["from"]["result"], "read"
        return
    for row in [*step.get("images", ()), *step.get("buffers", ())]:
        yield row.get("texture"), row["result"], "written"
    for target in attachments(step):
        yield target["texture"], target["result"], mark_of(target)
    for use in [use for drawn in step.get("draws", ()) for use in drawn["uses"]] or [step]:
        for row in use["inputs"]:
            if "result" in row:
                yield row["texture"], row["result"], "read"
            elif "previous" in row:
                yield row["texture"], row["previous"], "read"
                if row["initially"] is not None and "result" in row["initially"]:
                    initial = row["initially"]
                    yield initial["texture"], initial["result"], "read"


def attachments(step: Rows) -> list[Rows]:
    """What a pass draws to."""
    if step["kind"] != "draw":
        return []
    return [*step["targets"], *filter(None, [step["depth"]])]


def mark_of(target: Rows) -> MarkKind:
    """What a pass does with a texture that it draws to; one of depths may have stencils, too."""
    parts = [target, target["stencil"]] if target.get("stencil") else [target]
    if not any(part["store"] for part in parts):
        return "dropped"
    return "drawn over" if any(part["load"] == "load" for part in parts) else "cleared"
