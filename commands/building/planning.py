"""Plans a build: finds the files, the variants of each, and all that each variant reads.

Files are only read, with what they import: that takes a tenth of compiling them. So one machine
plans what many machines then do. ``burnish build`` calls ``actions_of`` first, whatever it does
with the actions.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Sequence
from enum import Enum
from pathlib import Path

from ...compiler.diagnostics.diagnostic import CompileError, Report
from ...compiler.documents.actions import ContentDigest
from ...compiler.frontend import Frontend, current_library
from ...compiler.inputs import Inputs
from ...support.frozen import changed, frozen
from ..results import LIBRARY
from ..source_folders import KINDS, SUFFIX, files_in
from .actions import Action, BuildError, Variant, digest_of


class Demand(Enum):
    """What all files must be before there are any actions.

    A file that is only asked to be there has an action as well if it cannot be read. The action
    fails when it is run, and tells why.
    """

    NOTHING = "nothing"
    THERE = "there"
    READABLE = "readable"


@frozen
class _Opened:
    """A file, and what was learned by reading it."""

    file: str
    """Its path from the current folder, with slashes."""
    rigs: tuple[str, ...]
    inputs: dict[str, ContentDigest]
    folders: tuple[str, ...]


def actions_of(
    given: Sequence[Path],
    search_path: Sequence[Path],
    variants: Sequence[Variant],
    demand: Demand,
) -> list[Action]:
    """The actions of a build, in the order of files and variants.

    ``given`` are files, and folders in which all files are meant that declare something to compile.
    Raises ``BuildError`` and, if files are not what is demanded of them, ``CompileError``.
    """
    report, absent, opened = Report(), Report(), list[_Opened]()
    current_library()
    for file, is_asked_for in _files(given, {each.request.output for each in variants}):
        own = Report()
        found = _open(file, search_path, own, is_asked_for=is_asked_for)
        opened += [] if found is None else [found]
        report.extend(own.diagnostics)
        absent.extend(own.diagnostics if not os.path.lexists(file) else ())
    unmet = {Demand.NOTHING: Report(), Demand.THERE: absent, Demand.READABLE: report}[demand]
    if unmet.failed:
        raise CompileError(unmet.diagnostics)
    actions = [action for each in opened for variant in variants for action in _of(each, variant)]
    if not actions:
        folders = " and ".join(f"`{folder}`" for folder in given)
        raise BuildError(f"no file in {folders} declares a material, a kernel or a frame")
    _insist_on_own_folders(actions)
    return actions


def _of(opened: _Opened, variant: Variant) -> Iterator[Action]:
    """The actions of a file and a variant: one for each of its rigs, if it has to be chosen."""
    several = variant.request.rig is None and len(opened.rigs) > 1
    for rig in opened.rigs if several else (variant.request.rig,):
        own = opened.file.removesuffix(SUFFIX)
        parts = (variant.name, own, rig if several and rig else "")
        name = "/".join(filter(None, parts))
        request = changed(
            variant.request, files=(Path(opened.file),), rig=rig,
            output=f"{variant.request.output}/{name}",
        )  # fmt: skip
        yield Action(variant, name, request, opened.inputs, opened.folders)


def _files(given: Iterable[Path], outputs: Iterable[str]) -> Iterator[tuple[str, bool]]:
    """The paths of all files, each once; true for those that were named themselves."""
    left_out = {os.path.realpath(each) for each in outputs}
    known: set[str] = set()
    for path in given:
        is_folder = path.is_dir()
        for file in files_in(path, left_out) if is_folder else (str(path),):
            name = _from_here(file)
            if name not in known:
                known.add(name)
                yield name, not is_folder


def _from_here(file: str) -> str:
    """The path of a file from the current folder. Raises ``BuildError`` if that leads outside."""
    try:
        path = os.path.relpath(file).replace(os.sep, "/")
    except ValueError:  # On Windows, no path leads from one drive to another.
        path = ".."
    if path == ".." or path.startswith("../"):
        raise BuildError(
            f"`{file}` lies outside of this folder, from which the paths of outputs are counted: "
            "run `burnish build` in a folder that has all of its files"
        )
    return path


def _open(
    file: str, search_path: Sequence[Path], report: Report, *, is_asked_for: bool
) -> _Opened | None:
    """Read a file with its imports; ``None`` if there is nothing in it to compile."""
    inputs = Inputs()
    frontend = Frontend(report, search_path, inputs)
    module = frontend.open_file(Path(file))
    rigs: tuple[str, ...] = ()
    if module is not None and not report.failed:
        if not is_asked_for and not any(frontend.declared(module, kind) for kind in KINDS):
            return None
        rigs = frontend.declared(module, "rig")
    folders = tuple(each.replace(os.sep, "/") for each in inputs.folders)
    return _Opened(file, rigs, digests_of(inputs), folders)


def digests_of(inputs: Inputs) -> dict[str, ContentDigest]:
    """The digests of all files that were read, but for the library's, by their paths."""
    found = {}
    for asked, real in inputs.links.items():
        content = inputs.contents.get(real)
        if content is not None and not real.startswith(LIBRARY):
            found[os.path.normpath(asked).replace(os.sep, "/")] = digest_of(content)
    return dict(sorted(found.items()))


def _insist_on_own_folders(actions: Iterable[Action]) -> None:
    """Raise ``BuildError`` if two actions would write the same files.

    Names that differ in capital letters only are one folder on many disks.
    """
    owners: dict[str, Action] = {}
    for action in actions:
        owner = owners.setdefault(action.request.output.casefold(), action)
        if owner is not action:
            first, second = (each.request.files[0] for each in (owner, action))
            raise BuildError(
                f"`{first}` and `{second}` would both write into `{action.request.output}`: rename "
                "one of them"
            )
