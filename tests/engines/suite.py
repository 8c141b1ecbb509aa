"""Draws all examples in engines: ``python -m burnish.tests.engines.suite [NAME...]``.

A row for each material says whether all that it gives to Godot lies inside the bounds of its
meaning, or why it is not drawn. The tests do this with a few of them.
"""

from __future__ import annotations

import sys
from collections import Counter
from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.engines.surface import UnfitError

from .files import materials
from .godot import MISSING, drawn, is_there
from .probes import Probe, probes_of

AT_ONCE = 40
"""The pictures that one process of Godot draws."""


def main(names: Sequence[str]) -> int:
    """Print the rows and their sum; returns the process's exit code."""
    if not is_there():
        print(MISSING)
        return 1
    probes: dict[str, list[Probe]] = {}
    verdicts: Counter[str] = Counter()
    for file, name in materials(names):
        label = f"{file.stem}.{name}"
        try:
            probes[label] = list(probes_of(file, name))
        except (CompileError, UnfitError) as error:
            print(f"{label}: not drawn: {error}".splitlines()[0])
            verdicts["not drawn"] += 1
    pictures = [probe.picture for found in probes.values() for probe in found]
    got: dict[str, Any] = {}
    for start in range(0, len(pictures), AT_ONCE):
        with TemporaryDirectory() as folder:
            got |= drawn(pictures[start : start + AT_ONCE], Path(folder))
    for label, found in probes.items():
        verdict = "agrees"
        for probe in found:
            compared = probe.judged(got[probe.label])
            if not compared.agrees:
                verdict = "disagrees"
                print(f"{probe.label}: {compared.wrong} pixels out of bounds: {compared.worst}")
        verdicts[verdict if found else "nothing to show"] += 1
        print(f"{label}: {verdict if found else 'nothing to show'}: {len(found)} values")
    print(", ".join(f"{count} {verdict}" for verdict, count in verdicts.items()))
    return 1 if verdicts["disagrees"] else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
