"""Names of files and folders in a golden folder."""

from __future__ import annotations

import re
from collections.abc import Iterable

from ....compiler.diagnostics.file_names import DEVICES

_ODD = re.compile(r"[^\w.+-]+")
_LONGEST = 100


def file_name(text: str) -> str:
    """A name that every system can store, of letters, digits and a few signs."""
    name = _ODD.sub("-", text).strip(".-")[:_LONGEST]
    return name or "unnamed"


def folder_names(texts: Iterable[str], *, taken: Iterable[str] = ()) -> list[str]:
    """A name for each text; no two of them are the same on any system, nor one that is taken."""
    taken = {*DEVICES, *(name.casefold() for name in taken)}
    found = []
    for text in texts:
        wanted = name = file_name(text)
        number = 1
        while name.casefold() in taken:
            number += 1
            name = f"{wanted}-{number}"
        taken.add(name.casefold())
        found.append(name)
    return found
