"""Writes a picture in Graphviz's language."""

from __future__ import annotations

from collections.abc import Iterator

from ...compiler.diagnostics.display import harmless_lines
from .kinds import ArrowKind, texture_color
from .model import Arrow, Box, Picture


def written(picture: Picture) -> str:
    """A digraph with a subgraph for each cluster that has a border; results are boxes, too."""
    shared = "" if picture.time_line is None else f": {picture.time_line.shared}"
    lines = [
        f"digraph {_quoted(picture.title)} {{",
        f"  label={_quoted(picture.title + shared)}; labelloc=t; rankdir=LR;",
        '  node [shape=box, style="filled,rounded", fontname="monospace", fontsize=10];',
        '  graph [fontname="monospace", color="#c3ccd5"];',
        '  edge [color="#5b6570"];',
    ]
    for number, cluster in enumerate(picture.clusters):
        boxes = [f"  {line}" for box in cluster.boxes for line in _box(box)]
        if cluster.has_border:
            head = f"  subgraph cluster_{number} {{", f"    label={_quoted(cluster.title)};"
            boxes = [*head, *(f"  {line}" for line in boxes), "  }"]
        lines += boxes
    lines += (f"  {_arrow(arrow)}" for arrow in picture.arrows)
    return "\n".join([*lines, "}"]) + "\n"


def _box(box: Box) -> Iterator[str]:
    rows = (each.text for each in box.inputs)
    attributes = [
        _label(box.heading, *box.below, *rows), f'fillcolor="{box.fill}"',
        f'color="{box.kind.line}"', f"tooltip={_quoted(' '.join(box.facts))}",
    ]  # fmt: skip
    if box.is_dark:
        attributes.append('fontcolor="#ffffff"')
    if box.guarded:
        attributes.append("penwidth=2")
    if not box.kind.is_round:
        attributes.append('style="filled"')
    yield f"{_quoted(box.key)} [{', '.join(attributes)}];"
    for port in box.ports:
        key = _quoted(f"result {port.key}")
        look = f'fillcolor="#ffffff", color="{texture_color(port.texture)}"'
        yield f"{key} [{_label(port.key, port.what)}, {look}];"
        yield f"{_quoted(box.key)} -> {key};"


def _arrow(arrow: Arrow) -> str:
    source = f"result {arrow.port}" if arrow.port else arrow.source
    kind = arrow.kind
    attributes = [f"penwidth={kind.width:g}"]
    if kind.color:
        attributes.append(f'color="{kind.color}"')
    if kind.words:
        attributes.append(f"tooltip={_quoted(kind.words)}")
    if kind.dash:
        attributes.append("style=dashed")
    if kind is ArrowKind.BACK:
        attributes.append("constraint=false")
    return f"{_quoted(source)} -> {_quoted(arrow.target)} [{', '.join(attributes)}];"


def _label(*lines: str) -> str:
    words = "\n".join(lines)
    return f"label={_quoted(words)}"


def _quoted(text: str) -> str:
    """A text as Graphviz reads it."""
    escaped = harmless_lines(text).replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
    return f'"{escaped}"'
