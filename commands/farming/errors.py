"""The error of a farm, which ``failures.py`` tells people."""

from __future__ import annotations


class FarmError(Exception):
    """A farm cannot do the work; the text is a sentence for people."""
