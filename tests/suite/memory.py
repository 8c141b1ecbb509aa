"""How much memory a piece of Python takes in a process of its own."""

from __future__ import annotations

import sys

from .processes import run

_AROUND = """\
import resource, sys
resource.setrlimit(resource.RLIMIT_AS, (6 * 10**9, 6 * 10**9))
{code}
with open("/proc/self/status") as status:
    peak = next(line.split()[1] for line in status if line.startswith("VmHWM"))
print(int(peak) * 1024)
"""


def measured(code: str, *arguments: str) -> tuple[str, int]:
    """What a piece of Python prints, with these arguments in ``sys.argv``, and the most bytes of
    memory that its process had at a time."""
    command = [sys.executable, "-c", _AROUND.format(code=code), *arguments]
    done = run(command, check=True)
    *lines, peak = done.stdout.splitlines()
    return "\n".join(lines), int(peak)
