"""A process of ``burnish gallery``: it makes the entries of files, one after the other.

``command.py`` starts a few; each keeps its drivers, which start slowly.
"""

from __future__ import annotations

import json
import os
import sys
from pathlib import Path

from ...compiler.budget import raised
from ...targets.runner.routes import select
from .making import Maker


def main() -> None:
    """Answer questions until the input ends. Output of libraries goes to standard error."""
    folder, routes, shown, size = sys.argv[1:]
    os.chdir(folder)  # Messages name files as the gallery does.
    with (
        os.fdopen(os.dup(1), "w") as answers,
        Maker(select([routes]), select([shown]), int(size)) as maker,
    ):
        os.dup2(2, 1)
        for line in sys.stdin:
            asked = json.loads(line)
            with raised(asked["limits"]):
                entry = maker.entry(Path(asked["file"]))
            answers.write(json.dumps({"entry": entry}) + "\n")
            answers.flush()


if __name__ == "__main__":
    main()
