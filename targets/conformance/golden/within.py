"""Judges pictures by a golden folder: each number has to lie within its bounds.

``burnish judge`` and ``burnish.testing`` call it. It needs NumPy and Python's standard library
only, and no other part of Burnish: docs/golden.md says all that it does, for who writes the same
in another language.
"""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Bools = NDArray[np.bool_]

Encoding = Literal["linear", "srgb"]
ENCODINGS: tuple[Encoding, ...] = get_args(Encoding)
"""How the whole numbers of a picture are meant."""

NAME = "golden.json"
FORMAT = "burnish-golden"
VERSION = 1
_MOST_BYTES = 64 << 20
"""The most bytes of a document that is read."""
_MOST_LANES = 4


class GoldenError(ValueError):
    """A golden folder, or a picture, cannot be judged; the text says why."""


@dataclass(frozen=True, slots=True)
class Output:
    """One output of a case, by which pictures are judged."""

    root: Path
    subject: str
    case: str
    folder: str
    """The folder of the case, below ``root``."""
    name: str
    width: int
    height: int
    lanes: int

    @property
    def title(self) -> str:
        """The output as messages call it."""
        return f"{self.folder}/{self.name}"


@dataclass(frozen=True, slots=True)
class Worst:
    """The number that is farthest outside of its bounds, in units of the picture's values."""

    x: int
    y: int
    lane: int
    value: float
    lower: float
    upper: float
    largest: int = 1
    """The code that stands for 1, in pictures of whole numbers."""


@dataclass(frozen=True, eq=False, slots=True)
class Verdict:
    """What has become of a picture."""

    compared: int
    undecided: int
    outside: Bools
    """The pixels with a number outside of its bounds, (height, width)."""
    worst: Worst | None
    """The worst pixel; ``None`` if none is outside."""

    @property
    def is_good(self) -> bool:
        """True if every number that is compared is within its bounds."""
        return self.worst is None


# --- golden folders -----------------------------------------------------------------------------


def outputs_of(root: Path) -> list[Output]:
    """All outputs of all cases in a golden folder. Raises ``GoldenError``."""
    document = _document(root / NAME)
    found: list[Output] = []
    for row in _rows(document, "cases", NAME):
        where = f"{NAME}, case {row.get('folder', len(found))!r}"
        folder = _typed(row, "folder", str, where)
        if Path(folder).is_absolute() or ".." in Path(folder).parts:
            raise GoldenError(f"{where}: its folder is not below that of the document")
        width, height = (_positive(row, side, where) for side in ("width", "height"))
        for output in _rows(row, "outputs", where):
            name = _typed(output, "name", str, where)
            if Path(name).name != name:
                raise GoldenError(f"{where}: `{name}` is no name of a file")
            if any((folder, name) == (each.folder, each.name) for each in found):
                raise GoldenError(f"{where}: the output {name!r} is listed twice")
            found.append(Output(
                root, _typed(row, "subject", str, where), _typed(row, "case", str, where), folder,
                name, width, height, _positive(output, "lanes", where, _MOST_LANES),
            ))  # fmt: skip
    if not found:
        raise GoldenError(f"{root / NAME} has no cases")
    return found


def chosen(outputs: Sequence[Output], case: str | None, name: str | None = None) -> list[Output]:
    """The outputs of a case: ``case`` is its name, with or without its subject. Raises
    ``GoldenError`` if there is no such case or output, or if several cases have the name."""
    found = list(outputs)
    if case is not None:
        named = {each.folder for each in outputs if case in _names(each)}
        if not named:
            raise GoldenError(f"there is no case `{case}`: there are {_listed(outputs)}")
        if len(named) > 1:
            raise GoldenError(f"several cases are called `{case}`: {', '.join(sorted(named))}")
        found = [each for each in outputs if each.folder in named]
    if name is None:
        return found
    own = [each for each in found if each.name == name]
    if not own:
        there = ", ".join(dict.fromkeys(each.name for each in found))
        raise GoldenError(f"there is no output `{name}`: there is {there}")
    return own


def only(outputs: Sequence[Output], case: str | None, name: str | None = None) -> Output:
    """The only output of a case. Raises ``GoldenError`` where several are possible."""
    found = chosen(outputs, case, name)
    if len({each.folder for each in found}) > 1:
        raise GoldenError(f"name one of the cases: {_listed(found)}")
    if len(found) > 1:
        names = ", ".join(each.name for each in found)
        raise GoldenError(f"{found[0].folder} has several outputs, name one of them: {names}")
    return found[0]


def _names(output: Output) -> tuple[str, ...]:
    return output.folder, f"{output.subject}/{output.case}", output.case


def _listed(outputs: Sequence[Output]) -> str:
    return ", ".join(dict.fromkeys(each.folder for each in outputs))


def _document(path: Path) -> dict[str, Any]:
    if not path.is_file():
        raise GoldenError(f"{path.parent} is no golden folder: it has no file {NAME}")
    try:
        with path.open("rb") as file:
            data = file.read(_MOST_BYTES + 1)
        if len(data) <= _MOST_BYTES:
            document = json.loads(data.decode("utf-8"))
    except OSError as error:
        raise GoldenError(f"cannot read {path}: {error.strerror or error}") from None
    except ValueError as error:
        raise GoldenError(f"{path} is no JSON: {error}") from None
    except RecursionError:
        raise GoldenError(f"{path} is no document: it is nested too deeply") from None
    if len(data) > _MOST_BYTES:
        raise GoldenError(f"{path} is too large: it has over {_MOST_BYTES} bytes")
    if not isinstance(document, dict) or document.get("format") != FORMAT:
        raise GoldenError(f"{path} is not the document of a golden folder")
    version = document.get("version")
    if version != VERSION or isinstance(version, bool):
        newer = isinstance(version, int) and version > VERSION
        way = "a newer Burnish reads it" if newer else "write the golden folder again"
        raise GoldenError(
            f"{path} is of version {json.dumps(version)}, and {VERSION} is read here: {way}"
        )
    return document


def _rows(row: dict[str, Any], key: str, where: str) -> Iterator[dict[str, Any]]:
    for each in _typed(row, key, list, where):
        if not isinstance(each, dict):
            raise GoldenError(f"{where}: `{key}` has something that is no object")
        yield each


def _typed(row: dict[str, Any], key: str, kind: type, where: str) -> Any:
    found = row.get(key)
    if not isinstance(found, kind) or isinstance(found, bool):
        raise GoldenError(f"{where}: `{key}` is missing, or has a wrong type")
    return found


def _positive(row: dict[str, Any], key: str, where: str, most: int = 1 << 20) -> int:
    found: int = _typed(row, key, int, where)
    if not 1 <= found <= most:
        raise GoldenError(f"{where}: `{key}` is {found}, which is not from 1 to {most}")
    return found


# --- bounds -------------------------------------------------------------------------------------


def bounds_of(output: Output) -> tuple[Floats, Floats, Bools]:
    """The lower and the upper bounds of an output, and its undecided pixels.

    Raises ``GoldenError`` if a file is missing, damaged or of another size.
    """
    folder, shape = output.root / output.folder, (output.height, output.width, output.lanes)
    low, high = (
        _golden(folder / f"{output.name}.{end}.npy", shape, np.dtype("<f8"))
        for end in ("lower", "upper")
    )
    undecided = _golden(folder / "undecided.npy", shape[:2], np.dtype("u1"))
    if undecided.max() > 1:
        raise GoldenError(f"{folder / 'undecided.npy'} is damaged: it has numbers above 1")
    for end, array in (("lower", low), ("upper", high)):
        if np.isnan(array).any():
            raise GoldenError(f"{folder}/{output.name}.{end}.npy is damaged: it has NaN")
    if (low > high).any():
        y, x, lane = np.argwhere(low > high)[0]
        raise GoldenError(
            f"{output.title} is damaged: the lower bound of pixel {x},{y}, lane {lane}, "
            "is above the upper one"
        )
    return low, high, undecided == 1


def reference_of(output: Output) -> Floats:
    """What an output means, in double precision. Raises ``GoldenError``."""
    path = output.root / output.folder / f"{output.name}.reference.npy"
    return _golden(path, (output.height, output.width, output.lanes), np.dtype("<f8"))


def _golden(path: Path, shape: tuple[int, ...], kind: np.dtype[Any]) -> NDArray[Any]:
    """An array of a golden folder. Raises ``GoldenError`` if it has another shape or type."""
    found = read_npy(path)
    if found.dtype != kind:
        raise GoldenError(f"{path} has numbers of the type {found.dtype}, and not {kind}")
    if found.shape != shape:
        raise GoldenError(f"{path} has the shape {found.shape}, and not {shape}")
    return np.array(found)


def read_npy(path: Path) -> NDArray[Any]:
    """The array in an ``.npy`` file, of which little is read as long as nobody asks for it.

    Raises ``GoldenError`` for whatever is no such file.
    """
    if not path.is_file():
        raise GoldenError(f"there is no file {path}")
    try:
        with path.open("rb") as file:
            if file.read(6) != b"\x93NUMPY":
                raise GoldenError(f"{path} is no .npy file")
        found = np.load(path, mmap_mode="r", allow_pickle=False)
    except GoldenError:
        raise
    except OSError as error:
        raise GoldenError(f"cannot read {path}: {error.strerror or error}") from None
    except Exception as error:  # Of a damaged header, NumPy raises whatever it comes upon.
        first = str(error).partition("\n")[0]
        raise GoldenError(f"{path} is damaged: {first}") from None
    return np.asarray(found)


# --- pictures -----------------------------------------------------------------------------------


def judged(picture: NDArray[Any], output: Output, encoding: Encoding = "linear") -> Verdict:
    """The verdict about a picture, whose top row comes first: (height, width) or with lanes.

    Pictures of 8 or 16 bits are whole numbers, which may be ``encoded`` as sRGB. Raises
    ``GoldenError`` for what cannot be compared.
    """
    lanes = _lanes(picture, output, encoding)
    low, high, undecided = bounds_of(output)
    low, high = low[..., : lanes.shape[2]], high[..., : lanes.shape[2]]
    if lanes.dtype.kind == "u":
        low, high, scale = _codes(low, high, lanes.dtype, encoding)
    else:
        scale = 1.0
    values = lanes.astype(np.float64)
    with np.errstate(invalid="ignore"):
        away = np.where(values > high, values - high, low - values)
    is_out = ~((values >= low) & (values <= high)) & ~undecided[..., None]
    if undecided.all():
        raise GoldenError(f"nothing is compared: all pixels of {output.title} are undecided")
    away = np.where(is_out, np.where(np.isnan(away), np.inf, away), -1.0)
    return Verdict(
        int((~undecided).sum()),
        int(undecided.sum()),
        np.asarray(is_out.any(axis=2)),
        _worst(away, values / scale, low / scale, high / scale, int(scale))
        if is_out.any()
        else None,
    )


def _lanes(picture: NDArray[Any], output: Output, encoding: str) -> NDArray[Any]:
    """A picture as (height, width, lanes). Raises ``GoldenError``."""
    if encoding not in ENCODINGS:
        raise GoldenError(f"there is no encoding `{encoding}`: there are {', '.join(ENCODINGS)}")
    kind = (picture.dtype.kind, picture.dtype.itemsize)
    if kind not in (("f", 2), ("f", 4), ("f", 8), ("u", 1), ("u", 2)):
        raise GoldenError(
            f"the picture has numbers of the type {picture.dtype}: it takes floats of 16, 32 or 64 "
            "bits, or whole numbers of 8 or 16 bits without a sign"
        )
    if picture.dtype.kind == "f" and encoding != "linear":
        raise GoldenError("the picture has floats, which are linear: only integers are encoded")
    lanes = picture[..., None] if picture.ndim == 2 else picture
    if lanes.ndim != 3 or 0 in lanes.shape:
        raise GoldenError(
            f"the picture has the shape {picture.shape}, and not (height, width, lanes)"
        )
    height, width, count = lanes.shape
    if (height, width) != (output.height, output.width):
        raise GoldenError(
            f"the picture is {width} x {height} pixels large, and {output.title} is "
            f"{output.width} x {output.height}"
        )
    if count > output.lanes:
        raise GoldenError(
            f"the picture has {count} lanes, and {output.title} has {output.lanes}: leave out "
            "the others"
        )
    return lanes


def _codes(
    low: Floats, high: Floats, kind: np.dtype[Any], encoding: str
) -> tuple[Floats, Floats, float]:
    """The whole numbers that a format may have for bounds, and its largest one."""
    most = float(np.iinfo(kind).max)
    ends = [np.clip(end, 0.0, 1.0) for end in (low, high)]
    if encoding == "srgb":
        for end in ends:
            end[..., :3] = srgb(end[..., :3])
    return np.floor(ends[0] * most), np.ceil(ends[1] * most), most


def srgb(linear: Floats) -> Floats:
    """Linear light in 0..1 as it is encoded by sRGB (IEC 61966-2-1)."""
    curve: Floats = np.where(
        linear <= 0.0031308, linear * 12.92, 1 + 1.055 * (linear ** (1 / 2.4) - 1)
    )
    return curve


def _worst(away: Floats, values: Floats, low: Floats, high: Floats, largest: int) -> Worst:
    """The first of the numbers that are farthest outside, by rows."""
    at = np.unravel_index(int(away.argmax()), away.shape)
    y, x, lane = map(int, at)
    return Worst(x, y, lane, float(values[at]), float(low[at]), float(high[at]), largest)


def sentence(verdict: Verdict) -> str:
    """What there is to say about a verdict, in one or two lines."""
    compared = f"{verdict.compared} pixels compared, {verdict.undecided} undecided"
    worst = verdict.worst
    if worst is None:
        return f"within its bounds: {compared}"
    lane = "rgba"[worst.lane]
    value, lower, upper = (
        f"{number:.9g}" if worst.largest == 1 else f"{round(number * worst.largest)}"
        for number in (worst.value, worst.lower, worst.upper)
    )
    return (
        f"outside of its bounds: {int(verdict.outside.sum())} of {compared}\n"
        f"  the worst is pixel {worst.x},{worst.y}, lane {worst.lane} ({lane}): {value} "
        f"is not within {lower} and {upper}"
    )
