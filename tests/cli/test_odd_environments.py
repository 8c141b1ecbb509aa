"""Commands do their work, or say in a sentence why not, in environments that are not as usual.

Each runs in a process of its own, set up by a shell.
"""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

from ..suite.processes import Program, run, started, until

NOBODY = """
import pwd

def unknown(_):
    raise KeyError

pwd.getpwuid = unknown
from burnish.commands.cli import main
main()
"""
"""Runs a command as a user without an entry in the password file."""
MATERIAL = "material Main { color = vec3(0.5) }  // naïve\n"
WRITTEN = ["Main.frag.wgsl", "Main.json", "Main.vert.wgsl"]
COMMANDS = {
    "targets": 0,
    "explain B0201": 0,
    "graph main.burnish": 0,
    "check main.burnish": 0,
    "check wrong.burnish": 1,
    "check wrong.burnish --format json": 1,
    "compile main.burnish -t wgsl -o -": 0,
    "compile main.burnish": 2,
    "render main.burnish -o out.png --size 4": 0,
    "conform --help": 0,
    "--help": 0,
    "--version": 0,
}
"""The exit code of each."""


@pytest.fixture
def place(tmp_path: Path) -> Path:
    """A folder with materials; nothing but what commands write into it is ever added to it."""
    folder = tmp_path / "place"
    folder.mkdir()
    (folder / "main.burnish").write_text(MATERIAL, "utf-8")
    (folder / "wrong.burnish").write_text("material Wrong { color = size }  // größe\n", "utf-8")
    return folder


def environment(place: Path, **variables: str) -> dict[str, str]:
    """The variables that Python and Burnish need, and nothing else but ``variables``."""
    return {"PATH": os.environ["PATH"], "HOME": str(place.parent / "home")} | variables


def outcome(
    place: Path, arguments: str, variables: Mapping[str, str], shell: str = "", nobody: str = ""
) -> tuple[int, str]:
    """A command's exit code and all that it says."""
    start = ["-c", nobody] if nobody else ["-m", "burnish"]
    line = ["/bin/sh", "-c", f'{shell}; exec "$@"' if shell else 'exec "$@"', "sh"]
    ended = run([*line, sys.executable, *start, *arguments.split()], cwd=place, env=variables)
    said = ended.stdout + ended.stderr
    for word in ("Traceback", "Exception ignored", "Error in sys"):
        assert word not in said, said
    return ended.returncode, said


def check(place: Path, variables: Mapping[str, str], shell: str = "", nobody: str = "") -> None:
    """Compile twice, and see a mistake explained; nothing else is left in the current folder."""
    for _ in range(2):
        compiled = outcome(place, "compile main.burnish -t wgsl -o out", variables, shell, nobody)
        assert compiled[0] == 0, compiled[1]
        assert sorted(path.name for path in (place / "out").iterdir()) == WRITTEN
    code, said = outcome(place, "check wrong.burnish", variables, shell, nobody)
    assert code == 1
    assert "B0201" in said or "2>&-" in shell
    assert {path.name for path in place.iterdir()} == {"main.burnish", "wrong.burnish", "out"}


@pytest.mark.parametrize("nobody", ["", NOBODY], ids=["user", "nobody"])
@pytest.mark.parametrize("home", [None, "", "home", "~", "/nowhere/at/all", os.devnull])
def test_homes(place: Path, home: str | None, nobody: str) -> None:
    variables = environment(place)
    variables.pop("HOME")
    check(place, variables if home is None else variables | {"HOME": home}, nobody=nobody)


@pytest.mark.parametrize(
    "variables",
    [
        {"TMPDIR": "/nowhere"},
        {"LC_ALL": "C"},
        {"LC_ALL": "POSIX", "PYTHONCOERCECLOCALE": "0", "PYTHONUTF8": "0"},
        {"LC_ALL": "xx_YY.nothing"},
        {"PYTHONIOENCODING": "ascii"},
        {"PYTHONOPTIMIZE": "2"},
        {"COLUMNS": "0"},
        {"COLUMNS": "-1", "LINES": "x"},
        {"TERM": ""},
        {"XDG_CACHE_HOME": "relative"},
        {"BURNISH_CACHE": "/nowhere/at/all"},
        {"BURNISH_TOOLS": "~"},
    ],
    ids=str,
)
def test_variables(place: Path, variables: Mapping[str, str]) -> None:
    check(place, environment(place, **variables))


@pytest.mark.parametrize(
    "shell",
    [
        "exec <&-",
        "exec >&-",
        "exec 2>&-",
        "exec <&- >&- 2>&-",
        "trap '' INT TERM HUP PIPE CHLD",
        "ulimit -n 16",
    ],
)
def test_processes(place: Path, shell: str) -> None:
    check(place, environment(place), shell)


@pytest.mark.parametrize("command", COMMANDS)
def test_nobody_in_a_narrow_world(place: Path, command: str) -> None:
    """No home, password entry, terminal, temporary folder or standard input exists; only ASCII."""
    variables = environment(place, TMPDIR="/nowhere", LC_ALL="C", PYTHONUTF8="0", COLUMNS="0")
    variables |= {"HOME": "", "PYTHONIOENCODING": "ascii"}
    code, said = outcome(place, command, variables, "exec <&-", NOBODY)
    assert code == COMMANDS[command], said


@pytest.mark.parametrize("command", COMMANDS)
def test_a_full_disk_behind_the_output(place: Path, command: str) -> None:
    """A command that would succeed fails with a message; one that fails keeps its exit code."""
    code, said = outcome(place, command, environment(place), "exec >/dev/full")
    silent = command == "check main.burnish"
    assert code == (0 if silent else COMMANDS[command] or 1)
    assert ("No space left on device" in said) == (code == 1 and command != "check wrong.burnish")


@pytest.mark.parametrize("command", COMMANDS)
def test_no_output_at_all(place: Path, command: str) -> None:
    shell = "exec >/dev/full 2>/dev/full"
    code, said = outcome(place, command, environment(place), shell)
    assert said == ""
    assert code == (0 if command == "check main.burnish" else 1)


def test_a_mask_that_forbids_everything(place: Path) -> None:
    """A user with all rights, such as root, may use the files; others get an error."""
    compile_ = "compile main.burnish -t wgsl -o out"
    code, said = outcome(place, compile_, environment(place), "umask 777")
    assert code == 0 or "cannot write to `out`" in said
    kept = place.parent / "home/.cache/burnish/private"
    assert not kept.exists() or kept.stat().st_mode & 0o777 == 0o700


def test_a_first_process_can_be_ended(place: Path) -> None:
    """In a container, Burnish may have the number 1, for which the kernel ignores signals that
    nobody listens to: there is no number 1 to be had here, so signals are ignored beforehand.
    """
    told = "import os, sys\nos.getpid = lambda: 1\nfrom burnish.commands.cli import main\nmain()"
    words = ["compile", "main.burnish", "-t", "wgsl", "-o", "out", "--watch"]
    line = ["/bin/sh", "-c", 'trap "" TERM; exec "$@"', "sh", sys.executable, "-c", told, *words]

    def written(program: Program) -> bool:
        return (place / "out" / "Main.json").exists() and program.runs()

    with started(line, cwd=place, env=environment(place)) as program:
        until(lambda: written(program), "the first compile")
        until(lambda: ended(program), "the end of the process", pause=0.2)
        assert program.exit_code() == 143


def ended(program: Program) -> bool:
    """Ask a program to end; whether it has."""
    if program.runs():
        program.signal(signal.SIGTERM)
    return not program.runs()
