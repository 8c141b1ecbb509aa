"""Colours of rendered diagnostics, or their absence."""

from __future__ import annotations

from .diagnostic import Severity

_CODES: dict[Severity, str] = {"error": "1;31", "warning": "1;33", "note": "1;36"}


class Style:
    """Wraps text into ANSI codes where ``color`` asks for it."""

    def __init__(self, color: bool) -> None:
        self._color = color

    def severity(self, severity: Severity, text: str) -> str:
        """``text`` in the colour of a severity."""
        return self._wrapped(_CODES[severity], text)

    def strong(self, text: str) -> str:
        """Text that the eye should catch first."""
        return self._wrapped("1", text)

    def gutter(self, text: str) -> str:
        """Line numbers, rules and secondary marks."""
        return self._wrapped("1;34", text)

    def _wrapped(self, code: str, text: str) -> str:
        return f"\x1b[{code}m{text}\x1b[0m" if self._color and text else text
