"""Answers questions until there are none. Each is answered by a process of its own, which has
loaded everything but the package already.
"""

from __future__ import annotations

import json
import sys
from collections.abc import Sequence
from functools import partial
from importlib import import_module
from pathlib import Path

from .behaviour import behaviour, names
from .children import Answer, in_child
from .lines import import_drawing, reached
from .questions import Question, judged
from .studio import Studio, codes_of

PATIENCE = 150.0
"""The limit of a mutant, in seconds; one that takes longer counts as hanging."""
LONG = 3600.0
"""The limit of a question about all materials, in seconds."""


def main(folders: Sequence[str]) -> None:
    """Answer questions until there are none."""
    for name in in_child(_loaded, PATIENCE)["loaded"]:
        import_module(name)
    for line in sys.stdin:
        asked = Question(**json.loads(line))
        limit = PATIENCE if asked.kind == "mutant" else LONG
        answer = in_child(partial(_answered, asked, folders), limit)
        print(json.dumps(answer), flush=True)


def _loaded() -> Answer:
    """The names of all modules that the package needs and that are no part of it."""
    import_drawing()
    names = [name for name in sys.modules if not name.startswith(("burnish", "__"))]
    return {"loaded": [name for name in names if not name.startswith("_")]}


def _answered(asked: Question, folders: Sequence[str]) -> Answer:
    if asked.kind == "known":
        # Before anything is imported.
        lines = in_child(partial(reached, folders, PATIENCE, drawn=asked.everything), LONG)
        found = dict(row for name in names(folders) for row in behaviour(name, told=True))
        if asked.everything:
            with Studio() as studio:
                found |= dict(row for name in names(folders) for row in codes_of(name, studio))
        known = {"behaviour": found, "reached": lines}
        Path(asked.into).write_text(json.dumps(known), encoding="utf-8")
        return {}
    return judged(asked)


if __name__ == "__main__":
    main(sys.argv[1:])
