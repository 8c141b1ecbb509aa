"""Every word that a shading language could mind is a name like any other in Burnish.

The words are those of ``words/``, and those that the texts of each language have. Each is a name in
each role, and the real compilers read the texts of all profiles.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import pytest

import burnish
from burnish.api import compiling
from burnish.compiler.watching import VARIABLE
from burnish.targets import registry
from burnish.targets.emit.own_words import taken_words
from burnish.targets.toolchain import Job, Toolchain, Verdict

from ..suite.verdicts import refused
from .name_roles import RESERVED, ROLES, Role

STAGES = {"vertex": "vert", "fragment": "frag", "compute": "comp"}
FOLDER = Path(__file__).with_name("words")
OTHERS = "glsl,glsl:gl330,glsl:gl450,glsl:es300,glsl:es310,msl,wgsl"
"""All targets but HLSL."""
SAME_FRONT_END = "dxc-spirv"
"""A slow checker that reads the same text as ``dxc-dxil``, with the same front end."""
MOST = 12
"""The most messages on one text that a failing test shows."""


def words_of(name: str) -> list[str]:
    """The words of a file of ``words/``."""
    lines = (FOLDER / f"{name}.txt").read_text("utf-8").splitlines()
    return [word for line in lines if not line.startswith("#") for word in line.split()]


LISTED = {word for file in FOLDER.glob("*.txt") for word in words_of(file.stem)}
EMITTED = {word for name in registry.names() for word in taken_words(registry.load(name)).words}
WORDS = sorted((LISTED | EMITTED) - RESERVED)


@pytest.fixture(scope="module")
def toolchain() -> Iterator[Toolchain]:
    with Toolchain() as tools:
        yield tools


@pytest.fixture(autouse=True)
def _large_programs(monkeypatch: pytest.MonkeyPatch) -> None:
    """Programs have more textures and attributes than devices; compilers do not mind. To verify
    their graphs would take most of the time, and says nothing about names."""
    monkeypatch.setattr(compiling, "excesses", lambda _program, _profile: ())
    monkeypatch.delenv(VARIABLE)


def jobs(role: Role, words: Sequence[str], targets: str) -> Iterator[Job]:
    """The texts of a program with these names, for each checker."""
    (made,) = burnish.compile(role.program(words), targets, partial=True).materials
    for file in made.files:
        for checker in file.checkers:
            if checker != SAME_FRONT_END:
                yield Job(checker, STAGES[file.stage], file.text, file.entry_points[file.stage])


def batches(role: Role) -> Iterator[tuple[str, Sequence[str]]]:
    """The words that a role takes, so many at a time, and the targets to compile them for."""
    words = [word for word in WORDS if word not in role.refused]
    if role.in_hlsl >= role.at_once:
        yield from (("all", part) for part in cut(words, role.at_once))
        return
    yield from ((OTHERS, part) for part in cut(words, role.at_once))
    if role.in_hlsl:
        yield from (("hlsl", part) for part in cut(words, role.in_hlsl))


def cut(words: Sequence[str], size: int) -> Iterator[Sequence[str]]:
    return (words[at : at + size] for at in range(0, len(words), size))


@pytest.mark.parametrize("name", ROLES)
def test_every_word_is_accepted(name: str, toolchain: Toolchain) -> None:
    """Failures show the lines of the texts, which have the words."""
    role = ROLES[name]
    asked = [job for targets, words in batches(role) for job in jobs(role, words, targets)]
    found = [
        f"{verdict.job.checker}, {verdict.job.stage}, {verdict.status}: {told(verdict)}"
        for verdict in refused(asked, toolchain)
    ]
    assert asked and not found, "\n".join(found)


def told(verdict: Verdict) -> str:
    """The messages of a verdict, each with the line that it is about."""
    lines = verdict.job.text.splitlines()
    errors = [each for each in verdict.messages if each.severity == "error"] or verdict.messages
    return "".join(
        f"\n  {each.text}" + (f"\n    {lines[each.line - 1].strip()}" if each.line else "")
        for each in errors[:MOST]
    )
