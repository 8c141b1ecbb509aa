"""Writes the graph in Graphviz's language."""

from __future__ import annotations

from collections.abc import Iterator

from ...compiler.diagnostics.display import harmless_lines
from .model import Box, Picture
from .svg import colors_of


def written(picture: Picture) -> str:
    """A digraph with a cluster for each stage, function and loop."""
    lines = [
        f"digraph {quoted(picture.title)} {{",
        f"  label={quoted(picture.title)}; labelloc=t; rankdir=LR;",
        '  node [shape=box, style="filled,rounded", fontname="monospace", fontsize=10];',
        '  graph [fontname="monospace", color="#c3ccd5"];',
    ]
    for number, cluster in enumerate(picture.clusters):
        lines.append(f"  subgraph cluster_{number} {{")
        lines.append(f"    label={quoted(cluster.title)};")
        lines += [
            f"    {quoted(box.key)} [{', '.join(_attributes(box))}];" for box in cluster.boxes
        ]
        lines += [f"    {quoted(a)} -> {quoted(b)};" for a, b in cluster.edges]
        lines.append("  }")
    for source, target in picture.crossings:
        lines.append(f'  {quoted(source)} -> {quoted(target)} [color="#12857a"];')
    return "\n".join([*lines, "}"]) + "\n"


def _attributes(box: Box) -> Iterator[str]:
    colors = colors_of(box)
    label = f"{box.name}: {box.type}" + (f"\n{box.formula}" if box.formula else "")
    yield f"label={quoted(label)}"
    yield f'fillcolor="{colors.fill}"'
    yield f'color="{colors.line}"'
    if colors.is_dark:
        yield 'fontcolor="#ffffff"'
    if box.guarded:
        yield "penwidth=2"
    part = f"{box.part:.1%} of the error" if box.part else ""
    yield f"tooltip={quoted(' '.join(filter(None, (box.note, part, box.place))))}"


def quoted(text: str) -> str:
    """A text as Graphviz reads it."""
    escaped = harmless_lines(text).replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
    return f'"{escaped}"'
