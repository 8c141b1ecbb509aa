"""Reads a frame from the files that ``burnish compile`` has written: plan, reflections, texts.

``burnish render Deferred.plan.json`` draws such a frame without its source. The files may come from
anywhere, so nothing in them is believed: they follow their schemas, name no file outside of their
folder, and are no larger than people make them.
"""

from __future__ import annotations

import json
import struct
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path, PurePath, PureWindowsPath
from typing import Any, NoReturn, TypeVar

from ....compiler.budget import check
from ....compiler.diagnostics.source import Span
from ....compiler.documents.plan import FramePlan, ShaderRow
from ....compiler.documents.reading import ShapeError, read, shown
from ....compiler.documents.reflection import Reflection
from ....compiler.ir.program import StageName
from ....compiler.ir.shader import Shader
from ....compiler.ir.stages import COMPUTE
from ....support.garbage import seldom_collected
from ...toolchain.directives import foreign_directive
from ..documents import Quota, read_json
from ..files import read_file
from .checking import PlanError, check_plan
from .checks.backends import check_backend
from .checks.work_groups import check_work_group
from .subjects import PlannedFrame

D = TypeVar("D")

DOCUMENTS: Mapping[type, str] = {FramePlan: "plan", Reflection: "reflection"}
"""The names of documents in messages."""

ENDING = ".plan.json"
"""The ending of the file names of plans."""


@dataclass(frozen=True, slots=True)
class StoredText:
    """A text of a shader, for one stage or several."""

    name: str
    target: str
    profile: str
    entry_points: Mapping[StageName, str]
    text: str
    spans: Mapping[int, Span] = field(default_factory=dict)
    """Empty: spans are places of the source, which is not there."""


@dataclass(frozen=True, slots=True)
class StoredShader:
    """A shader with its reflection; its meaning, which the source has, is not known."""

    name: str
    reflection: Reflection
    files: Sequence[StoredText]
    lacking: Mapping[str, str] = field(default_factory=dict)

    @property
    def shader(self) -> Shader:
        """Raise ``PlanError``: only a source has the shader."""
        return _without_source(self.name)

    def emitted(self, profile: str) -> Shader:
        """Raise ``PlanError``: only a source has the shader of a ``profile``."""
        return _without_source(f"{self.name} for {profile}")


@dataclass(frozen=True, slots=True)
class StoredFrame:
    """A frame that can be drawn by routes."""

    name: str
    plan: FramePlan
    shaders: Sequence[StoredShader]


def is_plan(path: Path) -> bool:
    """True if a file has the name of a plan."""
    return path.name.endswith(ENDING)


@seldom_collected
def read_frame(path: Path, profiles: Sequence[str]) -> StoredFrame:
    """The frame of a plan, with its texts for some profiles. Raises ``PlanError``, ``FileError``
    and ``BudgetError``."""
    reader = _Reader(path)
    plan = reader.plan()
    shaders = [reader.shader(row, profiles) for row in plan.shaders]
    check_plan(plan, [shader.reflection for shader in shaders])
    return StoredFrame(plan.frame, plan, shaders)


@contextmanager
def told_contradictions(frame: PlannedFrame) -> Iterator[None]:
    """Raise ``PlanError`` for failures inside the ``with`` block that the frame's files cause.

    Files may contradict themselves although their schemas allow it, such as steps of a value that
    add a matrix to a number. A frame that Burnish itself has compiled does not: its failures are
    bugs, and raised as they are.
    """
    try:
        yield
    except (ArithmeticError, AssertionError, AttributeError, LookupError, TypeError, struct.error,
            ValueError) as error:  # fmt: skip
        is_told = isinstance(error, ValueError) and type(error) is not ValueError
        if is_told or not isinstance(frame, StoredFrame):
            raise
        raise PlanError(
            f"{frame.name}: its files contradict each other: {type(error).__name__}: {error}"
        ) from error


class _Reader:
    """Reads the files beside a plan; counts what it has read."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._files = f"`{path.name}`, with the files that it names, has"
        self._quota = Quota(self._files)
        self._bytes = 0
        self._shaders: dict[str, str] = {}
        """The shaders that have been read, by the files of their reflections."""

    def plan(self) -> FramePlan:
        """The plan, which follows its schema."""
        name = self._path.name
        found = read_json(self._data(self._path, links=True), f"`{name}`", self._quota)
        if not isinstance(found, dict) or FramePlan.VERSION not in found:
            raise PlanError(f"`{name}` is no plan: it has no `plan`, which is its version")
        return self._read(FramePlan, found, name)

    def shader(self, row: ShaderRow, profiles: Sequence[str]) -> StoredShader:
        """One of the plan's shaders, with its texts."""
        file, name = row.reflection, row.name
        if file in self._shaders:
            raise PlanError(f"{name} and {self._shaders[file]} have one reflection, `{file}`")
        self._shaders[file] = name
        found = read_json(self._data(self._beside(file, name)), f"`{file}`", self._quota)
        reflection = self._read(Reflection, found, file)
        files = [text for profile in profiles for text in self._texts(row, reflection, profile)]
        return StoredShader(name, reflection, files)

    def _texts(self, row: ShaderRow, reflection: Reflection, profile: str) -> list[StoredText]:
        backend = reflection.backends.get(profile)
        if backend is None:
            known = ", ".join(reflection.backends) or "no profile"
            raise PlanError(
                f"{row.name} has no text for {profile}: `{row.reflection}` lists {known}. "
                f"Compile the source with --target {profile}"
            )
        check_backend(row.name, reflection, profile)
        target, _, own = profile.partition(":")
        entries: dict[str, dict[StageName, str]] = {}
        for file in backend.files:
            entries.setdefault(file.file, {})[file.stage] = file.entry_point
        texts = [
            StoredText(name, target, own, points, self._text(name, row.name))
            for name, points in entries.items()
        ]
        for text in texts:
            if COMPUTE.name in text.entry_points:
                group = reflection.work_group
                check_work_group(row.name, group, target, text.text, file=text.name)
        return texts

    # --- files -----------------------------------------------------------------------------------

    def _beside(self, name: str, what: str) -> Path:
        """A file in the plan's folder."""
        is_plain = PurePath(name).name == PureWindowsPath(name).name == name
        if not is_plain or name in ("", ".", "..") or not name.isprintable():
            raise PlanError(f"{what}: {json.dumps(name[:60])} is not the name of a file")
        return self._path.parent / name

    def _data(self, path: Path, *, links: bool = False) -> bytes:
        """The bytes of a file. Only the plan itself may be a link."""
        data = read_file(path, f"`{path.name}`", "document", links=links)
        self._bytes += len(data)
        check("document", self._bytes, self._files)
        return data

    def _text(self, name: str, what: str) -> str:
        """A text, which drivers may compile themselves."""
        try:
            text = self._data(self._beside(name, what)).decode("utf-8")
        except UnicodeDecodeError:
            raise PlanError(f"`{name}` is no text in UTF-8") from None
        if found := foreign_directive(text):
            line, directive = found
            raise PlanError(
                f"`{name}`, line {line}: no text of Burnish has the directive {shown(directive)}"
            )
        return text

    def _read(self, kind: type[D], document: Any, name: str) -> D:
        try:
            return read(kind, document)
        except ShapeError as error:
            lines = str(error).splitlines()
            raise PlanError(
                f"`{name}` is no {DOCUMENTS[kind]} that can be read:",
                *(f"  {each}" for each in lines),
            ) from None


def _without_source(name: str) -> NoReturn:
    raise PlanError(f"{name} comes from files: what it means stands in its source only")
