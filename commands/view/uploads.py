"""Reads the files that pages of ``burnish view`` send, within limits of size and time."""

from __future__ import annotations

import asyncio
from io import BytesIO

from starlette.requests import ClientDisconnect, Request

MOST_BYTES = 64 * 2**20
"""The most bytes of a file."""
_DIGITS = 12
"""The most digits of a length; a longer one is too large, whatever its digits are."""
_MOST_ARRIVING = 2 * MOST_BYTES
"""Bytes of all files that are being sent at the same time."""
_TO_SEND = 60.0
"""The seconds that sending a file may take."""


class UploadError(Exception):
    """A file is not accepted; the text says why."""

    def __init__(self, status: int, text: str) -> None:
        super().__init__(text)
        self.status = status
        """The status of the answer."""


class Uploads:
    """The files that are being sent at the same time, to one event loop."""

    def __init__(self) -> None:
        self._arriving = 0

    async def read(self, request: Request) -> bytes:
        """The body of a request. Raises ``UploadError``."""
        announced = request.headers.get("content-length", "0")
        if not (announced.isascii() and announced.isdecimal()):
            raise UploadError(400, "the length of the file is no number")
        if len(announced) > _DIGITS or int(announced) > MOST_BYTES:
            raise _too_large()
        data = BytesIO()
        try:
            async with asyncio.timeout(_TO_SEND):
                async for part in request.stream():
                    self._arriving += data.write(part)
                    if data.tell() > MOST_BYTES:
                        raise _too_large()
                    if self._arriving > _MOST_ARRIVING:
                        raise UploadError(429, "too many files are sent at the same time")
        except TimeoutError:
            raise UploadError(408, f"the file was not there after {_TO_SEND:g} seconds") from None
        except ClientDisconnect:
            raise UploadError(400, "the file has ended too early") from None
        finally:
            self._arriving -= data.tell()
        return data.getvalue()


def _too_large() -> UploadError:
    return UploadError(413, f"the file is larger than {MOST_BYTES >> 20} MB")
