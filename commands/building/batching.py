"""Puts the actions of a build into batches, each of which other programs run in one process.

A process starts as long as several files take to compile. Where many actions are out of date,
batches take a fraction of the time; where few are, single actions do less in vain.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from hashlib import sha256
from itertools import groupby

from .actions import Action, Batch


def batches_of(actions: Sequence[Action], size: int) -> list[Batch]:
    """Batches of about ``size`` files each, with all of their rigs, in the order of the actions.

    Where a batch ends is decided by the digest of a file's name alone. So a new file changes the
    batch in which it lies, and none of the others, whose results stay in the caches of a farm.
    """
    if size == 1:
        return [Batch((action,)) for action in actions]
    by_variant: dict[str, list[Action]] = {}
    for action in actions:
        by_variant.setdefault(action.variant.name, []).append(action)
    return [Batch(tuple(batch)) for own in by_variant.values() for batch in _split(own, size)]


def _split(actions: Sequence[Action], size: int) -> Iterator[list[Action]]:
    batch: list[Action] = []
    for file, own in groupby(actions, lambda action: action.request.files[0]):
        batch += own
        digest = sha256(str(file).encode("utf-8", "surrogatepass")).digest()
        if int.from_bytes(digest[:8]) % size == 0:
            yield batch
            batch = []
    if batch:
        yield batch
