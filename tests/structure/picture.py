"""``python -m tests.structure.picture``: draw what imports what, as a picture for browsers.

Boxes are the floors of the tree, or with a name behind the command (``compiler.semantics``) the
modules of that package. Arrows point from what is imported to what imports it, from left to right.
An import that a longer way implies is left out, or with ``--all`` drawn thin; one that closes a
circle is red.
"""

from __future__ import annotations

from argparse import ArgumentParser
from collections.abc import Iterator, Mapping
from html import escape
from pathlib import Path

from burnish.commands.graph.layout import Item, laid_out

from .kit import ROOT
from .modules import PACKAGE, Graph, between, circles, modules
from .test_floors import FLOORS

MARGIN = 24.0
BOX_HEIGHT = 24.0
LETTER = 7.4
STYLES = {
    "direct": 'stroke="#46525e" stroke-width="1.4"',
    "implied": 'stroke="#c3ccd5" stroke-width="0.7"',
    "circle": 'stroke="#c0281c" stroke-width="2"',
}


def imports_of_floors() -> Graph:
    """The floors that each floor imports."""
    found = between(modules(), [f"{PACKAGE}.{floor}" for floor in FLOORS])
    return {
        floor: frozenset(
            end.removeprefix(f"{PACKAGE}.") for start, end in found if start == f"{PACKAGE}.{floor}"
        )
        for floor in FLOORS
    }


def imports_within(package: str) -> Graph:
    """The modules of a package that each of its modules imports."""
    prefix = f"{PACKAGE}.{package}."
    inside = {name: others for name, others in modules().items() if name.startswith(prefix)}
    return {
        name.removeprefix(prefix): frozenset(
            other.removeprefix(prefix) for other in others if other in inside
        )
        for name, others in inside.items()
    }


def drawn(graph: Graph, title: str, *, implied: bool = False) -> str:
    """The picture of a graph of imports, as SVG; with or without those that others imply."""
    number = {name: i for i, circle in enumerate(circles(graph)) for name in circle}
    kinds = {(b, a): _kind(graph, number, a, b) for a, others in graph.items() for b in others}
    kinds = {edge: kind for edge, kind in kinds.items() if implied or kind != "implied"}
    sizes = {name: (LETTER * len(name) + 16, BOX_HEIGHT) for name in _lowest_first(graph)}
    acyclic = [edge for edge, kind in kinds.items() if kind != "circle"]
    layout = laid_out(sizes, acyclic)
    width, height = layout.width + 2 * MARGIN, layout.height + 3 * MARGIN
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" '
        'font-family="monospace" font-size="12">',
        f'<rect width="{width:.0f}" height="{height:.0f}" fill="#fafbfc"/>',
        f'<text x="{MARGIN}" y="{MARGIN}" font-weight="bold">{escape(title)}</text>',
        f'<g transform="translate({MARGIN} {2 * MARGIN})" fill="none">',
    ]
    for style in ("implied", "direct", "circle"):
        for edge, kind in kinds.items():
            if kind == style:
                path = layout.paths.get(edge, [layout.items[name] for name in edge])
                lines.append(f'<path d="{_curve(path)}" {STYLES[style]}/>')
    lines += [each for name, item in layout.items.items() for each in _box(name, item)]
    return "\n".join([*lines, "</g>", "</svg>", ""])


def _kind(graph: Graph, circle: Mapping[str, int], module: str, other: str) -> str:
    """The kind of arrow by which the import of ``other`` by ``module`` is drawn."""
    if module in circle and circle[module] == circle.get(other):
        return "circle"
    ways = {
        each
        for each in graph[module] - {other}
        if module not in circle or circle[module] != circle.get(each)
    }
    return "implied" if any(other in _reached(graph, way) for way in ways) else "direct"


def _reached(graph: Graph, start: str) -> set[str]:
    """Everything that a module imports, at first hand or not."""
    found: set[str] = set()
    pending = [start]
    while pending:
        for other in graph[pending.pop()] - found:
            found.add(other)
            pending.append(other)
    return found


def _lowest_first(graph: Graph) -> list[str]:
    """The modules, each behind those that it imports, but for circles."""
    return sorted(graph, key=lambda name: (len(_reached(graph, name)), name))


def _curve(path: list[Item]) -> str:
    """A line that leaves the right of a box, and ends at the left of another."""
    x, y = path[0].x + path[0].width, path[0].middle
    text = f"M {x:.0f} {y:.0f}"
    for item in path[1:]:
        bend = (x + item.x) / 2
        text += f" C {bend:.0f} {y:.0f} {bend:.0f} {item.middle:.0f} {item.x:.0f} {item.middle:.0f}"
        text += f" H {item.x + item.width:.0f}" if item is not path[-1] else ""
        x, y = item.x + item.width, item.middle
    return text


def _box(name: str, item: Item) -> Iterator[str]:
    yield (
        f'<rect x="{item.x:.0f}" y="{item.y:.0f}" width="{item.width:.0f}" '
        f'height="{item.height:.0f}" rx="4" fill="#e3e9f8" stroke="#4a68b0"/>'
    )
    yield (
        f'<text x="{item.x + 8:.0f}" y="{item.middle + 4:.0f}" fill="#1d252d">{escape(name)}</text>'
    )


def main() -> None:
    """Write the picture that the command line asks for."""
    parser = ArgumentParser(prog="python -m tests.structure.picture")
    parser.add_argument("package", nargs="?", help="draw its modules; by default, the floors")
    parser.add_argument("--all", action="store_true", help="also what a longer way implies")
    parser.add_argument("-o", "--output", type=Path, default=ROOT / "build" / "imports.svg")
    asked = parser.parse_args()
    graph = imports_within(asked.package) if asked.package else imports_of_floors()
    if not graph:
        parser.error(f"there is no package {asked.package}, or nothing in it")
    asked.output.parent.mkdir(parents=True, exist_ok=True)
    title = f"imports of {asked.package or PACKAGE}, from left to right"
    asked.output.write_text(drawn(graph, title, implied=asked.all), encoding="utf-8")
    print(f"written to {asked.output}")


if __name__ == "__main__":
    main()
