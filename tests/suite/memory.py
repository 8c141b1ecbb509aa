"""The most memory of a process so far, and of a piece of Python in a process of its own."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from resource import RUSAGE_SELF, getrusage

from .processes import run

_AROUND = """\
import resource, sys
resource.setrlimit(resource.RLIMIT_AS, (6 * 10**9, 6 * 10**9))
{code}
from burnish.tests.suite.memory import most_memory
print(most_memory())
"""


def most_memory() -> int:
    """The most bytes of memory that this process had at a time.

    On Linux, what ``getrusage`` says of a process includes the memory of the one that started it.
    """
    try:
        found = re.search(r"VmHWM:\s*(\d+) kB", Path("/proc/self/status").read_text("ascii"))
    except FileNotFoundError:
        found = None
    if found:
        return int(found[1]) * 1024
    most = getrusage(RUSAGE_SELF).ru_maxrss
    return most if sys.platform == "darwin" else most * 1024


def measured(code: str, *arguments: str) -> tuple[str, int]:
    """The output of a piece of Python with these arguments in ``sys.argv``, and the most bytes of
    memory that its process had at a time."""
    command = [sys.executable, "-c", _AROUND.format(code=code), *arguments]
    done = run(command, check=True)
    *lines, peak = done.stdout.splitlines()
    return "\n".join(lines), int(peak)
