"""Reads how bright lamps are in each direction, from the files of their makers (IES LM-63).

``files.py`` makes textures of such files: a table of candelas by whole degrees, for lights. Only
photometry of type C is read, which all makers of lamps for rooms and streets use.

A file may come from anywhere: it is read to a limit, and nothing that it says is believed.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import islice
from pathlib import PurePath
from typing import BinaryIO

import numpy as np
from numpy.typing import NDArray

from .kinds import PictureError

SUFFIX = ".ies"

_MOST_BYTES = 1 << 22
"""The most bytes of a file. Those of makers have some 10 000."""
_MOST_ANGLES = 1441
"""The most angles of one kind: quarters of degrees, all around."""
_HEADER_NUMBERS = 13
_TILT = re.compile(r"^TILT *= *(.*?)\s*$", re.MULTILINE)
_FULL, _HALF, _QUARTER = 360.0, 180.0, 90.0

Floats = NDArray[np.float64]


def is_photometric(path: PurePath) -> bool:
    """True if a file is one of these, by its name."""
    return path.suffix.lower() == SUFFIX


def read_candelas(file: BinaryIO, name: str) -> NDArray[np.float32]:
    """The candelas of a lamp: a row for each degree from its axis, 0 to 180, and a column for each
    degree around it, 0 to 360.

    ``name`` is the file's name in errors. Raises ``PictureError`` for a file that is damaged, too
    large, or of another kind.
    """
    data = file.read(_MOST_BYTES + 1)
    if len(data) > _MOST_BYTES:
        raise PictureError(
            f"{name} is too large: a photometric file has at most {_MOST_BYTES:,} bytes"
        )
    try:
        return _table(data.decode("latin-1"))
    except _BrokenError as error:
        raise PictureError(
            f"{name} is no photometric file (IES LM-63) that can be read: {error}"
        ) from None


class _BrokenError(Exception):
    """The reason why a file cannot be read."""


def _table(text: str) -> NDArray[np.float32]:
    numbers = _numbers(text)
    header = _some(numbers, _HEADER_NUMBERS, "numbers of its header")
    factor, vertical_count, horizontal_count, kind = header[2], header[3], header[4], header[5]
    if kind != 1:
        raise _BrokenError("its photometry is not of type C")
    vertical = _angles(numbers, vertical_count, "vertical", _HALF)
    horizontal = _angles(numbers, horizontal_count, "horizontal", _FULL)
    candelas = _some(numbers, len(vertical) * len(horizontal), "candelas")
    candelas = candelas.reshape(len(horizontal), len(vertical)) * factor * header[10]
    if not (candelas >= 0).all() or candelas.max() > np.finfo(np.float32).max:
        raise _BrokenError("some candelas are negative, or larger than any lamp's")
    return _by_degrees(vertical, horizontal, candelas).astype(np.float32)


def _numbers(text: str) -> Iterator[float]:
    """The numbers behind the line that says how the lamp is tilted."""
    found = _TILT.search(text)
    if found is None:
        raise _BrokenError("it has no line TILT=")
    numbers = _parsed(text[found.end() :])
    if found[1] == "INCLUDE":
        _, pairs = _some(numbers, 2, "numbers about its tilt")
        _some(numbers, 2 * _count(pairs, "angles of its tilt"), "numbers about its tilt")
    elif found[1] != "NONE":
        raise _BrokenError("its line TILT= names another file")
    return numbers


def _parsed(text: str) -> Iterator[float]:
    for word in re.finditer(r"[^\s,]+", text):
        try:
            number = float(word[0])
        except ValueError:
            raise _BrokenError(f"`{word[0][:20]}` stands where a number should") from None
        if not np.isfinite(number):
            raise _BrokenError("not all of its numbers are finite")
        yield number


def _some(numbers: Iterator[float], count: int, what: str) -> Floats:
    """The next numbers, as many as there should be."""
    found = np.fromiter(islice(numbers, count), np.float64)
    if len(found) < count:
        raise _BrokenError(f"it ends before all {what}")
    return found


def _count(number: float, what: str) -> int:
    if not 1 <= number <= _MOST_ANGLES or number != int(number):
        raise _BrokenError(f"the number of {what} is {number:g}, not one of 1 to {_MOST_ANGLES}")
    return int(number)


def _angles(numbers: Iterator[float], count: float, what: str, most: float) -> Floats:
    angles = _some(numbers, _count(count, f"{what} angles"), f"{what} angles")
    if angles[0] < 0 or angles[-1] > most or not (np.diff(angles) > 0).all():
        raise _BrokenError(f"its {what} angles do not grow from 0 to {most:g}")
    return angles


def _by_degrees(vertical: Floats, horizontal: Floats, candelas: Floats) -> Floats:
    """The candelas for each whole degree. Nothing is sent where no angle was measured."""
    heights, turns = np.arange(_HALF + 1), np.arange(_FULL + 1)
    rows = [np.interp(heights, vertical, each, left=0, right=0) for each in candelas]
    by_height = np.stack(rows, axis=1)
    measured, by_height = _closed(horizontal, by_height)
    asked = _mirrored(turns, horizontal)
    return np.stack([np.interp(asked, measured, row) for row in by_height])


def _closed(horizontal: Floats, by_height: Floats) -> tuple[Floats, Floats]:
    """With the first angle once more behind the last, if the lamp was measured all around."""
    if _HALF < horizontal[-1] < _FULL and horizontal[0] == 0:
        return np.append(horizontal, _FULL), np.hstack([by_height, by_height[:, :1]])
    return horizontal, by_height


def _mirrored(turns: Floats, horizontal: Floats) -> Floats:
    """The measured angle for each angle, by the symmetry that the measured ones imply."""
    first, last = horizontal[0], horizontal[-1]
    if first == _QUARTER and last == _FULL - _QUARTER:
        return np.where(
            turns < _QUARTER, _HALF - turns, np.where(turns > last, 540.0 - turns, turns)
        )
    if first != 0:
        raise _BrokenError("its horizontal angles begin neither at 0 nor go from 90 to 270")
    if last == _QUARTER:
        turns = np.minimum(turns, _FULL - turns)
        return np.minimum(turns, _HALF - turns)
    if last == _HALF:
        return np.minimum(turns, _FULL - turns)
    if last == 0 or last > _HALF:
        return turns
    raise _BrokenError("its horizontal angles end at none of 0, 90, 180 and 360")
