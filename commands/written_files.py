"""What ``burnish compile`` writes: the files that all sources of a command line become together.

Nothing is overwritten silently: two outputs with one name are told before anything is written.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from .compiled_record import Compiled


def written_of(files: Sequence[Path], found: Sequence[Compiled]) -> dict[str, str | bytes]:
    """The content of each output, by its name, in the order in which they are put in place.

    Reflections come behind the shaders, and plans last: whoever sees a new one finds what it
    describes. Raises ``CompileError`` if two outputs would be one file.
    """
    _insist_on_one_file_for_each(files, found)
    parts = (*_shaders(found), *_documents(found))
    return {name: content for part in parts for name, content in part.items()}


def owners_of(files: Sequence[Path], found: Sequence[Compiled]) -> dict[str, tuple[str, ...]]:
    """The names of the outputs of each source."""
    return {
        str(file): tuple(name for part in _parts(each) for name in part)
        for file, each in zip(files, found, strict=True)
    }


def _shaders(found: Sequence[Compiled]) -> Iterator[Mapping[str, str | bytes]]:
    yield from (each.texts for each in found)
    yield from (each.modules for each in found)


def _documents(found: Sequence[Compiled]) -> Iterator[Mapping[str, str]]:
    yield from (each.reflections for each in found)
    yield from (each.plans for each in found)


def _parts(found: Compiled) -> tuple[Mapping[str, str | bytes], ...]:
    return found.texts, found.modules, found.reflections, found.plans


def _insist_on_one_file_for_each(files: Sequence[Path], found: Sequence[Compiled]) -> None:
    """Raise ``CompileError`` if an output would replace another one.

    Names that differ in capital letters only are one file on many disks.
    """
    from ..compiler.diagnostics import rules
    from ..compiler.diagnostics.diagnostic import CompileError, Report

    report, owners = Report(), dict[str, tuple[Path, str]]()
    for file, names in zip(files, owners_of(files, found).values(), strict=True):
        for name in names:
            owner, first = owners.setdefault(name.casefold(), (file, name))
            if owner != file:
                report.add(rules.SAME_OUTPUT, None, name=name, first=owner, second=file)
                break
            if first != name:
                report.add(
                    rules.SAME_BUT_FOR_CAPITALS, None, path=file, first=first, second=name
                )  # fmt: skip
                break
    if report.failed:
        raise CompileError(report.diagnostics)
