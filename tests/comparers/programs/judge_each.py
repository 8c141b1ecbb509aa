"""Prints what the comparer in Python says of each case of a list; ``kit.py`` tells the form."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

from burnish.targets.conformance.comparers.burnish_judge import (
    Bounds,
    Encoding,
    JudgeError,
    Picture,
    judge,
)


def said(
    bounds: Callable[[], Bounds], picture: Callable[[], Picture], encoding: str, lanes: str
) -> str:
    """The verdict, or the error."""
    try:
        drawn = picture()
        drawn = replace(drawn, lanes=int(lanes)) if lanes else drawn
        return judge(bounds(), drawn, Encoding(encoding)).message
    except JudgeError as error:
        return f"error: {error}"


def content(path: str) -> bytes:
    """The bytes of a file; none if it cannot be read."""
    return Path(path).read_bytes() if Path(path).is_file() else b""


def judged(line: str) -> str:
    """What is said of a case, by its files and by their bytes."""
    folder, output, path, encoding, lanes = line.split("\t")
    names = (f"{output}.lower.npy", f"{output}.upper.npy", "undecided.npy")
    lower, upper, undecided = (content(f"{folder}/{name}") for name in names)
    drawn = content(path)
    loaded = said(lambda: Bounds.load(folder, output), lambda: Picture.load(path), encoding, lanes)
    parsed = said(
        lambda: Bounds.parse(lower, upper, undecided), lambda: Picture.parse(drawn), encoding, lanes
    )
    return f"{loaded}\t{parsed}"


if __name__ == "__main__":
    for each in Path(sys.argv[1]).read_text(encoding="utf-8").splitlines():
        print(judged(each))
