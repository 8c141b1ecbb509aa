"""Names of files as text that can be shown and written, and why files cannot be read.

File names are bytes. Where they are not UTF-8, Python puts surrogates in place of them. These
cannot be encoded: neither a terminal nor JSON can show them.
"""

from __future__ import annotations

import re

DEVICES = (
    "con",
    "prn",
    "aux",
    "nul",
    *(f"{port}{n}" for port in ("com", "lpt") for n in range(10)),
)
"""The names that Windows takes for devices, whatever their ending."""
_SURROGATE = "[\ud800-\udfff]"


def readable(name: str) -> str:
    """``name`` with each byte that is no text written out, as in ``caf\\xe9.burnish``."""
    return name if name.isascii() else re.sub(_SURROGATE, _written_out, name)


def why_unreadable(error: OSError | ValueError) -> str:
    """The reason why the system could not find or read a file."""
    if isinstance(error, OSError):
        return error.strerror or str(error)
    return "no file has a name like this"  # NUL, or a surrogate that is no byte.


def _written_out(found: re.Match[str]) -> str:
    number = ord(found[0])
    return f"\\x{number - 0xDC00:02x}" if 0xDC80 <= number <= 0xDCFF else f"\\u{number:04x}"
