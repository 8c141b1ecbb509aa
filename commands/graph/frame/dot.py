"""Writes the graph of a frame in Graphviz's language."""

from __future__ import annotations

from collections.abc import Iterator

from ..dot import quoted
from .looks import ARROWS, COLORS, texture_color
from .model import STEPS, Arrow, Box, FramePicture


def written(picture: FramePicture) -> str:
    """A digraph: each step is a box, with its results beside it."""
    lines = [
        f"digraph {quoted(picture.title)} {{",
        f"  label={quoted(f'{picture.title}: {picture.shared}')}; labelloc=t; rankdir=LR;",
        '  node [shape=box, style="filled,rounded", fontname="monospace", fontsize=10];',
        '  edge [color="#5b6570"];',
    ]
    for box in picture.boxes:
        lines += (f"  {line}" for line in _box(box))
    lines += (f"  {_arrow(arrow)}" for arrow in picture.arrows)
    return "\n".join([*lines, "}"]) + "\n"


def _box(box: Box) -> Iterator[str]:
    colors = COLORS[box.kind]
    label = [box.name, *box.lines]
    if box.repeated:
        label.append(f"× {box.repeated}")
    if box.only_first:
        label.append("first frame only")
    words = "\n".join(label)
    attributes = [
        f"label={quoted(words)}", f'fillcolor="{colors.fill}"',
        f'color="{colors.line}"', f"tooltip={quoted(' '.join(box.notes))}",
    ]  # fmt: skip
    if colors.is_dark:
        attributes.append('fontcolor="#ffffff"')
    if box.kind in STEPS:
        attributes.append('shape=box, style="filled"')
    yield f"{quoted(box.key)} [{', '.join(attributes)}];"
    for port in box.ports:
        words = f"{port.key}\n{port.what}"
        key = quoted(f"result {port.key}")
        look = f'fillcolor="#ffffff", color="{texture_color(port.texture)}"'
        yield f"{key} [label={quoted(words)}, {look}];"
        yield f"{quoted(box.key)} -> {key};"


def _arrow(arrow: Arrow) -> str:
    source = f"result {arrow.port}" if arrow.port else arrow.source
    look = ARROWS[arrow.kind]
    style = ", style=dashed" if look.dash else ""
    free = ", constraint=false" if arrow.kind == "back" else ""
    return (
        f"{quoted(source)} -> {quoted(arrow.target)} "
        f"[penwidth={look.width:g}, tooltip={quoted(look.words)}{style}{free}];"
    )
