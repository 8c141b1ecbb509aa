"""A folder of which everything is meant to do harm to ``burnish gallery``, and what it is after.

``test_gallery_hostile.py`` shows it.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from html.parser import HTMLParser
from itertools import islice
from pathlib import Path
from random import Random
from urllib.parse import unquote

from PIL import Image

from ..fuzz.hostile.names import PIECES, hostile_names

SECRET = "PRIVATE-WORDS"
"""A text that stands only in files that nobody may see."""
SECRET_COLOR = (193, 7, 111)
"""The colour of a picture that nobody may see."""
OWN_COLOR = (10, 200, 30)
PLAIN = "material M { color = vec3(0.6) }\n"
MODULE = "fn half(x: float) -> float = 0.5 * x\n"
TEXTURED = "material M { map t : texture2d with { mip = none }\n color = t(uv).rgb }\n"
READING = "material M { buffer b : float[]\n color = vec3(b[0]) }\n"

COMMENTS = {
    "outside": ("--set t={outside}/private.png", TEXTURED),
    "above": ("--set t=../private.png", TEXTURED),
    "by-link": ("--set t=link.png", TEXTURED),
    "by-link-srgb": ("--set=t=srgb:link.png", TEXTURED),
    "link-that-is-a-number": ("--set t=1", TEXTURED),
    "in-hidden": ("--set t=.hidden/private.png", TEXTURED),
    "endless": ("--set b=/dev/zero", READING),
    "no-file": ("--set b=pipe.json", READING),
    "scene": ("--scene {outside}/private.png", PLAIN),
    "search": ("-I {outside}", PLAIN),
    "device": ("--device 0", PLAIN),
    "route": ("--on all", PLAIN),
    "written": ("-o {outside}/written.png", PLAIN),
    "many-frames": ("--frames 9999", PLAIN),
    "budget": ("--budget memory=99G", PLAIN),
    "no-value": ("--mesh", PLAIN),
    "nonsense": ("--mesh nonsense", PLAIN),
    "apostrophe": ("-o x.png, it's fine", PLAIN),
    "help": ("--help", PLAIN),
}  # fmt: skip
"""The options that the comments of some files ask for, and the rest of these files."""


def fill(outside: Path) -> Path:
    """Make the folder, and private files beside it."""
    folder = outside / "shown"
    (folder / ".hidden").mkdir(parents=True)
    (folder / ".git").mkdir()
    private = outside / "private.burnish"
    private.write_text(f"# {SECRET}\n")
    (folder / ".git" / "config").write_text(f"[core]\n\turl = https://{SECRET}@x/\n")
    Image.new("RGB", (8, 8), SECRET_COLOR).save(outside / "private.png")
    Image.new("RGB", (8, 8), SECRET_COLOR).save(folder / ".hidden" / "private.png")
    Image.new("RGB", (8, 8), OWN_COLOR).save(folder / "own.png")
    for name, (options, text) in COMMENTS.items():
        asked = options.format(outside=outside)
        comment = f"//!     burnish render {name}.burnish {asked}\n"
        (folder / f"{name}.burnish").write_text(comment + text)
    own = "//!     burnish render own.burnish -o own.png --set t=srgb:own.png --mesh plane\n"
    (folder / "own.burnish").write_text(own + TEXTURED)
    (folder / "prose.burnish").write_text(f"//! `burnish render prose.burnish -o x`\n{PLAIN}")
    (folder / "-o.burnish").write_text(PLAIN)
    (folder / "javascript:alert(1).burnish").write_text(PLAIN)
    (folder / "a#b?c%d.burnish").write_text(PLAIN)
    (folder / "quotes-it.burnish").write_text(f'import ".git/config".{{url}}\n{PLAIN}')
    (folder / "markup.burnish").write_text(
        f"//! </p><script>alert(1)</script> `<img src=x onerror=alert(1)>` [a](javascript:b)\n"
        f"/// </pre><script>alert(1)</script> \u202e\x1b[2J\n{PLAIN}"
    )
    (folder / "large.burnish").write_text(" " * 300_000)
    with (folder / "holes.burnish").open("wb") as holes:
        holes.truncate(10 * 10**9)
    (folder / "README.md").symlink_to(private)
    (folder / "link.burnish").symlink_to(private)
    (folder / "git.burnish").symlink_to(folder / ".git" / "config")
    (folder / "text.burnish").symlink_to(folder / "own.png")
    (folder / "circle.burnish").symlink_to(folder / "circle.burnish")
    (folder / "gone.burnish").symlink_to(outside / "gone")
    (folder / "up").symlink_to(outside)
    (folder / "zero.burnish").symlink_to("/dev/zero")
    (folder / "link.png").symlink_to(outside / "private.png")
    (folder / "1").symlink_to(outside / "private.png")
    os.mkfifo(folder / "pipe.json")
    os.mkfifo(folder / "pipe.burnish")
    (folder / "folder.burnish").mkdir()
    _write_names(folder / "names")
    return folder


def _write_names(folder: Path) -> None:
    """A file of each name that this file system allows."""
    folder.mkdir()
    pieces = [piece for kind in PIECES.values() for piece in kind]
    for name in (*pieces, *islice(hostile_names(Random(1)), 30)):
        (folder / f"{name}.burnish").write_text(MODULE)


class Reader(HTMLParser):
    """Collects the addresses that a page may lead to or load, and the code that it may run."""

    ADDRESSES = ("href", "src", "srcset", "action", "formaction", "data", "poster", "xlink:href")

    def __init__(self, text: str) -> None:
        super().__init__(convert_charrefs=True)
        self.addresses: list[str] = []
        self.ids: set[str] = set()
        self.attributes: set[str] = set()
        self.tags: list[str] = []
        self.policy = ""
        self.text = ""
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        found = {name: value or "" for name, value in attrs}
        self.attributes |= set(found)
        self.ids |= {found["id"]} if "id" in found else set()
        self.addresses += (found[name] for name in self.ADDRESSES if name in found)
        if found.get("http-equiv") == "Content-Security-Policy":
            self.policy = found["content"]

    def handle_data(self, data: str) -> None:
        self.text += data

    def files(self) -> Iterator[str]:
        """The files beside the page that its addresses lead to; fails if one leads elsewhere."""
        for address in self.addresses:
            if address.startswith("#"):
                assert address[1:] in self.ids
            elif address != "data:,":
                assert address.startswith("./"), address
                assert not set(address[2:]) & set("/\\:?#&\"'<> \n"), address
                yield unquote(address[2:])
