"""The gallery's data about one file: plain data that processes send and the cache keeps.

``making.py`` makes an ``Entry``, ``kept.py`` keeps it, and ``pages.py`` shows it.
"""

from __future__ import annotations

from typing import TypedDict


class Text(TypedDict):
    """A shader in one language."""

    language: str
    file: str
    text: str


class Stage(TypedDict):
    """The texts of one stage."""

    name: str
    texts: list[Text]


class Program(TypedDict):
    """A material, kernel or shader of a frame in all languages."""

    label: str
    stages: list[Stage]
    lacking: list[str]
    """The reasons why languages have no text."""


class Graph(TypedDict):
    """A picture of a material's computations, or of the steps of a frame."""

    label: str
    svg: str
    problem: str
    """The reason why there is no picture."""


class Figure(TypedDict):
    """A picture by the reference or a route."""

    label: str
    """The content of the picture, in words."""
    route: str
    note: str
    """The device that has drawn the picture, or the reason why there is none."""
    picture: str
    """The name of the picture, of the last one of several frames; empty if there is none."""
    moving: str
    """The name of an animated picture of something that changes from frame to frame; else empty."""
    status: str
    """``drawn``, ``not run`` or ``failed``."""


class Verdict(TypedDict):
    """The verdict on a route, as ``burnish conform`` reports it."""

    label: str
    route: str
    title: str
    status: str
    difference: str
    share: str
    bite: str
    unproven: str
    problem: str
    device: str
    lines: list[str]
    """The lines about what differs, or proves little."""


class Entry(TypedDict):
    """Everything that the gallery shows of one file."""

    source: str
    kinds: list[str]
    """The kinds of things that the file declares: materials, kernels, frames."""
    names: list[str]
    command: str
    """The command that draws the pictures."""
    programs: list[Program]
    graphs: list[Graph]
    figures: list[Figure]
    verdicts: list[Verdict]
    notes: list[str]
    """Messages of the commands: warnings, and values that were made up for the pictures."""
    errors: list[str]
    """Errors, each as a command prints it."""
    pictures: dict[str, str]
    """Files in PNG and WebP, as Base64, by their names."""
    inputs: dict[str, str]
    """The digests of all files that were read, by their paths; empty for a file that did not
    exist."""


def failed(source: str, reason: str) -> Entry:
    """The entry of a file of which only the text can be shown."""
    return {
        "source": source, "kinds": [], "names": [], "command": "", "programs": [], "graphs": [],
        "figures": [], "verdicts": [], "notes": [], "errors": [reason], "pictures": {},
        "inputs": {},
    }  # fmt: skip
