"""The size of the host: ``python -m tests.web_host.size`` prints the lines of each module.

A line counts if it has code: no blank one, and none that only has comment. The host for WebGPU
consists of the modules that APIs share and of those in ``webgpu``. What is generated is left out:
the table of builtins with the few functions that it needs (``serving/builtin_table.py``), which
nobody writes or reads line by line.
"""

from __future__ import annotations

import re
from pathlib import Path

FOLDER = Path(__file__).parents[2] / "targets" / "web_host"
MOST = 1520
"""The largest number of lines of the host for WebGPU."""

_COMMENT = re.compile(r"/\*.*?\*/|^\s*//[^\n]*", re.DOTALL | re.MULTILINE)
"""A comment between these signs, or a line that is one: no string of the host has any of it."""


def code_lines(text: str) -> int:
    """The lines of a module that have code."""
    return sum(bool(line.strip()) for line in _COMMENT.sub("", text).splitlines())


def sizes(*folders: str) -> dict[str, int]:
    """The lines of each module that lies in these folders of the host."""
    paths = sorted(path for folder in folders for path in (FOLDER / folder).glob("*.js"))
    return {
        path.relative_to(FOLDER).as_posix(): code_lines(path.read_text(encoding="utf-8"))
        for path in paths
    }


def main() -> None:
    """Print a table."""
    for folders in ((".", "webgpu"), ("webgl2",)):
        found = sizes(*folders)
        for name, count in found.items():
            print(f"{count:5} {name}")
        print(f"{sum(found.values()):5} together\n")


if __name__ == "__main__":
    main()
