"""Reads a frame from the files that ``burnish compile`` has written: plan, reflections, texts.

``burnish render Deferred.plan.json`` draws such a frame without its source. The files may come from
anywhere, so nothing in them is believed: they follow their schemas, name no file outside of their
folder, and are no larger than people make them.
"""

from __future__ import annotations

import json
import math
import struct
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path, PurePath, PureWindowsPath
from typing import Any, NoReturn

from ....compiler.diagnostics.source import Span
from ....compiler.ir.program import StageName
from ....compiler.ir.shader import Shader
from .checking import PlanError, check_plan
from .host import VERSION, PlannedFrame, Row

ENDING = ".plan.json"
"""What the names of plans end with."""
MAX_FILE = 2**26
"""The most bytes of one file: 64 MB."""
MAX_BYTES = 2**28
"""The most bytes of all files together."""
MAX_TOLD = 5
"""How many of the places are told at which a file does not follow its schema."""


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
    """A shader with its reflection; what the source means is not known."""

    name: str
    reflection: Row
    files: Sequence[StoredText]
    lacking: Mapping[str, str] = field(default_factory=dict)

    @property
    def shader(self) -> Shader:
        """Only a source has it. Raises ``PlanError``."""
        return _without_source(self.name)

    def emitted(self, profile: str) -> Shader:
        """Only a source has it, for any ``profile``. Raises ``PlanError``."""
        return _without_source(f"{self.name} for {profile}")


@dataclass(frozen=True, slots=True)
class StoredFrame:
    """A frame that can be drawn by routes."""

    name: str
    plan: Row
    shaders: Sequence[StoredShader]


def is_plan(path: Path) -> bool:
    """Whether a file is called like a plan."""
    return path.name.endswith(ENDING)


def read_frame(path: Path, profiles: Sequence[str]) -> StoredFrame:
    """The frame of a plan, with its texts for some profiles. Raises ``PlanError``."""
    reader = _Reader(path)
    plan = reader.plan()
    shaders = [reader.shader(row, profiles) for row in plan["shaders"]]
    check_plan(plan, [shader.reflection for shader in shaders])
    return StoredFrame(plan["frame"], plan, shaders)


@contextmanager
def told_contradictions(frame: PlannedFrame) -> Iterator[None]:
    """Raise ``PlanError`` for what fails inside the ``with`` block because the files of a frame say
    things that their schemas allow and that cannot all be true, such as steps of a value that add a
    matrix to a number. A frame that Burnish itself has compiled says no such things: what fails
    there is a bug, and raised as it is."""
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
        self._folder = path.parent
        self._left = MAX_BYTES

    def plan(self) -> dict[str, Any]:
        """The plan, which follows its schema."""
        found = self._json(self._path, self._path.name)
        if not isinstance(found, dict) or "plan" not in found:
            raise PlanError(
                f"`{self._path.name}` is no plan: it has no `plan`, which is its version"
            )
        version = found["plan"]
        if version != VERSION or isinstance(version, bool):
            raise PlanError(
                f"`{self._path.name}` is a plan of version {json.dumps(version)[:20]}, and this is "
                f"Burnish for version {VERSION}: compile its source again"
            )
        self._check_schema(found, self._path.name, "plan.schema.json")
        return found

    def shader(self, row: Row, profiles: Sequence[str]) -> StoredShader:
        """One of the plan's shaders, with its texts."""
        name = row["reflection"]
        reflection = self._json(self._beside(name, row["name"]), name)
        self._check_schema(reflection, name, "reflection.schema.json")
        files = [text for profile in profiles for text in self._texts(row, reflection, profile)]
        return StoredShader(row["name"], reflection, files)

    def _texts(self, row: Row, reflection: Row, profile: str) -> list[StoredText]:
        backend = reflection["backends"].get(profile)
        if backend is None:
            known = ", ".join(reflection["backends"]) or "no profile"
            raise PlanError(
                f"{row['name']} has no text for {profile}: `{row['reflection']}` lists {known}. "
                f"Compile the source with --target {profile}"
            )
        target, _, own = profile.partition(":")
        entries: dict[str, dict[StageName, str]] = {}
        for file in backend["files"]:
            entries.setdefault(file["file"], {})[file["stage"]] = file["entry_point"]
        return [
            StoredText(name, target, own, points, self._text(self._beside(name, row["name"]), name))
            for name, points in entries.items()
        ]

    # --- files -----------------------------------------------------------------------------------

    def _beside(self, name: str, what: str) -> Path:
        """A file in the plan's folder, and really there."""
        is_plain = PurePath(name).name == PureWindowsPath(name).name == name
        if not is_plain or name in ("", ".", "..") or not name.isprintable():
            raise PlanError(f"{what}: {json.dumps(name[:60])} is not the name of a file")
        found = self._folder / name
        if found.is_symlink() and not found.resolve().is_relative_to(self._folder.resolve()):
            raise PlanError(f"{what}: `{name}` is a link that leads out of the plan's folder")
        return found

    def _text(self, path: Path, name: str) -> str:
        try:
            if path.exists() and not path.is_file():
                raise PlanError(f"cannot read `{name}`: it is not a file")
            with path.open("rb") as file:
                data = file.read(min(MAX_FILE, self._left) + 1)
        except OSError as error:
            raise PlanError(f"cannot read `{name}`: {error.strerror or error}") from None
        self._left -= len(data)
        if len(data) > MAX_FILE or self._left < 0:
            raise PlanError(
                f"`{name}` is too large: a file has {MAX_FILE // 2**20} MB at most, and all "
                f"together {MAX_BYTES // 2**20} MB"
            )
        try:
            return data.decode("utf-8")
        except UnicodeDecodeError:
            raise PlanError(f"`{name}` is no text in UTF-8") from None

    def _json(self, path: Path, name: str) -> Any:
        text = self._text(path, name)
        try:
            return json.loads(
                text, object_pairs_hook=_members, parse_constant=_constant, parse_float=_float
            )
        except json.JSONDecodeError as error:
            reason = f"{error.msg}, line {error.lineno}, column {error.colno}"
        except RecursionError:
            reason = "it is nested too deeply"
        except ValueError as error:
            reason = str(error)
        raise PlanError(f"`{name}` is no JSON that a plan may be made of: {reason}")

    def _check_schema(self, document: Any, name: str, schema: str) -> None:
        from ....compiler.reflection.schema import errors

        found = errors(document, schema)
        if found:
            told = [f"  {each}" for each in found[:MAX_TOLD]]
            more = [f"  and {len(found) - MAX_TOLD} more"] if len(found) > MAX_TOLD else []
            raise PlanError("\n".join([f"`{name}` does not follow {schema}:", *told, *more]))


def _members(pairs: Sequence[tuple[str, Any]]) -> dict[str, Any]:
    found = dict(pairs)
    if len(found) != len(pairs):
        names = [name for name, _ in pairs]
        twice = next(name for name in names if names.count(name) > 1)
        raise ValueError(f"{json.dumps(twice[:60])} stands twice in one object")
    return found


def _constant(name: str) -> NoReturn:
    raise ValueError(f"{name} is no number of JSON")


def _float(text: str) -> float:
    number = float(text)
    if not math.isfinite(number):
        raise ValueError(f"{text[:20]} is too large for a number")
    return number


def _without_source(name: str) -> NoReturn:
    raise PlanError(f"{name} comes from files: what it means stands in its source only")
