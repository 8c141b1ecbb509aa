"""Folders to write into that came from somebody else: nothing outside of them changes.

Each test watches a folder beside the output folder, to which links of all kinds lead.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

import pytest

from burnish.commands.replacing import replace_all

from ..suite.processes import run
from .kit import PLAIN, invoke, shell, tree

OUTPUTS = {"Plain.json", "Plain.frag.wgsl", "Plain.vert.wgsl"}

Watched = Mapping[str, tuple[object, ...]]


def snapshot(folder: Path) -> Watched:
    """Everything below a folder: what it is, what it holds, and when it was last changed."""
    found: dict[str, tuple[object, ...]] = {}
    for path in (folder, *sorted(folder.rglob("*"))):
        status = path.lstat()
        content = path.read_bytes() if path.is_file() and not path.is_symlink() else b""
        found[str(path)] = (
            status.st_mode, status.st_ino, status.st_nlink, status.st_mtime_ns, status.st_ctime_ns,
            content,
        )  # fmt: skip
    return found


@pytest.fixture
def victim(tmp_path: Path) -> Iterator[Path]:
    """A folder that has to be afterwards exactly as it was."""
    folder = tmp_path / "victim"
    (folder / "deep").mkdir(parents=True)
    for name in ("id_rsa", "notes.txt", "lock", "a", "Plain.json", "deep/a"):
        (folder / name).write_text(f"the victim's {name}")
    before = snapshot(folder)
    yield folder
    assert snapshot(folder) == before


@pytest.fixture
def received(tmp_path: Path, victim: Path) -> Path:
    """A folder with a material and an output folder, as somebody else has made it."""
    assert victim.is_dir()
    folder = tmp_path / "received"
    (folder / "build").mkdir(parents=True)
    (folder / "m.burnish").write_text(PLAIN)
    return folder


def _old_leads_out(journal: Path, victim: Path) -> None:
    journal.mkdir(mode=0o700)
    (journal / "old").symlink_to(victim)


def _new_leads_out(journal: Path, victim: Path) -> None:
    journal.mkdir(mode=0o700)
    (journal / "new").symlink_to(victim)


def _new_leads_out_and_is_whole(journal: Path, victim: Path) -> None:
    _new_leads_out(journal, victim)
    (journal / "whole").touch()


def _whole_leads_out(journal: Path, victim: Path) -> None:
    journal.mkdir(mode=0o700)
    for name in ("whole", "lock"):
        (journal / name).symlink_to(victim / name)


def _it_leads_out_itself(journal: Path, victim: Path) -> None:
    journal.symlink_to(victim)


def _it_is_a_file(journal: Path, _: Path) -> None:
    journal.write_text("a file")


def _it_is_filled(journal: Path, _: Path) -> None:
    for name in ("new", "old"):
        (journal / name).mkdir(parents=True)
        (journal / name / "Plain.json").write_text("planted")
    (journal / "whole").touch()


@pytest.mark.parametrize(
    "plant",
    [
        _old_leads_out, _new_leads_out, _new_leads_out_and_is_whole, _whole_leads_out,
        _it_leads_out_itself, _it_is_a_file, _it_is_filled,
    ],
)  # fmt: skip
@pytest.mark.parametrize("times", [1, 2])
def test_a_planted_journal_is_left_as_it_is(
    plant: Callable[[Path, Path], None], times: int, received: Path, victim: Path
) -> None:
    """Former versions kept a journal of this name in the output folder, and believed it."""
    out = received / "build"
    for journal in (out / f".burnish-output-{os.getuid()}", out / ".burnish-output-0"):
        if not journal.exists():
            plant(journal, victim)
    before = {name: kept for name, kept in snapshot(out).items() if name != str(out)}
    for _ in range(times):
        done = shell("compile", "m.burnish", "-t", "wgsl", "-o", "build", folder=received)
        assert (done.returncode, done.stderr) == (0, "")
    after = snapshot(out)
    assert {name: after[name] for name in before} == before
    added = {os.path.relpath(name, out) for name in after.keys() - before.keys()} - {"."}
    assert added == OUTPUTS


@pytest.mark.parametrize("name", sorted(OUTPUTS))
@pytest.mark.parametrize("target", ["notes.txt", "missing", ".", "deep"])
def test_links_in_the_places_of_outputs_are_replaced(
    name: str, target: str, received: Path, victim: Path
) -> None:
    (received / "build" / name).symlink_to(victim / target)
    result = invoke("compile", received / "m.burnish", "-t", "wgsl", "-o", received / "build")
    assert (result.exit_code, result.stderr) == (0, "")
    assert tree(received / "build") == OUTPUTS
    assert not any(path.is_symlink() for path in (received / "build").iterdir())


@pytest.mark.parametrize("make", [os.mkfifo, lambda path: path.symlink_to(path.name)])
def test_pipes_and_circles_in_the_places_of_outputs_are_replaced(
    make: Callable[[Path], None], received: Path
) -> None:
    make(received / "build" / "Plain.json")
    result = invoke("compile", received / "m.burnish", "-t", "wgsl", "-o", received / "build")
    assert (result.exit_code, result.stderr) == (0, "")
    assert (received / "build" / "Plain.json").read_text().startswith("{")


def test_second_names_of_other_files_are_not_written_through(received: Path, victim: Path) -> None:
    """This happens in a folder that shares its files with another one, whose contents stay."""
    shared = received / "shared"
    shared.write_text("shared")
    os.link(shared, received / "build" / "Plain.json")
    line = ("compile", received / "m.burnish", "-t", "wgsl", "-o", received / "build")
    assert invoke(*line).exit_code == 1, "it is no file of Burnish"
    assert invoke(*line, "--force").exit_code == 0
    assert shared.read_text() == "shared"
    assert victim.is_dir()


def test_what_was_known_before_follows_no_link_either(
    received: Path, victim: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("BURNISH_CACHE", str(received.parent / "cache"))
    monkeypatch.delenv("BURNISH_VERIFY", raising=False)
    for _ in range(2):
        for name in OUTPUTS:
            (received / "build" / name).unlink(missing_ok=True)
            (received / "build" / name).symlink_to(victim / "notes.txt")
        done = shell("compile", "m.burnish", "-t", "wgsl", "-o", "build", folder=received)
        assert done.returncode == 0
        assert not any(path.is_symlink() for path in (received / "build").iterdir())
    assert list((received.parent / "cache").glob("private/result/*"))


@pytest.mark.parametrize("planted", ["link", "file", "folder"])
def test_a_random_name_that_somebody_has_guessed(
    planted: str, tmp_path: Path, victim: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(os, "urandom", bytes)
    out = tmp_path / "out"
    out.mkdir()
    (out / "a").write_text("old")
    guessed = out / f".burnish-{'00' * 16}"
    if planted == "link":
        guessed.symlink_to(victim / "missing")
    elif planted == "file":
        guessed.write_text("planted")
    else:
        guessed.mkdir()
    before = snapshot(out)
    with pytest.raises(FileExistsError, match=r"File exists: '.*/a'$"):
        replace_all(str(out), {"a": b"new"})
    assert snapshot(out) == before


def test_names_that_no_file_can_have(tmp_path: Path) -> None:
    for name, reason in (("x" * 256, "File name too long"), ("\ud800", "have all of its char")):
        with pytest.raises(OSError, match=reason):
            replace_all(str(tmp_path), {"a": b"new", name: b"new"})
        assert tree(tmp_path) == set()
    replace_all(str(tmp_path), {"x" * 255: b"as long as a name may be"})
    assert tree(tmp_path) == {"x" * 255}


@pytest.mark.parametrize(("how", "before"), [(">", ""), (">>", "kept\n")])
def test_standard_output_by_its_path(how: str, before: str, received: Path) -> None:
    """The system's own link is written through, and neither replaced nor refused."""
    (received / "printed").write_text("kept\n")
    command = f'exec "$0" -m burnish graph m.burnish --format dot -o /dev/stdout {how} printed'
    done = run(["sh", "-c", command, sys.executable], cwd=received)
    assert (done.returncode, done.stderr) == (0, "")
    assert (received / "printed").read_text().startswith(f"{before}digraph")
    assert Path("/dev/stdout").is_symlink()


def test_the_source_is_not_overwritten(received: Path) -> None:
    (received / "link.dot").symlink_to("m.burnish")
    for name in ("m.burnish", "./m.burnish", "link.dot"):
        result = invoke("graph", received / "m.burnish", "-o", received / name)
        assert result.exit_code == 2
        assert "Invalid value for --output: it is FILE itself" in result.stderr
    assert (received / "m.burnish").read_text() == PLAIN
