"""Lets Pillow read a picture's file within bounds, since Pillow has no bounds of its own.

Besides texels, a decoder spends time and memory on data that is parsed in Python: chunks and
segments, of which a file can have millions, and lists of offsets. Each of them is a call of
``read``. So the calls are counted, and the bytes before the texels.
"""

from __future__ import annotations

import io
from typing import BinaryIO

from .kinds import PictureError

_HEADER_BYTES = 4 * 2**20
"""The most bytes of a header that are read piece by piece. Profiles and metadata are smaller."""
_HEADER_READS = 20_000
"""The most pieces in which a header is read."""
_READS = 1_000_000
"""The most pieces in which a whole file is read. A PNG file of the largest size has 100,000."""
PARTS = 2**16
"""The most strips or tiles of a picture."""


class Metered(io.BufferedIOBase, BinaryIO):
    """A file for Pillow, with limits; errors call it ``name``."""

    def __init__(self, file: BinaryIO, name: str) -> None:
        super().__init__()
        self._file = file
        self._name = name
        self._reads = 0
        self._bytes = 0
        self._in_header = True

    def end_header(self) -> None:
        """Note that texels follow, which may have many bytes."""
        self._in_header = False

    def read(self, size: int | None = -1, /) -> bytes:
        """Read some bytes, or all. Raises ``PictureError`` if this was done too often."""
        wanted = -1 if size is None else size
        data = self._file.read(wanted)
        self._reads += 1
        if wanted >= 0:
            self._bytes += len(data)
        in_pieces = self._reads > (_HEADER_READS if self._in_header else _READS)
        if in_pieces or (self._in_header and self._bytes > _HEADER_BYTES):
            raise PictureError(f"{self._name} is damaged: it has more metadata than any picture")
        return data

    def readable(self) -> bool:
        """True: there is ``read``."""
        return True

    def seekable(self) -> bool:
        """True: there is ``seek``."""
        return True

    def seek(self, offset: int, whence: int = io.SEEK_SET, /) -> int:
        """Move to another position."""
        return self._file.seek(offset, whence)

    def tell(self) -> int:
        """The present position."""
        return self._file.tell()
