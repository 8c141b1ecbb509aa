"""Another compiler as the bench knows it: something that makes the texts of one material."""

from __future__ import annotations

from collections.abc import Callable, Sequence

Texts = Callable[[int], Sequence[str]]
"""Makes all texts of a material; each number gives another material of the same shape."""


class MissingPeerError(Exception):
    """A compiler cannot be used here; the message is the reason."""
