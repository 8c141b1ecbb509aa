"""Folders that are shown, whose files have any names, links lead anywhere, and comments ask for
anything.

``received.py`` tries them. Only files of the folder are shown, each on a page of its own; addresses
in pages lead to files beside them; and comments make nothing be read elsewhere.
"""

from __future__ import annotations

import os
from collections.abc import Callable
from itertools import islice
from pathlib import Path
from random import Random

from burnish.commands.catalogue import ENDING, README, catalogue, title_of
from burnish.commands.comments import FOLLOWED, asked, files_of
from burnish.commands.gallery.entry import Entry, failed
from burnish.commands.gallery.making import source_of
from burnish.commands.gallery.pages import pages
from burnish.commands.render import render

from ...cli.hostile_folder import SECRET, Reader
from .names import hostile_names

SHARE_WRITTEN = 0.1
"""The share of folders whose pages are written, since making templates takes long."""
VALUES = (
    "1", "a=1", "t=own.png", "t=../private", "t=/dev/zero", "t=srgb:up/private", "t=link,own.png",
    "knot", "99999999999999999999", "", "'", "#fff", "x.png", "../x.png", "a=b=c", "=", "t=\0",
)  # fmt: skip


def trial() -> Callable[[Random, Path], None]:
    """The function that shows a random folder."""
    return _show


def _show(random: Random, base: Path) -> None:
    root = base / "shown"
    root.mkdir()
    private = base / "private"
    private.write_text(SECRET)
    names = list(dict.fromkeys(islice(hostile_names(random), random.randint(1, 6))))
    own = {name for name in names if _planted(random, root / f"{name}{ENDING}", private)}
    lines = [f"[{name}]({name}{ENDING}): {name}" for name in names]
    (root / README).write_bytes(os.fsencode("\n".join(random.sample(lines, len(lines)))))
    groups = catalogue(root)
    files = [each for group in groups for each in group.files]
    assert {each.name.removesuffix(ENDING) for each in files} == {
        name for name in own if not name.startswith(".")
    }
    entries: dict[str, Entry] = {}
    for each in files:
        source, problem = source_of(each.path, root)
        assert not problem and SECRET not in source
        found = asked(source, each.path.name, root, 256, render)
        for _name, value in found.options.get("values", ()):
            assert private not in map(Path.resolve, files_of(value, root))
        entries[each.name] = {**failed(source, found.note), "names": [each.name]}
    title = title_of(root)
    if not files or random.random() > SHARE_WRITTEN:
        return
    written = pages(title, groups, entries, ())
    assert len(written) == len(files) + 1
    for content in written.values():
        page = Reader(content.decode())
        assert SECRET not in page.text and page.tags.count("script") == 1
        assert set(page.files()) <= set(written)


def _planted(random: Random, path: Path, private: Path) -> bool:
    """Put something at a path; whether it is a file of the folder."""
    kind = random.choice(("file", "file", "link", "loop", "folder", "pipe"))
    if kind == "file":
        path.write_bytes(os.fsencode(_source(random, path.name)))
    elif kind == "link":
        path.symlink_to(private)
    elif kind == "loop":
        path.symlink_to(path.name)
    elif kind == "folder":
        path.mkdir()
    else:
        os.mkfifo(path)
    return kind == "file"


def _source(random: Random, name: str) -> str:
    """A comment with a command and some text."""
    options = [*FOLLOWED, "--scene", "-I", "--on", "--budget", "--"]
    words = (f"{random.choice(options)} {random.choice(VALUES)}" for _ in range(3))
    text = "".join(islice(hostile_names(random), 3))
    return f"//!     burnish render '{name}' {' '.join(words)}\n//! {text}\n/// {text}\n"
