"""Hostile things that Burnish may receive, at random: what ``make fuzz`` tries besides sources.

A kind is a row of ``KINDS``. It tries one thing by a generator of random numbers, and asserts what
has to be true of it. The usual answer to such a thing is an error that says what is wrong with it,
which kinds pass over. Whatever else is raised is trouble, and so is an answer that takes long, or
more memory than there may be.

A trial is named by its kind and a number, such as ``scenes:57``, which always give the same thing.
"""

from __future__ import annotations

import signal
import time
import traceback
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from itertools import count
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from types import FrameType
from typing import NamedTuple

from burnish.targets.runner.scenes.gltf.reading import read_gltf

from ..suite.memory import most_memory
from .hostile import folders, goldens, outputs, picture_bytes, plans, requests, scene_bytes

SECONDS = 10
"""The largest time of an answer, in seconds."""
MEMORY = 10**9
"""The most memory of a process, in bytes, whatever it receives."""

Trial = Callable[[Random, Path], None]
"""Tries one thing, in an empty folder."""


def _pictures() -> Trial:
    """The trial that reads a damaged picture."""
    seeds = picture_bytes.seeds()

    def read(random: Random, folder: Path) -> None:
        name = random.choice(list(seeds))
        picture_bytes.read(picture_bytes.mutated(seeds[name], random), folder / name)

    return read


def _scenes() -> Trial:
    """The trial that reads a scene with mistakes."""
    seeds = scene_bytes.seeds()

    def read(random: Random, folder: Path) -> None:
        content = scene_bytes.mutated(random.choice(seeds), random)
        scene_bytes.read(content, folder / "scene.gltf", read_gltf)

    return read


def _plans() -> Trial:
    """The trial that reads a plan or a reflection with mistakes."""

    def read(random: Random, folder: Path) -> None:
        trouble = plans.trouble(plans.mistaken(random.randrange(10**9)).write(folder))
        assert trouble is None, trouble

    return read


KINDS: Mapping[str, Callable[[], Trial]] = {
    "folders": folders.trial,
    "goldens": goldens.trial,
    "outputs": outputs.trial,
    "pictures": _pictures,
    "plans": _plans,
    "requests": requests.trial,
    "scenes": _scenes,
}
"""The functions that make the trial of each kind.

They may prepare something that all uses of the trial share.
"""


class TooSlowError(Exception):
    """Raised if there is no answer in time."""


class Trouble(NamedTuple):
    """A failed trial: the name of its input, and the error as text."""

    name: str
    text: str


class Received:
    """The trials of some kinds."""

    def __init__(self, kinds: Sequence[str] = tuple(KINDS)) -> None:
        self._trials = {kind: KINDS[kind]() for kind in kinds}
        self.done: Counter[str] = Counter()
        """The number of trials of each kind so far."""

    def found(self, seed: str, seconds: float) -> Iterator[Trouble]:
        """Try things of all kinds in turn for so many seconds, by the numbers of a seed."""
        end = time.monotonic() + seconds
        for number in count():
            for kind in self._trials:
                if time.monotonic() >= end:
                    return
                if trouble := self.trouble(kind, f"{seed}:{number}"):
                    yield trouble

    def trouble(self, kind: str, number: str) -> Trouble | None:
        """The fault in the answer to one input, if there is one."""
        name = f"{kind}:{number}"
        self.done[kind] += 1
        with TemporaryDirectory(prefix="burnish-") as folder:
            try:
                with _limited():
                    self._trials[kind](Random(name), Path(folder))
            except Exception:
                return Trouble(name, traceback.format_exc())
        taken = most_memory()
        return Trouble(name, f"the process has come to {taken} bytes") if taken > MEMORY else None


@contextmanager
def _limited() -> Iterator[None]:
    """Raise ``TooSlowError`` in the ``with`` block if it takes too long."""

    def stop(_number: int, _frame: FrameType | None) -> None:
        raise TooSlowError(f"no answer within {SECONDS} s")

    before = signal.signal(signal.SIGALRM, stop)
    signal.alarm(SECONDS)
    try:
        yield
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, before)
