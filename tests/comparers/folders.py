"""Writes golden folders of one case, and pictures, whole or damaged, for the comparers to judge."""

from __future__ import annotations

import io
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt

from .kit import Line

Array = npt.NDArray[Any]
OUTPUT = "color"
FILES = ("lower.npy", "upper.npy", "undecided.npy", "picture.npy")
"""The files of a case, by the names that messages have for them where they came as bytes."""


@dataclass(frozen=True, slots=True)
class Case:
    """A picture, what it is held against, and what all comparers have to say."""

    name: str
    expected: str
    files: Mapping[str, bytes]
    """The content of each of ``FILES`` that is there."""
    encoding: str = "linear"
    lanes: int | None = None
    """The number of lanes that the picture claims to have, if it is not that of its file."""
    paths: dict[str, str] = field(default_factory=dict)
    """The names of ``FILES`` in messages, by their paths; known after ``write``."""

    def write(self, folder: Path) -> Line:
        """Write the files into a folder, and return the line of a list for them."""
        folder.mkdir()
        for name in FILES:
            of_output = f"{OUTPUT}.{name}" if name in FILES[:2] else name
            self.paths[str(folder / of_output)] = name
            if name in self.files:
                (folder / of_output).write_bytes(self.files[name])
        return Line(folder, OUTPUT, folder / "picture.npy", self.encoding, self.lanes)

    def named(self, message: str) -> str:
        """A message about files with their names instead of paths."""
        for path, name in self.paths.items():
            message = message.replace(path, name)
        return message


def npy(array: Array) -> bytes:
    """A ``.npy`` file as NumPy writes it."""
    file = io.BytesIO()
    np.save(file, array, allow_pickle=False)
    return file.getvalue()


def raw(header: str, data: bytes, version: tuple[int, int] = (1, 0)) -> bytes:
    """A ``.npy`` file with any header."""
    text = header.encode("latin-1")
    length = len(text).to_bytes(2 if version[0] == 1 else 4, "little")
    return b"\x93NUMPY" + bytes(version) + length + text + data
