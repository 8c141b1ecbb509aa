"""The progress bar, and what is left when somebody does not want to wait for its end."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from io import StringIO
from pathlib import Path

import pytest

from burnish.commands import progress
from burnish.commands.progress import Progress

from .kit import tree


class Terminal(StringIO):
    """Takes what is written, as a terminal."""

    def isatty(self) -> bool:
        return True


def shown(monkeypatch: pytest.MonkeyPatch, stream: StringIO, patience: float) -> str:
    """What is written while something is a quarter done, and then all of it."""
    monkeypatch.setattr(sys, "stderr", stream)
    monkeypatch.setattr(progress, "PATIENCE", patience)
    with Progress("drawing") as bar:
        bar.tell(0.25)
        if patience == 0:
            until(lambda: "25%" in stream.getvalue())
        bar.tell(1)
    bar.tell(1)
    return stream.getvalue()


def until(condition: Callable[[], object]) -> None:
    """Waits for something that has to happen soon."""
    end = time.monotonic() + 60
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.02)


def test_a_bar_on_a_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    text = shown(monkeypatch, Terminal(), 0)
    assert "drawing  [#########---------------------------]   25%" in text
    assert "drawing  [####################################]  100%" in text
    assert text.endswith("\n")


def test_no_bar_for_what_is_done_at_once(monkeypatch: pytest.MonkeyPatch) -> None:
    assert shown(monkeypatch, Terminal(), 60) == ""


def test_no_bar_where_nobody_looks(monkeypatch: pytest.MonkeyPatch) -> None:
    stream = StringIO()
    monkeypatch.setattr(sys, "stderr", stream)
    monkeypatch.setattr(progress, "PATIENCE", 0)
    with Progress("drawing") as bar:
        bar.tell(0.5)
        time.sleep(0.1)
    assert stream.getvalue() == ""


def marked(mark: str) -> Mapping[int, str]:
    """All processes that were started with a mark, by any way: command lines, loaded libraries."""
    found = {}
    for folder in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):
            if mark.encode() in (folder / "environ").read_bytes():
                files = (folder / "cmdline", folder / "maps")
                found[int(folder.name)] = "\n".join(file.read_text() for file in files)
    return found


@pytest.mark.parametrize(
    ("line", "at_work"),
    [
        ("render m.burnish -o new/m.png --size 4096", "/PIL/_imaging"),
        ("render m.burnish -o new/m.png --size 400 --on all", "/libvulkan"),
        ("conform m.burnish --report new --seed {seed}", "/chromium\0"),
    ],
)
@pytest.mark.usefixtures("interruptible")
@pytest.mark.parametrize("everybody", [True, False], ids=["terminal", "kill"])
def test_interrupted(line: str, at_work: str, everybody: bool, tmp_path: Path) -> None:
    """By Ctrl-C, which goes to all processes of a terminal, or by a signal to the command alone.

    It ends at once, without a word and with everything that it has started; nothing is written.
    """
    mark = f"BURNISH_TEST_MARK={tmp_path}"
    name, _, value = mark.partition("=")
    (tmp_path / "m.burnish").write_text("material Up { color = 0.5 + 0.5 * normal }")
    process = subprocess.Popen(
        [sys.executable, "-m", "burnish", *line.format(seed=time.time_ns()).split()],
        cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True,
        env={**os.environ, name: value},
    )  # fmt: skip
    until(lambda: any(at_work in known for known in marked(mark).values()))
    time.sleep(1)
    (os.killpg if everybody else os.kill)(process.pid, signal.SIGINT)
    assert process.communicate(timeout=60) == (b"", b"")
    assert process.returncode == 130
    until(lambda: not marked(mark))
    assert tree(tmp_path) == {"m.burnish"}
