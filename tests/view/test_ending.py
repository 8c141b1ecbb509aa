"""``burnish view`` ends at once, whatever it is doing, and works only if it is asked."""

from __future__ import annotations

import signal
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from ..suite.processes import Background, Program, started, until
from .kit import FLAT, Viewer, viewing

ENDLESS = """
import sys
from burnish.commands import cli
from burnish.api import entry_points as api

made = api.declared
quick = int(sys.argv.pop(1))

def endless(*arguments, **options):
    global quick
    quick -= 1
    if quick >= 0:
        return made(*arguments, **options)
    print("busy", flush=True)
    while True:
        sum(range(1000))

api.declared = endless
cli.main()
"""
"""Shows a file of which so many documents are made as usual, and none of the others ever ends."""


@pytest.mark.usefixtures("interruptible")
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
@pytest.mark.parametrize("quick", [0, 1], ids=["the first", "a later one"])
def test_while_a_document_is_made(quick: int, number: signal.Signals, tmp_path: Path) -> None:
    """The document is one that would never be finished."""
    file, said = tmp_path / "m.burnish", tmp_path / "said"
    file.write_text(FLAT)
    command = [sys.executable, "-c", ENDLESS, str(quick), "view", file.name, "--no-browser"]
    with said.open("w") as stream, started(command, cwd=tmp_path, stderr=stream) as program:
        address = program.line().decode().partition(" is shown at ")[2].strip()
        viewer = Viewer(program, address, said)
        if quick:
            assert viewer.ask("/document").status == 200
            Background(lambda: viewer.ask("/document?mesh=cube"))
        until(lambda: program.line() == b"busy\n", "the document is being made")
        assert viewer.ask("/web_view/main.js").status == 200
        program.signal(number)
        ended = program.ended()
    # Where nothing is left to wait for, SIGTERM itself ends the process.
    is_by_signal = number == signal.SIGTERM and ended.returncode == -number
    assert is_by_signal or ended.returncode == 128 + number
    assert said.read_text() == ""


def test_nothing_to_do_takes_nothing(tmp_path: Path) -> None:
    """Once its documents are made, a server of many opened files has one thread that looks for
    changes, and rests."""
    for number in range(60):
        (tmp_path / f"{number}.burnish").write_text(FLAT)
    with viewing(tmp_path) as viewer:
        for number in range(60):
            assert viewer.ask(f"/document?file={number}.burnish").status == 200
        until(_resting(viewer.program), "it rests", pause=1.0)
        opened = Path(f"/proc/{viewer.program.pid}/fd").iterdir()
        assert sum("inotify" in str(each.readlink()) for each in opened) == 1


def _resting(program: Program) -> Callable[[], bool]:
    """A function: true if a program has worked less than 5 clock ticks since its last call."""
    before = [0]

    def is_resting() -> bool:
        stat = Path(f"/proc/{program.pid}/stat").read_text().rpartition(")")[2].split()
        ticks = int(stat[11]) + int(stat[12])
        before.append(ticks)
        return before[-1] - before[-2] < 5

    return is_resting
