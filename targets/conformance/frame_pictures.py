"""The pictures of frames that the reference has drawn, and how they are kept in a store.

``frames.py`` compares them with those of drivers. Those of single shaders are kept by
``runner/reference.py`` in the same store.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ...compiler.documents.writing import to_json
from ...compiler.reference.bounds.errors import Errors
from ...compiler.reference.picture import Counted, RasterRules
from ..runner import __file__ as runner_file
from ..runner.frames.reference_textures import DrawnTexture
from ..runner.frames.subjects import PlannedFrame
from ..runner.kept_arrays import dumped_arrays, loaded_arrays
from ..runner.kept_pictures import Rules, kept
from ..runner.reference import code_digest
from ..runner.store import Store, digest, digest_of_sources


@dataclass(frozen=True, eq=False, slots=True)
class OutputPicture:
    """The first level of an output."""

    format: str
    ends: NDArray[np.float64]
    """The values, and their lower and upper bounds: (3, layers, height, width, lanes)."""
    undecided: NDArray[np.bool_]
    """The pixels that depend on rounding: (layers, height, width)."""

    @classmethod
    def of(cls, drawn: DrawnTexture) -> OutputPicture:
        """A copy of what a texture shows, in which later frames are not drawn."""
        return cls(drawn.format, drawn.levels[0].copy(), drawn.undecided[0].copy())


@dataclass(frozen=True, slots=True)
class FramePictures:
    """The pictures of frames that were drawn one after the other."""

    frames: Sequence[Mapping[str, OutputPicture]]
    """For each frame, the outputs by name."""
    counted: Counted
    """The rare rules on which the pictures depend."""


def remembered(
    store: Store,
    ingredients: Sequence[str],
    rules: RasterRules,
    errors: Errors | None,
    make: Callable[[], FramePictures],
) -> FramePictures:
    """The pictures, from the store if the reference has drawn them before.

    ``ingredients`` are all that they depend on besides rules and errors.
    """

    def name(by: Rules) -> str:
        return digest(_code_digest(), np.__version__, *ingredients, repr((by, errors)))

    return kept(store, rules, name, make, dumped=dumped, loaded=loaded)


def ingredients_of(
    frame: PlannedFrame, programs: Sequence[str], size: tuple[int, int], count: int
) -> list[str]:
    """Everything that the pictures of a frame depend on: its plan, and what each shader declares
    and computes. The scene follows from these."""
    reflections = [to_json(shader.reflection) for shader in frame.shaders]
    said = json.dumps([to_json(frame.plan), reflections, size, count])
    return [said, *programs]


def dumped(pictures: FramePictures) -> bytes:
    """Pictures as bytes, from which ``loaded`` makes them again."""
    shown = [each for frame in pictures.frames for each in frame.values()]
    names = [[(name, each.format) for name, each in frame.items()] for frame in pictures.frames]
    parts = (part for each in shown for part in (each.ends, each.undecided))
    return dumped_arrays([names, sorted(pictures.counted)], parts)


def loaded(data: bytes) -> FramePictures:
    """The pictures that were dumped."""
    (names, counted), arrays = loaded_arrays(data)
    rest = iter(arrays)
    frames = [
        {name: OutputPicture(format_, next(rest), next(rest)) for name, format_ in frame}
        for frame in names
    ]
    return FramePictures(frames, frozenset(map(tuple, counted)))


@cache
def _code_digest() -> str:
    """A digest of the code that draws frames, with that of the host which prepares their draws."""
    names = "frames.py", "judged_frames.py", Path(__file__).name
    own = (Path(__file__).with_name(name).read_bytes() for name in names)
    return digest(code_digest(), digest_of_sources(Path(runner_file).parent), *own)
