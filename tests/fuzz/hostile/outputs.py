"""Folders into which a command writes, full of whatever somebody has left there.

``received.py`` tries them. The outputs are written whole or not at all, and everything else stays
as it was: files outside that links lead to, and what lies between the outputs.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from pathlib import Path
from random import Random

from burnish.commands.replacing import replace_all

OUTPUTS = ("Good.frag.wgsl", "Good.json", "Good.plan.json", "good.png", "index.html")
FOREIGN = (
    f".burnish-output-{os.getuid()}", ".burnish-0123456789abcdef", "lock", "new", "old", "whole",
    ".tmp", "notes", "sub",
)  # fmt: skip
"""Names of what no command has written; some are those of an earlier version's journal."""

State = dict[str, tuple[int, bytes]]


def trial() -> Callable[[Random, Path], None]:
    """The function that writes into a random folder."""
    return _write


def _write(random: Random, base: Path) -> None:
    outside, output = base / "outside", base / "output"
    for folder in (outside, output):
        folder.mkdir()
    (outside / "id").write_bytes(b"secret")
    contents = {
        name: random.randbytes(random.choice((0, 1, 70_000)))
        for name in random.sample(OUTPUTS, random.randint(1, len(OUTPUTS)))
    }
    for name in (*OUTPUTS, *FOREIGN):
        if random.random() < 0.4:
            _plant(random, output / name, outside)
    before, foreign = _state(base), _state(base, without=contents)
    try:
        replace_all(str(output), contents)
    except OSError:
        assert _state(base) == before
        return
    assert _state(base, without=contents) == foreign
    for name, content in contents.items():
        assert not (output / name).is_symlink()
        assert (output / name).read_bytes() == content


def _plant(random: Random, path: Path, outside: Path) -> None:
    """Put something at a path."""
    kind = random.choice(("file", "link", "link", "dangling", "loop", "folder", "full", "pipe"))
    if kind == "file":
        path.write_bytes(b"foreign")
        path.chmod(random.choice((0o644, 0o400, 0o000)))
    elif kind == "pipe":
        os.mkfifo(path)
    elif kind in ("folder", "full"):
        path.mkdir()
        if kind == "full":
            for name in ("old", "new", "whole", "lock"):
                if random.random() < 0.5:
                    _plant(random, path / name, outside)
    else:
        targets = {
            "link": (outside, outside / "id"),
            "dangling": (outside / "none",),
            "loop": (path,),
        }
        path.symlink_to(random.choice(targets[kind]))


def _state(base: Path, without: object = ()) -> State:
    return dict(_files(base, set(without) if isinstance(without, dict) else set()))


def _files(base: Path, without: set[str]) -> Iterator[tuple[str, tuple[int, bytes]]]:
    """Everything below a folder but for some names in the output: its kind, and its content."""
    for path in base.rglob("*"):
        if path.parent.name == "output" and path.name in without:
            continue
        mode = path.lstat().st_mode
        if path.is_symlink():
            content = os.fsencode(path.readlink())
        else:
            content = path.read_bytes() if path.is_file() and mode & 0o400 else b""
        yield str(path.relative_to(base)), (mode, content)
