"""Changes of the library that no value can show, each with the reason."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

_BY_REASON: Mapping[str, Sequence[str]] = {}
"""The reasons, each with the changes as ``Change.told`` says them."""

EQUIVALENT = {told: reason for reason, all_told in _BY_REASON.items() for told in all_told}
"""The changes, each with the reason."""
