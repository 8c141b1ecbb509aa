"""Words and rows about frames, which ``burnish same`` prints."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ..api.frame_sameness import FrameComparison


def frame_sentences(found: FrameComparison) -> Iterator[str]:
    """Sentences about what was compared, and where it is not the same."""
    if found.place:
        yield f"the plans differ at {found.place}"
    else:
        yield f"the plans are alike, with {_counted(found.steps, 'step')}"
    proven = sum(each is not None and each.verdict == "same" for each in found.shaders.values())
    yield f"{proven} of {_counted(len(found.shaders), 'shader')} proven to be the same"
    for name, each in found.shaders.items():
        if each is None:
            yield f"{name} cannot be compared"
        elif each.verdict != "same":
            witness = each.witness
            yield (
                f"{name} is open"
                if witness is None
                else (
                    f"{name} differs: {witness.lane} is {witness.first:.6g} in A and "
                    f"{witness.second:.6g} in B for some values"
                )
            )


def frame_row(found: FrameComparison) -> dict[str, Any]:
    """The comparison of two frames as a row of JSON."""
    return {
        "frame": found.name,
        "verdict": found.verdict,
        "steps": found.steps,
        "plans_differ_at": found.place or None,
        "shaders": {
            name: None if each is None else each.verdict for name, each in found.shaders.items()
        },
    }


def _counted(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"
