"""No name is a word that a text has of its own: the words are derived from what texts are made of.

``test_every_name.py`` shows the same to the real compilers, with names of every kind.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import chain
from pathlib import Path

import pytest

import burnish
from burnish.api.entry_points import variants
from burnish.compiler.ir.stages import STAGES
from burnish.targets import registry
from burnish.targets.emit.namer import Namer
from burnish.targets.emit.own_words import taken_words, words_in

from ..examples.kit import FOLDER
from .capability_probes import PROBES
from .kit import PROFILES, Selected, emitted, program_of_rows

EXAMPLES = sorted(
    path.relative_to(FOLDER).as_posix()
    for path in FOLDER.rglob("*.burnish")
    if path.parent.name != "shared"
)
OWN = "_own"
"""The ending of every name that a program declares."""
_SEMANTIC = re.compile(r" : (?:[A-Z]\w*|register\(.*?\))")
_SUPPLIED = {supplied.name for row in STAGES.values() for supplied in row.inputs}
"""The names that the pipeline's inputs have where they are declared; elsewhere they have others."""


@pytest.fixture
def _marked(monkeypatch: pytest.MonkeyPatch) -> None:
    declare = Namer.declare
    monkeypatch.setattr(
        Namer, "declare", lambda self, wanted: declare(self, wanted.removesuffix(OWN)) + OWN
    )


def untaken(text: str, language: str) -> set[str]:
    """The words of a text that are no declared names and that a name could have."""
    known = registry.load(language)
    helpers = (helper for helpers in known.helpers.values() for helper in helpers.values())
    in_helpers = chain.from_iterable(map(words_in, helpers))  # They hide what has these names.
    named = _SUPPLIED.union(known.fixed_names, in_helpers)
    own = {word for word in words_in(_SEMANTIC.sub("", text)) if not word.endswith(OWN)}
    return {word for word in own - named if not taken_words(known).refuses(word)}


def texts(source: str | Path, native_stages: bool) -> Iterator[tuple[str, str]]:
    """The texts of a source for all profiles that have what it needs, each with its language."""
    rig, _pass = variants(source)[0]
    result = burnish.compile(source, "all", rig=rig, partial=True, native_stages=native_stages)
    for material in result.materials:
        for file in material.files:
            yield file.target, file.text


@pytest.mark.usefixtures("_marked")
@pytest.mark.parametrize("name", EXAMPLES)
def test_the_words_of_examples_are_no_names(name: str) -> None:
    for language, text in texts(FOLDER / name, native_stages=True):
        assert not untaken(text, language)


@pytest.mark.usefixtures("_marked")
@pytest.mark.parametrize("name", PROBES)
def test_the_words_of_capabilities_are_no_names(name: str) -> None:
    for native_stages in (False, True):
        for language, text in texts(PROBES[name].text, native_stages=native_stages):
            assert not untaken(text, language)


@pytest.mark.usefixtures("_marked")
@pytest.mark.parametrize("selected", PROFILES, ids=str)
def test_the_words_of_builtins_are_no_names(selected: Selected) -> None:
    for text in emitted(program_of_rows(selected.profile), selected).values():
        assert not untaken(text, selected.language.name)
