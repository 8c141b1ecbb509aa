"""``burnish conform`` that a signal ends: the rows so far, a report that is unfinished, no process.

Rows are printed while others are still worked on, also where there is no terminal.
"""

from __future__ import annotations

import json
import os
import pty
import signal
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from threading import Thread
from xml.etree import ElementTree

import pytest

from ..suite.processes import Program, started, until

pytestmark = pytest.mark.usefixtures("interruptible")

QUICK = "material Quick { color = 0.5 + 0.5 * normal }\n"
SLOW = """\
material Slow {
    color = vec3(0.001 * (sum j in 0..20 : sum i in 0..999 : sin(uv.x * float(i + j))))
}
"""
"""A material that the reference needs minutes to draw, and a driver a moment."""
ENDING = {
    "int": (signal.SIGINT, False, 130),
    "int to the group": (signal.SIGINT, True, 130),
    "term": (signal.SIGTERM, False, 143),
    "hangup": (signal.SIGHUP, False, 129),
}
"""The signal, whether all processes of the terminal get it, and the exit code."""
LINE = "--routes lavapipe:glsl,llvmpipe:gl330 --report report"
EXPLAINED = "--routes lavapipe:glsl --explain 36,28"
BURNISH = """
import os, runpy
os.cpu_count = lambda: 2
runpy.run_module("burnish", run_name="__main__")
"""
"""Burnish on a machine of two processors, so that one can be busy with what takes long."""


@pytest.fixture
def place(tmp_path: Path) -> Path:
    """A folder with files of which the last one takes long."""
    (tmp_path / "place").mkdir()
    for name in ("a", "b", "c"):
        (tmp_path / "place" / f"{name}.burnish").write_text(QUICK)
    (tmp_path / "place" / "d.burnish").write_text(SLOW)
    return tmp_path / "place"


def command(names: Sequence[str], line: str = LINE) -> list[str]:
    files = [f"{name}.burnish" for name in names]
    return [sys.executable, "-c", BURNISH, "conform", *files, *line.split()]


def environment(place: Path) -> dict[str, str]:
    """An environment in which no picture is known yet, with a folder for temporary files."""
    temporary = place.parent / "temporary"
    temporary.mkdir(exist_ok=True)
    cache = place.parent / "cache"
    return {**os.environ, "BURNISH_CACHE": str(cache), "TMPDIR": str(temporary)}


class Screen:
    """Whatever is written to a terminal, as it comes."""

    def __init__(self, reading: int) -> None:
        self._reading = reading
        self.text = ""
        self._thread = Thread(target=self._read, daemon=True)
        self._thread.start()

    def _read(self) -> None:
        try:
            while data := os.read(self._reading, 1 << 16):
                self.text += data.decode()
        except OSError:
            return  # All that had the terminal have ended.

    def ended(self) -> str:
        """The whole text, when nobody can write any more."""
        self._thread.join(10)
        return self.text


@contextmanager
def on_terminal(words: list[str], place: Path) -> Iterator[tuple[Program, Screen]]:
    """Start a program whose output is a terminal."""
    reading, writing = pty.openpty()
    screen = Screen(reading)
    try:
        with started(
            words, cwd=place, env=environment(place), stdin=writing, stdout=writing, stderr=writing
        ) as program:
            os.close(writing)
            yield program, screen
    finally:
        os.close(reading)


def check_report(place: Path, known: int, of: int) -> None:
    folder = place / "report"
    report = json.loads((folder / "report.json").read_text())
    assert report["unfinished"] == {"known": known, "of": of}
    assert len(report["rows"]) == known
    assert {row["status"] for row in report["rows"]} <= {"agrees"}
    suites = ElementTree.parse(folder / "junit.xml").getroot()
    assert (suites.get("tests"), suites.get("errors")) == (str(known + 1), "1")
    said = f"unfinished, {known} of {of} rows"
    (error,) = suites.iter("error")
    assert error.get("message") == said
    assert said in (folder / "index.html").read_text()


@pytest.mark.parametrize("how", ENDING)
def test_without_a_terminal(how: str, place: Path) -> None:
    number, everybody, code = ENDING[how]
    with started(command("abcd"), cwd=place, env=environment(place)) as program:
        lines = [program.line().decode() for _ in range(10)]
        assert lines[1::3] == [f"{name}.burnish: Quick\n" for name in "abc"]
        assert [line.split()[1] for line in lines if line.startswith("  l")] == ["agrees"] * 6
        assert list((place.parent / "temporary").iterdir())
        program.signal(number, everybody=everybody)
        ended = program.ended()
        until(lambda: not program.family(), "the end of all that was started", limit=20)
    assert (ended.returncode, ended.stderr) == (code, "")
    assert "\nunfinished, 6 of 8 rows: 6 agree\n" in ended.stdout
    assert not list((place.parent / "temporary").iterdir())
    check_report(place, 6, 8)


@pytest.mark.parametrize("how", ENDING)
def test_on_a_terminal(how: str, place: Path) -> None:
    """Rows stand above the bar of progress."""
    number, everybody, code = ENDING[how]
    with on_terminal(command("abcd"), place) as (program, screen):
        until(lambda: screen.text.count("agrees") == 6 and "75%" in screen.text, "the rows")
        program.signal(number, everybody=everybody)
        assert program.exit_code(20) == code
        until(lambda: not program.family(), "the end of all that was started", limit=20)
        text = screen.ended()
    assert "\nunfinished, 6 of 8 rows: 6 agree\r\n" in text
    assert "Traceback" not in text
    check_report(place, 6, 8)


@pytest.mark.parametrize("how", ENDING)
def test_explaining(how: str, place: Path) -> None:
    """Nothing is explained, also of what was drawn, and no error is told."""
    number, everybody, code = ENDING[how]
    with on_terminal(command("ad", EXPLAINED), place) as (program, screen):
        until(lambda: "50%" in screen.text, "one of two materials")
        program.signal(number, everybody=everybody)
        assert program.exit_code(20) == code
        until(lambda: not program.family(), "the end of all that was started", limit=20)
        text = screen.ended()
    assert not any(word in text for word in ("Traceback", "error", "pixel", "unfinished"))


def test_many_signals(place: Path) -> None:
    """A terminal sends one, and a parent process another: the report is whole.

    Python may handle another one first than has come first.
    """
    with started(command("abcd"), cwd=place, env=environment(place)) as program:
        for _ in range(10):
            program.line()
        for number in (signal.SIGTERM, signal.SIGINT, signal.SIGINT, signal.SIGTERM):
            program.signal(number, everybody=True)
        ended = program.ended()
        until(lambda: not program.family(), "the end of all that was started", limit=20)
    assert (ended.returncode in (130, 143), ended.stderr) == (True, "")
    check_report(place, 6, 8)


SIGNALLED = """
import os, runpy, signal
from burnish.commands import conform
write = conform.write_report
def write_report(*arguments, **options):
    os.kill(os.getpid(), signal.SIGTERM)
    write(*arguments, **options)
conform.write_report = write_report
runpy.run_module("burnish", run_name="__main__")
"""
"""Burnish, to which a signal comes when it begins to write the report."""


def test_when_all_is_known(place: Path) -> None:
    """The run ends, but nothing is unfinished."""
    words = [sys.executable, "-c", SIGNALLED, *command("abc")[3:]]
    with started(words, cwd=place, env=environment(place)) as program:
        ended = program.ended()
    assert (ended.returncode, ended.stderr) == (143, "")
    assert ended.stdout.endswith("\n6 agree\nreport: report/index.html\n")
    report = json.loads((place / "report" / "report.json").read_text())
    assert len(report["rows"]) == 6 and not report.get("unfinished")
    suites = ElementTree.parse(place / "report" / "junit.xml").getroot()
    assert (suites.get("tests"), suites.get("errors")) == ("6", "0")


def test_rows_behind_one_that_is_missing(place: Path) -> None:
    """They are not printed before it; but if the run is ended, they are known all the same."""
    with on_terminal(command("adbc"), place) as (program, screen):
        until(lambda: "75%" in screen.text, "six rows")
        assert screen.text.count("agrees") == 2
        program.signal(signal.SIGINT)
        assert program.exit_code(20) == 130
        assert screen.ended().count("agrees") == 6
    check_report(place, 6, 8)


def test_before_anything_is_drawn(place: Path) -> None:
    """A signal that comes while tools are looked for: the report says that nothing was drawn."""
    tool = place.parent / "tools" / "glslang" / "bin" / "glslangValidator"
    tool.parent.mkdir(parents=True)
    tool.write_text("#!/bin/sh\n/bin/sleep 600\n")
    tool.chmod(0o755)
    known = {**environment(place), "BURNISH_TOOLS": str(tool.parents[2])}
    with started(command("abc"), cwd=place, env=known) as program:
        until(lambda: any("sleep" in text for text in program.family().values()), "a tool")
        program.signal(signal.SIGTERM)
        ended = program.ended()
        until(lambda: not program.family(), "the end of all that was started", limit=20)
    assert (ended.returncode, ended.stderr) == (143, "")
    assert "unfinished, nothing was drawn yet\n" in ended.stdout
    report = json.loads((place / "report" / "report.json").read_text())
    assert report["unfinished"] == {"known": 0, "of": None} and report["rows"] == []
