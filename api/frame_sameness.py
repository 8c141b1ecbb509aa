"""Compares two frames: what their plans say, and each two shaders that they draw or run.

``burnish same`` calls ``same_frames`` for files that declare frames of one name, after materials.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from ..compiler.documents.writing import to_json
from ..compiler.equivalence.comparing import (
    EPSILON,
    Comparison,
    Settings,
    Verdict,
    compare,
)
from ..compiler.equivalence.programs import NotComparableError, TooLargeError
from ..compiler.passes.lower_stages import lower_stages
from .compiled import CompiledFrame
from .entry_points import compile as compiled
from .entry_points import has_frames

_SAID_ELSEWHERE = frozenset({
    "doc", "source", "sources", "default", "range", "library", "declared_by", "reflection",
})  # fmt: skip
"""The fields of plans that change no picture: words, places, and what values are usual."""


class FrameComparison(NamedTuple):
    """The result of a comparison of two frames of one name."""

    name: str
    verdict: Verdict
    steps: int
    """The number of steps of the first one."""
    place: str
    """The place where the plans differ first, such as ``steps.lit.targets.0.load``; empty if they
    are alike."""
    shaders: Mapping[str, Comparison | None]
    """The result for each two shaders of one name; ``None`` if they cannot be compared."""


def same_frames(
    first: Path,
    second: Path,
    *,
    epsilon: float = EPSILON,
    boxes: int | None = None,
    seed: int = 1,
    rig: str | None = None,
    search_path: Sequence[Path] = (),
    tell: Callable[[float], None] = lambda _share: None,
) -> list[FrameComparison]:
    """Compares the frames that two files declare by the same names.

    They are proven to be the same if their plans are, with all steps, states and values that the
    host computes, and each two shaders are. A frame with a shader that differs at some point is
    different, although it may never bring the shader to this point. Frames whose plans differ are
    undecided. ``epsilon``, ``boxes`` and ``seed`` are those of
    ``same``. ``tell`` is called with the share that is done.

    Raises ``CompileError``.
    """
    settings = Settings(epsilon, boxes, seed)
    ours, theirs = (
        {each.name: each for each in compiled(path, (), rig=rig, search_path=search_path).frames}
        if has_frames(path, search_path=search_path)
        else {}
        for path in (first, second)
    )
    return [_compared(ours[name], theirs[name], settings, tell) for name in ours if name in theirs]


def _compared(
    one: CompiledFrame, other: CompiledFrame, settings: Settings, tell: Callable[[float], None]
) -> FrameComparison:
    plans = [_meaning(to_json(each.plan_of_reference)) for each in (one, other)]
    place = next(_places(plans[0], plans[1]), "")
    shaders: dict[str, Comparison | None] = {}
    others = {each.name: each.shader for each in other.frame.shaders}
    mine = [each for each in one.frame.shaders if each.name in others]
    for number, each in enumerate(mine):
        try:
            pair = lower_stages(each.shader), lower_stages(others[each.name])
            shaders[each.name] = compare(*pair, settings)
        except (NotComparableError, TooLargeError):
            shaders[each.name] = None
        tell((number + 1) / len(mine))
    steps = len(one.plan_of_reference.steps)
    return FrameComparison(one.name, _verdict(place, shaders), steps, place, shaders)


def _verdict(place: str, shaders: Mapping[str, Comparison | None]) -> Verdict:
    verdicts = {"undecided" if each is None else each.verdict for each in shaders.values()}
    if place or "undecided" in verdicts:
        return "undecided"
    return "different" if "different" in verdicts else "same"


def _meaning(document: Any) -> Any:
    """A plan without what changes no picture."""
    if isinstance(document, Mapping):
        return {
            key: _meaning(value) for key, value in document.items() if key not in _SAID_ELSEWHERE
        }
    return [_meaning(each) for each in document] if isinstance(document, list) else document


def _places(one: Any, other: Any, path: str = "") -> Iterator[str]:
    """The places at which two plans differ, in order; parts of lists by their names or numbers."""
    if isinstance(one, dict) and isinstance(other, dict):
        keys = list(dict.fromkeys([*one, *other]))
        both = [(str(key), one.get(key), other.get(key)) for key in keys]
    elif isinstance(one, list) and isinstance(other, list) and len(one) == len(other):
        both = [
            (_named(x, number), x, y) for number, (x, y) in enumerate(zip(one, other, strict=True))
        ]
    else:
        if one != other:
            yield path
        return
    for key, x, y in both:
        yield from _places(x, y, f"{path}.{key}" if path else key)


def _named(part: Any, number: int) -> str:
    return str(part.get("name", number)) if isinstance(part, dict) else str(number)
