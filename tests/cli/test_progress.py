"""The progress bar, and what is left when somebody does not want to wait for its end."""

from __future__ import annotations

import os
import signal
import sys
import time
from io import StringIO
from pathlib import Path

import pytest

from burnish.commands import progress
from burnish.commands.progress import Progress

from ..suite.processes import started, until
from .kit import tree


class Terminal(StringIO):
    """Takes what is written, as a terminal."""

    def isatty(self) -> bool:
        return True


def shown(monkeypatch: pytest.MonkeyPatch, stream: StringIO, patience: float) -> str:
    """The text that is written when a task is a quarter done, and then completely."""
    monkeypatch.setattr(sys, "stderr", stream)
    monkeypatch.setattr(progress, "PATIENCE", patience)
    with Progress("drawing") as bar:
        bar.tell(0.25)
        if patience == 0:
            until(lambda: "25%" in stream.getvalue(), "the bar")
        bar.tell(1)
    bar.tell(1)
    return stream.getvalue()


def test_a_bar_on_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    text = shown(monkeypatch, Terminal(), 0)
    assert "drawing  [#########---------------------------]   25%" in text
    assert "drawing  [####################################]  100%" in text
    assert text.endswith("\n")


def test_no_bar_for_what_is_done_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    assert shown(monkeypatch, Terminal(), 60) == ""


def test_lines_above_the_bar(monkeypatch: pytest.MonkeyPatch) -> None:
    """The bar is deleted before a line is printed, and stands below the line afterwards."""
    stream = Terminal()
    monkeypatch.setattr(sys, "stderr", stream)
    monkeypatch.setattr(progress, "PATIENCE", 0)
    with Progress("drawing") as bar:
        bar.tell(0.25)
        until(lambda: "25%" in stream.getvalue(), "the bar")
        before = len(stream.getvalue())
        bar.aside(lambda: print("a line", file=stream))
        said = stream.getvalue()[before:]
    deleted, shown = said.split("a line\n")
    assert deleted == "\r\x1b[K"
    assert "25%" in shown


def test_no_bar_where_nobody_looks(monkeypatch: pytest.MonkeyPatch) -> None:
    stream = StringIO()
    monkeypatch.setattr(sys, "stderr", stream)
    monkeypatch.setattr(progress, "PATIENCE", 0)
    with Progress("drawing") as bar:
        bar.tell(0.5)
        time.sleep(0.1)
    assert stream.getvalue() == ""


@pytest.fixture
def empty(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An empty folder outside ``tmp_path``."""
    return tmp_path_factory.mktemp("empty")


@pytest.mark.parametrize(
    ("line", "at_work"),
    [
        ("render m.burnish -o new/m.png --size 4096", "/PIL/_imaging"),
        ("render m.burnish -o new/m.png --size 400 --on all", "/libvulkan"),
    ],
)
@pytest.mark.usefixtures("interruptible")
@pytest.mark.parametrize("everybody", [True, False], ids=["terminal", "kill"])
def test_interrupted(line: str, at_work: str, everybody: bool, tmp_path: Path, empty: Path) -> None:
    """Ctrl-C goes to all processes of a terminal; a signal may go to the command alone.

    The command ends at once, without a word and with all that it has started; nothing is written.
    """
    (tmp_path / "m.burnish").write_text("material Up { color = 0.5 + 0.5 * normal }\n")
    command = [sys.executable, "-m", "burnish", *line.split()]
    environment = {**os.environ, "BURNISH_CACHE": str(empty)}  # where no picture is known yet
    with started(command, cwd=tmp_path, env=environment) as program:
        until(lambda: any(at_work in known for known in program.family().values()), at_work)
        time.sleep(1)
        program.signal(signal.SIGINT, everybody=everybody)
        ended = program.ended()
        assert (ended.returncode, ended.stdout, ended.stderr) == (130, "", "")
        until(lambda: not program.family(), "the end of all that it has started")
    assert tree(tmp_path) == {"m.burnish"}
