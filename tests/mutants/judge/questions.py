"""The questions to a judging process, and the judgement of a mutant."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

from .behaviour import DRAWN, Name, behaviour, compiled, label
from .children import Answer
from .studio import Studio

if TYPE_CHECKING:
    from .behaviour import Judged

IN_RUNTIME = "targets/runner/"
"""The folder of files that compute what drivers are told; all other files determine the texts."""


@dataclass(frozen=True, slots=True)
class Question:
    """A question to a judging process."""

    kind: str
    """``known``: what do all materials come to without a mutant, and which of them run which lines?
    ``mutant``: is the mutant noticed?"""
    into: str = ""
    """The file into which a long answer is written."""
    path: str = ""
    """The file of the mutant, relative to the package."""
    materials: tuple[str, ...] = ()
    """The materials that can show it, as ``label`` has them."""
    known: Mapping[str, str] | None = None
    """The behaviour of these materials without the mutant."""
    everything: bool = False
    """True if the code that draws is different, so that routes without a difference are drawn too.

    In a question about all materials: true if their codes, and the lines that run to draw them, are
    also part of the answer.
    """


def judged(asked: Question) -> Answer:
    """Compile one material after the other, and draw what differs, until a picture is wrong."""
    in_runtime = asked.path.startswith(IN_RUNTIME)
    same_code = {} if in_runtime or asked.everything else asked.known or {}
    different: list[str] = []
    waiting: list[tuple[Name, Judged, str]] = []
    with Studio() as studio:
        for name in map(_named, asked.materials):
            routes = list(_different(name, asked))
            different += [f"{label(name)}, {route}" for route in routes]
            if routes:
                first, *others = [(name, compiled(name), route) for route in routes]
                waiting += others
                if wrong := studio.wrong(*first, same_code):
                    return {"verdict": "caught", "by": wrong}
        for each in waiting:
            if wrong := studio.wrong(*each, same_code):
                return {"verdict": "caught", "by": wrong}
        if not different:
            return {"verdict": "same"}
        return {"verdict": "survived" if studio.drawn else "same code", "different": different}


def _named(text: str) -> Name:
    path, pass_ = text.rsplit(": ", 1)
    return path, pass_


def _different(name: Name, asked: Question) -> Iterator[str]:
    """The routes on which the behaviour of a material differs from that without the mutant."""
    assert asked.known is not None
    told = asked.path.startswith(IN_RUNTIME)
    found = dict(behaviour(name, told=told))
    for route in DRAWN:
        keys = [f"{label(name)}, {route}: {what}" for what in ("text", "told")[: 1 + told]]
        differs = any(found.get(key) != asked.known.get(key) for key in keys)
        if differs or (asked.everything and keys[0] in found):
            yield route
