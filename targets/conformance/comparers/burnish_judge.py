# SPDX-License-Identifier: Apache-2.0
"""Judges pictures by the bounds of a golden folder. Copy this file into your own test suite.

``burnish conform FILE --golden FOLDER`` writes a golden folder: for each case, and each output of
it, the lowest and the highest value that a conforming device may draw at each pixel. This file
needs nothing but Python 3.9 or newer, and comes in Python, Rust, TypeScript and C++, with the same
names and the same verdicts. A test loads the bounds, draws, and asks for the verdict::

    bounds = Bounds.load("golden/Plastic/defaults", "color")
    verdict = judge(bounds, Picture(72, 56, 4, pixels), Encoding.SRGB)
    assert verdict.is_good, verdict.message

On the command line: ``python burnish_judge.py FOLDER OUTPUT PICTURE.npy [linear|srgb]``
"""

from __future__ import annotations

import math
import struct
import sys
from array import array
from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import Any


class JudgeError(Exception):
    """Nothing can be judged: a damaged file, a picture of another size, or nothing to compare."""


class Encoding(Enum):
    """The way in which a picture of integers has values; pictures of floats have them as such."""

    LINEAR = "linear"
    """A value is its code divided by the largest code."""
    SRGB = "srgb"
    """The first three lanes have the transfer function of sRGB; the fourth, alpha, is linear."""


@dataclass(frozen=True)
class Picture:
    """A picture in memory: row by row from the top, with the lanes of each pixel side by side."""

    width: int
    height: int
    lanes: int
    data: Any
    """The numbers, 8-bit or 16-bit unsigned integers, or floats of 16, 32 or 64 bits: ``bytes``, an
    ``array.array``, a NumPy array, or what else tells the type of its numbers by a buffer."""

    @classmethod
    def load(cls, path: str | Path) -> Picture:
        """The picture in a ``.npy`` file: (height, width) or (height, width, lanes)."""
        return cls._of(_Npy.load(path))

    @classmethod
    def parse(cls, content: bytes) -> Picture:
        """The picture in the bytes of a ``.npy`` file."""
        return cls._of(_Npy.parse("picture.npy", content))

    @classmethod
    def _of(cls, file: _Npy) -> Picture:
        return cls(file.width, file.height, file.lanes, file.numbers)


@dataclass(frozen=True)
class Bounds:
    """The values that a conforming device may draw, for one output of a case."""

    width: int
    height: int
    lanes: int
    lower: Sequence[float]
    """The lowest value of each lane of each pixel, in the order of ``Picture.data``."""
    upper: Sequence[float]
    """The highest value, likewise."""
    undecided: Sequence[int]
    """For each pixel, 1 if it is not compared, else 0."""

    @classmethod
    def load(cls, folder: str | Path, output: str) -> Bounds:
        """The bounds in the folder of a case, ``golden/Plastic/defaults``, for one output."""
        lower, upper = (f"{folder}/{output}.{end}.npy" for end in ("lower", "upper"))
        return cls._of(_Npy.load(lower), _Npy.load(upper), _Npy.load(f"{folder}/undecided.npy"))

    @classmethod
    def parse(cls, lower: bytes, upper: bytes, undecided: bytes) -> Bounds:
        """The bounds in the bytes of the three files."""
        return cls._of(
            _Npy.parse("lower.npy", lower),
            _Npy.parse("upper.npy", upper),
            _Npy.parse("undecided.npy", undecided),
        )

    @classmethod
    def _of(cls, lower: _Npy, upper: _Npy, undecided: _Npy) -> Bounds:
        for file, type_, lanes in (
            (lower, "<f8", lower.lanes),
            (upper, "<f8", lower.lanes),
            (undecided, "|u1", 1),
        ):
            file.expect(type_, lower.width, lower.height, lanes)
        for mark in undecided.numbers:
            if mark > 1:
                raise JudgeError(f"{undecided.name}: is damaged: it has a {mark}, not just 0 and 1")
        for index, (low, high) in enumerate(zip(lower.numbers, upper.numbers)):
            if not low <= high:
                pixel, lane = divmod(index, lower.lanes)
                y, x = divmod(pixel, lower.width)
                raise JudgeError(
                    f"{lower.name}: is damaged at x {x}, y {y}, lane {lane}: "
                    f"lower is {_shown(low)}, upper {_shown(high)}"
                )
        sizes = (lower.width, lower.height, lower.lanes)
        return cls(*sizes, lower.numbers, upper.numbers, undecided.numbers)


@dataclass(frozen=True)
class Outlier:
    """A lane of a pixel that is outside of its bounds, counted from 0 at the left and the top."""

    x: int
    y: int
    lane: int
    value: float
    """The number as the picture has it: of a picture of integers, the code."""
    lower: float
    upper: float
    """The lowest and the highest number that it may be: of a picture of integers, codes."""
    distance: float
    """The distance to the nearer end, for codes divided by the largest one. It is infinite for a
    NaN."""


@dataclass(frozen=True)
class Verdict:
    """The result of a comparison, in pixels."""

    compared: int
    undecided: int
    outside: int
    worst: Outlier | None
    """The lane that is farthest outside. Of equally far ones, it is the first in the rows."""

    @property
    def is_good(self) -> bool:
        """True if no pixel is outside of its bounds."""
        return self.outside == 0

    @property
    def message(self) -> str:
        """The verdict in one line."""
        counts = (
            f"{self.compared} pixels compared, {self.undecided} undecided, "
            f"{self.outside} outside of the bounds"
        )
        if self.worst is None:
            return f"good: {counts}"
        at = self.worst
        return (
            f"bad: {counts}; the worst, at x {at.x}, y {at.y}, lane {at.lane}, "
            f"is {_shown(at.value)}, not within {_shown(at.lower)} .. {_shown(at.upper)}"
        )


def judge(bounds: Bounds, picture: Picture, encoding: Encoding = Encoding.LINEAR) -> Verdict:
    """Compare a picture with the bounds. Raises ``JudgeError`` if that is not possible."""
    numbers, largest = _samples(picture)
    _check_shape(bounds, picture, len(numbers))
    if largest is None and encoding is Encoding.SRGB:
        raise JudgeError("the picture has floats, which are linear: only integers are encoded")
    compared = outside = 0
    worst: Outlier | None = None
    for pixel, is_undecided in enumerate(bounds.undecided):
        if is_undecided:
            continue
        compared += 1
        is_outside = False
        for lane in range(picture.lanes):
            at = pixel * bounds.lanes + lane
            lower, upper = bounds.lower[at], bounds.upper[at]
            if largest is not None:
                is_srgb = encoding is Encoding.SRGB and lane < 3
                lower, upper = _codes(lower, upper, largest, is_srgb)
            value = numbers[pixel * picture.lanes + lane]
            if lower <= value <= upper:
                continue
            is_outside = True
            distance = _distance(value, lower, upper) / (largest or 1)
            if worst is None or distance > worst.distance:
                y, x = divmod(pixel, bounds.width)
                worst = Outlier(x, y, lane, value, lower, upper, distance)
        outside += is_outside
    if compared == 0:
        raise JudgeError("nothing is compared: every pixel is undecided")
    return Verdict(compared, len(bounds.undecided) - compared, outside, worst)


# How numbers are compared.


def _check_shape(bounds: Bounds, picture: Picture, count: int) -> None:
    """Raise ``JudgeError`` for a picture that does not fit the bounds."""
    if (picture.width, picture.height) != (bounds.width, bounds.height):
        raise JudgeError(
            f"the picture has {picture.width} x {picture.height} pixels, "
            f"but the bounds have {bounds.width} x {bounds.height}"
        )
    if not 1 <= picture.lanes <= bounds.lanes:
        lanes = f"{picture.lanes} lanes, but the bounds have {bounds.lanes}"
        raise JudgeError(f"the picture has {lanes}")
    expected = picture.width * picture.height * picture.lanes
    if count != expected:
        raise JudgeError(f"the picture has {count} numbers, but its size needs {expected}")


def _codes(lower: float, upper: float, largest: int, is_srgb: bool) -> tuple[int, int]:
    """The codes that bounds allow: a format may round a value to either neighbour."""
    lower, upper = (min(max(end, 0.0), 1.0) for end in (lower, upper))
    if is_srgb:
        lower, upper = _srgb(lower), _srgb(upper)
    return math.floor(lower * largest), math.ceil(upper * largest)


def _srgb(value: float) -> float:
    """The transfer function of sRGB (IEC 61966-2-1), from linear light."""
    return 12.92 * value if value <= 0.0031308 else 1 + 1.055 * (value ** (1 / 2.4) - 1)


def _distance(value: float, lower: float, upper: float) -> float:
    """The distance of a value that is outside to the nearer end."""
    if math.isnan(value):
        return math.inf
    return lower - value if value < lower else value - upper


_LARGEST = {"B": 255, "H": 65535, "e": None, "f": None, "d": None}
"""The largest code of each type of numbers, by its letter in buffers; floats have none."""


def _samples(picture: Picture) -> tuple[tuple[Any, ...], int | None]:
    """The numbers of a picture in a row, and their largest code."""
    view = memoryview(picture.data)
    order, letter = view.format[:-1] or "=", view.format[-1:]
    if letter not in _LARGEST or order not in "@=<>":
        raise JudgeError(f"the picture has numbers of type {view.format}")
    numbers = struct.unpack(f"{order}{view.nbytes // view.itemsize}{letter}", view.tobytes())
    return numbers, _LARGEST[letter]


# How numbers are shown: in all four languages alike.


def _shown(number: float) -> str:
    """The shortest decimal that means the same number."""
    if math.isnan(number):
        return "NaN"
    mantissa, _, exponent = repr(number + 0.0).partition("e")
    return mantissa.removesuffix(".0") + (f"e{int(exponent)}" if exponent else "")


# The format `.npy` of NumPy, as far as pictures need it.

_LONGEST_SIDE = 65536
_LETTERS = {"|u1": "B", "<u2": "H", "<f2": "e", "<f4": "f", "<f8": "d"}
"""The letters of the types of numbers, by their names in `.npy` files."""


@dataclass(frozen=True)
class _Npy:
    """The content of a ``.npy`` file, a picture."""

    name: str
    type: str
    width: int
    height: int
    lanes: int
    numbers: array[Any]

    @classmethod
    def load(cls, path: str | Path) -> _Npy:
        try:
            content = Path(path).read_bytes()
        except OSError as error:
            raise JudgeError(f"{path}: cannot be read: {error.strerror}") from error
        return cls.parse(str(path), content)

    @classmethod
    def parse(cls, name: str, content: bytes) -> _Npy:
        header, data = _split(name, content)
        type_ = _between(name, header, "descr", "'", "'")
        if type_ not in _LETTERS:
            known = "|u1, <u2, <f2, <f4 and <f8"
            raise JudgeError(f"{name}: has numbers of type {type_}; known are {known}")
        if not _value(name, header, "fortran_order").startswith("False"):
            raise JudgeError(f"{name}: is not in C order, row by row")
        height, width, lanes = _shape(name, _between(name, header, "shape", "(", ")"))
        needed = height * width * lanes * int(type_[2:])
        if len(data) != needed:
            raise JudgeError(f"{name}: has {len(data)} bytes of numbers, but needs {needed}")
        return cls(name, type_, width, height, lanes, _numbers(type_, data))

    def expect(self, type_: str, width: int, height: int, lanes: int) -> None:
        """Raise ``JudgeError`` for another size, or numbers of another type."""
        if (self.width, self.height, self.lanes) != (width, height, lanes):
            raise JudgeError(
                f"{self.name}: has {self.width} x {self.height} pixels of {self.lanes} lanes, "
                f"not {width} x {height} of {lanes}"
            )
        if self.type != type_:
            raise JudgeError(f"{self.name}: has numbers of type {self.type}, not {type_}")


def _split(name: str, content: bytes) -> tuple[str, bytes]:
    """The header and the data of a ``.npy`` file."""
    if content[:6] != b"\x93NUMPY" or len(content) < 8:
        raise JudgeError(f"{name}: is no .npy file")
    major, minor = content[6:8]
    if major not in (1, 2, 3) or minor != 0:
        raise JudgeError(f"{name}: has version {major}.{minor} of the .npy format, not 1.0 to 3.0")
    start = 10 if major == 1 else 12
    end = start + int.from_bytes(content[8:start], "little")
    header = content[start:end]
    is_text = all(byte == ord("\n") or 32 <= byte < 127 for byte in header)
    if len(content) < max(start, end) or not is_text:
        raise JudgeError(f"{name}: has a damaged header")
    return header.decode("ascii"), content[end:]


def _value(name: str, header: str, key: str) -> str:
    """The rest of a header, from the value of a key on."""
    rest = header.partition(f"'{key}'")[2].lstrip()
    if not rest.startswith(":"):
        raise JudgeError(f"{name}: has a damaged header: no {key}")
    return rest[1:].lstrip()


def _between(name: str, header: str, key: str, first: str, last: str) -> str:
    """The text between the two letters that enclose the value of a key."""
    value = _value(name, header, key)
    inner, found, _ = value[1:].partition(last)
    if not (value.startswith(first) and found):
        raise JudgeError(f"{name}: has a damaged header: no {key}")
    return inner


def _shape(name: str, text: str) -> tuple[int, int, int]:
    """The height, the width and the lanes in a header's shape, ``56, 72, 4`` or ``56, 72``."""
    sides = [side.strip() for side in text.rstrip().removesuffix(",").split(",")]
    if len(sides) in (2, 3) and all(side.isdigit() and len(side) <= 5 for side in sides):
        height, width, lanes = (*map(int, sides), 1)[:3]
        if 1 <= height <= _LONGEST_SIDE and 1 <= width <= _LONGEST_SIDE and 1 <= lanes <= 4:
            return height, width, lanes
    raise JudgeError(
        f"{name}: has the shape ({text}), which is no picture: height, width and 1 to 4 lanes"
    )


def _numbers(type_: str, data: bytes) -> array[Any]:
    """The numbers in little-endian data; those of 16-bit floats get 32 bits."""
    letter = _LETTERS[type_]
    if letter == "e":
        return array("f", struct.unpack(f"<{len(data) // 2}e", data))
    numbers: array[Any] = array(letter, data)
    if sys.byteorder == "big":
        numbers.byteswap()
    return numbers


def main(arguments: Sequence[str]) -> int:
    """The command line. The exit code is 0 for a good picture, 1 for a bad one, and 2 for an
    error."""
    if len(arguments) not in (3, 4) or arguments[3:] not in ([], ["linear"], ["srgb"]):
        print("usage: burnish_judge FOLDER OUTPUT PICTURE.npy [linear|srgb]", file=sys.stderr)
        return 2
    folder, output, path, encoding = (*arguments, "linear")[:4]
    try:
        verdict = judge(Bounds.load(folder, output), Picture.load(path), Encoding(encoding))
    except JudgeError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    print(verdict.message)
    return 0 if verdict.is_good else 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
