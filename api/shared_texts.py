"""Gives shaders of frames whose texts are equal one text of a stage, in one file.

Two materials that differ in what a pass does not read, such as their colours in a shadow map, have
equal texts but for the comments with which these begin. ``compiling.py`` calls ``shared_texts``
when all have been printed. A host that loads files by their names then makes one module of them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ..support.frozen import changed
from ..targets.emit.comments import comment_line
from ..targets.emit.emitter import EmittedFile, header_lines
from ..targets.selection import full_name
from .graphs import ShaderGraphs

Key = tuple[str, str, str]
"""A profile, a stage, and a text without the comments about its shader."""
Place = tuple[int, int, int]
"""The numbers of a shader, of its emission, and of a file in it."""


def shared_texts(made: Sequence[ShaderGraphs]) -> list[ShaderGraphs]:
    """The same shaders, but those with equal texts of a stage have one text, with one name."""
    alike: dict[Key, list[Place]] = {}
    for number, graphs in enumerate(made):
        for place, key in _keys(number, graphs):
            alike.setdefault(key, []).append(place)
    files: dict[Place, EmittedFile] = {}
    for (profile, stage, _text), places in alike.items():
        if len(places) > 1:
            others = [graphs.shader.name for graphs in made if _has(graphs, profile, stage)]
            files |= _as_one(made, places, others)
    return [_with_files(number, graphs, files) for number, graphs in enumerate(made)]


def _keys(number: int, graphs: ShaderGraphs) -> Iterator[tuple[Place, Key]]:
    for at, (legal, emission) in enumerate(graphs.emissions):
        for position, file in enumerate(emission.files):
            parts = _parted(graphs, file)
            if parts is not None:
                before, _header, behind = parts
                text = "\n".join([*before, *behind])
                profile = full_name(legal.language, legal.profile)
                yield (number, at, position), (profile, file.stage, text)


def _parted(
    graphs: ShaderGraphs, file: EmittedFile
) -> tuple[list[str], list[str], list[str]] | None:
    """The lines of a text before, in and behind its header; ``None`` if that is not found."""
    shader, lines = graphs.shader, file.text.split("\n")
    header = header_lines(shader.name, shader.doc, tuple(file.entries))
    if header[0] not in lines:
        return None
    start = lines.index(header[0])
    end = start + len(header)
    return (lines[:start], header, lines[end:]) if lines[start:end] == header else None


def _as_one(
    made: Sequence[ShaderGraphs], places: Sequence[Place], others: Sequence[str]
) -> Iterator[tuple[Place, EmittedFile]]:
    """The files at these places with one text; ``others`` are the names of all that have one."""
    shaders = [made[number].shader for number, _, _ in places]
    names = [shader.name for shader in shaders]
    owner = _name_of(names, others)
    docs = {shader.doc for shader in shaders}
    doc = docs.pop() if len(docs) == 1 else ""
    for place in places:
        number, at, position = place
        file = made[number].emissions[at][1].files[position]
        parts = _parted(made[number], file)
        assert parts is not None, "it has a key"
        before, own, behind = parts
        title, *rest = header_lines(owner, doc, tuple(file.entries))
        header = [title, comment_line(f"It is that of {_listed(names)}.", "//"), *rest]
        yield place, changed(
            file, text="\n".join([*before, *header, *behind]), owner=owner,
            added=len(header) - len(own),
        )  # fmt: skip


def _name_of(names: Sequence[str], others: Sequence[str]) -> str:
    """The name for the text of some shaders: what their names have in common, such as the pass.

    That is only if no other shader has this in common with them; else it is the first one's name.
    """
    columns = zip(*(name.split(".") for name in names), strict=False)
    common: list[str] = []
    for column in columns:
        if len(set(column)) > 1:
            break
        common.append(column[0])
    inside = [name for name in others if name.split(".")[: len(common)] == common]
    is_theirs = len(common) > 1 and len(inside) == len(names)
    return ".".join(common) if is_theirs else names[0]


def _listed(names: Sequence[str]) -> str:
    *first, last = names
    return f"{', '.join(first)} and {last}"


def _has(graphs: ShaderGraphs, profile: str, stage: str) -> bool:
    """True if a shader has a text of a stage for a profile."""
    return any(
        full_name(legal.language, legal.profile) == profile and file.stage == stage
        for legal, file in graphs.files()
    )


def _with_files(number: int, graphs: ShaderGraphs, files: dict[Place, EmittedFile]) -> ShaderGraphs:
    emissions = []
    for at, (legal, emission) in enumerate(graphs.emissions):
        own = tuple(
            files.get((number, at, position), file) for position, file in enumerate(emission.files)
        )
        emissions.append((legal, changed(emission, files=own)))
    return changed(graphs, emissions=tuple(emissions))
