"""``python -m tests.bench [PART …]``: measure everything, or the parts that are named."""

from __future__ import annotations

import json
from argparse import ArgumentParser, Namespace
from collections.abc import Callable, Iterator
from pathlib import Path

from burnish.api import entry_points
from burnish.api.remembered import Remembered

from . import (
    aims,
    chains,
    drawing,
    first,
    frames,
    guard_cost,
    lean,
    reductions,
    stage_lengths,
    stages,
    three,
    tiles,
    times,
    view,
)
from .checkout import Checkout
from .growth import measure as growth
from .table import Section

ROOT = Path(__file__).resolve().parents[2]
OUTPUT = ROOT / "build" / "bench.json"

Part = Callable[[Namespace], Iterator[Section]]

PARTS: dict[str, Part] = {
    "lean": lambda _: lean.measure(),
    "stage_lengths": lambda _: stage_lengths.measure(),
    "guards": lambda _: guard_cost.measure(),
    "aims": lambda asked: aims.measure(_checkouts(asked)),
    "first": lambda asked: first.measure(_checkouts(asked)),
    "time": lambda _: times.measure(),
    "chains": lambda _: chains.measure(),
    "growth": lambda asked: growth.measure(growth.select(asked.shape), _checkouts(asked)),
    "drawing": lambda _: drawing.measure(),
    "frames": lambda _: frames.measure(),
    "view": lambda _: view.measure(),
    "stages": lambda _: stages.measure(),
    "three": lambda _: three.measure(),
    "tiles": lambda _: tiles.measure(),
    "reductions": lambda _: reductions.measure(),
}


def main() -> None:
    """Print every section as soon as it is measured, then write them all."""
    # Each compile is to do its work: otherwise, the same again returns what was made before.
    entry_points._REMEMBERED = Remembered(results=0)
    asked = _parser().parse_args()
    sections: list[Section] = []
    for name, measure in PARTS.items():
        if not asked.part or name in asked.part:
            for section in measure(asked):
                print(section.text(), flush=True)
                sections.append(section)
    OUTPUT.parent.mkdir(exist_ok=True)
    written = {section.name: section.rows for section in sections}
    OUTPUT.write_text(json.dumps(written, indent=2) + "\n", encoding="utf-8")
    print(f"written to {OUTPUT}")


def _parser() -> ArgumentParser:
    parser = ArgumentParser(prog="python -m tests.bench", description=__doc__)
    parser.add_argument(
        "part", nargs="*", metavar="PART", choices=[*PARTS, []], help=f"of {', '.join(PARTS)}"
    )
    parser.add_argument(
        "--against", metavar="CHECKOUT", type=Path,
        help="another checkout of Burnish, measured in turn with this one (aims, first, growth)",
    )  # fmt: skip
    parser.add_argument(
        "--shape", metavar="TEXT", action="append", default=[],
        help="only shapes whose names contain the text (growth); may be given several times",
    )  # fmt: skip
    return parser


def _checkouts(asked: Namespace) -> list[Checkout]:
    """The checkouts to measure: this one last, as the aims are for it."""
    here = Checkout("ms" if asked.against is None else "here", ROOT)
    return [here] if asked.against is None else [Checkout("before", asked.against.resolve()), here]


main()
