"""The identity of this Burnish: what tells whether two machines compile and judge the same.

The stamps of files, by which ``results.py`` knows an installation, differ from machine to machine.
So this has the digest of the code itself, which is kept for as long as the stamps stay.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from functools import cache
from hashlib import sha256
from pathlib import Path

from ... import __version__
from ...compiler.cache import load, store
from ..results import installation, key_of

_ROOT = Path(__file__).parents[2]
_PACKAGES = ("api", "commands", "compiler", "materialx", "stdlib", "support", "targets")
_NOT_CODE = frozenset(("__pycache__", "generated"))
"""Folders whose files are made of the code: some machines have them, others do not."""
_SUFFIXES = frozenset((".py", ".burnish", ".lark", ".j2", ".js", ".mjs"))
"""Endings of code: of Python, the library, the grammar, the skeletons of texts, and web pages."""
_NAME = "program"


@cache
def program() -> str:
    """The version of Burnish with the digest of its code: ``0.1.0+1f3a…``."""
    key = key_of([str(_ROOT), installation()])
    kept = load(_NAME, key)
    if kept is None:
        kept = _digest().encode()
        store(_NAME, key, kept)
    return f"{__version__}+{kept.decode()}"


def _digest() -> str:
    whole = sha256()
    for path in sorted(_files(), key=lambda path: path.relative_to(_ROOT).as_posix()):
        name, content = path.relative_to(_ROOT).as_posix(), path.read_bytes()
        whole.update(f"{name}\0{len(content)}\0".encode() + content)
    return whole.hexdigest()[:32]


def _files() -> Iterator[Path]:
    for package in _PACKAGES:
        for folder, inner, names in os.walk(_ROOT / package):
            inner[:] = [name for name in inner if name not in _NOT_CODE]
            yield from (Path(folder, name) for name in names if Path(name).suffix in _SUFFIXES)
