"""``python -m tests.bench [lean] [time] [chains] [drawing]``: measure all, or those named."""

from __future__ import annotations

import json
import sys
from pathlib import Path

from . import chains, drawing, lean, times
from .table import Section

OUTPUT = Path(__file__).parents[2] / "build" / "bench.json"
PARTS = {
    "lean": lean.measure,
    "time": times.measure,
    "chains": chains.measure,
    "drawing": drawing.measure,
}


def main(wanted: list[str]) -> None:
    """Print every section as soon as it is measured, then write them all."""
    unknown = set(wanted) - PARTS.keys()
    if unknown:
        sys.exit(f"there is no part {', '.join(sorted(unknown))}; there are {', '.join(PARTS)}")
    sections: list[Section] = []
    for name, measure in PARTS.items():
        if not wanted or name in wanted:
            for section in measure():
                print(section.text(), flush=True)
                sections.append(section)
    OUTPUT.parent.mkdir(exist_ok=True)
    written = {section.name: section.rows for section in sections}
    OUTPUT.write_text(json.dumps(written, indent=2) + "\n", encoding="utf-8")
    print(f"written to {OUTPUT}")


main(sys.argv[1:])
