"""``burnish same``: proves that two materials mean the same, or shows where they do not."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from .answering import collector
from .compile_options import is_range
from .console import Styled, remark, say, show
from .failures import needed
from .options import answer_option, pairs, pass_option, rig_option, search_option
from .progress import Progress
from .same_frames import frame_row, frame_sentences
from .same_values import ranges_of, values_of

if TYPE_CHECKING:
    from ..api.frame_sameness import FrameComparison
    from ..api.sameness import Comparison, Witness

DIFFERENT, UNUSABLE, UNDECIDED = 1, 2, 3
"""Exit codes: they differ; there is nothing to compare; neither was shown."""
_CODES = {"same": 0, "different": DIFFERENT, "undecided": UNDECIDED}
_COLORS = {"same": "green", "different": "red", "undecided": "yellow"}
_WORDS = {"same": "same", "different": "differs", "undecided": "open"}
_MOST_SHOWN = 12
"""The number of values, or of sides of a box, that are printed."""


class _Request(NamedTuple):
    """The command line after parsing; the names are those of the options."""

    first: str
    second: str
    material: str | None
    rig: str | None
    pass_: str | None
    epsilon: float
    boxes: int | None
    values: tuple[tuple[str, str], ...]
    first_values: tuple[tuple[str, str], ...]
    second_values: tuple[tuple[str, str], ...]
    ranges: tuple[tuple[str, str], ...]
    seed: int
    search_path: tuple[Path, ...]


class _Side(NamedTuple):
    """One of both materials."""

    path: Path
    material: str


@click.command()
@click.argument("first", metavar="A[#MATERIAL]")
@click.argument("second", metavar="B[#MATERIAL]")
@click.option(
    "--material", metavar="NAME", help="The material to compare, if a file has several.",
)  # fmt: skip
@rig_option
@pass_option
@click.option(
    "--epsilon", type=float, default=1e-4, show_default=True, metavar="E",
    help="How much two numbers may differ: so much of the larger one, or of 1.",
)  # fmt: skip
@click.option(
    "--boxes", type=click.IntRange(1, 100_000_000), metavar="N",
    help="The most boxes of the space that are looked at; by default, as many as take some "
    "seconds.",
)  # fmt: skip
@click.option(
    "--set", "values", metavar="NAME=VALUE", multiple=True, callback=pairs,
    help="Give a parameter or an input one value in both, or a range, as 0.3..0.5; may be given "
    "many times.",
)  # fmt: skip
@click.option(
    "--set-a", "first_values", metavar="NAME=VALUE", multiple=True, callback=pairs,
    help="The same in A alone.",
)  # fmt: skip
@click.option(
    "--set-b", "second_values", metavar="NAME=VALUE", multiple=True, callback=pairs,
    help="The same in B alone.",
)  # fmt: skip
@click.option(
    "--range", "ranges", metavar="NAME=LOW..HIGH", multiple=True, callback=pairs,
    help="Compare over another range of a parameter, an input or a texture; may be given many "
    "times.",
)  # fmt: skip
@click.option(
    "--seed", type=click.IntRange(0, 2**31 - 1), default=1, show_default=True, metavar="N",
    help="Choose other random points.",
)  # fmt: skip
@search_option
@answer_option
def same(**chosen: Any) -> None:
    """Prove that the materials A and B mean the same, or show where they differ.

    Both are written out as formulas of what comes from outside: parameters, lights, vertex inputs
    and textures of one name are the same in both. Names, functions and the order of sums are no
    difference. What is left is compared by algebra, by random points, and by bounds over boxes of
    the ranges.

    \b
    The answer is one of these:
        same      proven for all values in all ranges           exit code 0
        differs   with values for which a result differs        exit code 1
        open      with the share of the space that is proven    exit code 3

    The exit code is 2 if a file has errors, or if the two cannot be compared.

    \b
    Example:
        burnish same before.burnish after.burnish
        burnish same materials.burnish#Copper materials.burnish#Brass
        burnish same coat.burnish plain.burnish --set-a coat_weight=0
        burnish same a.burnish b.burnish --range albedo=0..4 --epsilon 1e-3
    """
    request = _Request(**chosen)
    from ..compiler.diagnostics.diagnostic import CompileError

    context = click.get_current_context()
    try:
        from ..api.sameness import SameError
    except ModuleNotFoundError as error:
        needed(error)
    try:
        code = _compared(request)
    except CompileError as error:
        show(error.diagnostics)
        code = UNUSABLE
    except SameError as error:
        remark("error", str(error))
        code = UNUSABLE
    context.exit(code)


def _compared(request: _Request) -> int:
    """Compare all that is asked for, print it, and return the exit code."""
    collected = collector()
    rows = []
    worst = 0
    for one, other in _sides(request):
        with Progress("proven") as progress:
            found = _comparison(request, one, other, progress)
        worst = _worse(worst, _CODES[found.verdict])
        if collected is not None:
            rows.append(_row(one, other, found))
        else:
            _tell(one, other, found)
    for frame in _frames(request):
        worst = _worse(worst, _CODES[frame.verdict])
        if collected is not None:
            rows.append(frame_row(frame))
        else:
            _tell_frame(frame)
    if collected is not None:
        from ..compiler.documents.answer import SameAnswer

        collected.find(SameAnswer(comparisons=tuple(rows)))
    return worst


def _frames(request: _Request) -> list[FrameComparison]:
    """Compares frames of one name, if whole files are compared, for all values."""
    from ..api.frame_sameness import same_frames

    narrowed = (*request.values, *request.first_values, *request.second_values, *request.ranges)
    if request.material or request.pass_ or "#" in request.first + request.second or narrowed:
        return []
    with Progress("compared") as progress:
        return same_frames(
            Path(request.first), Path(request.second),
            epsilon=request.epsilon, boxes=request.boxes, seed=request.seed,
            rig=request.rig, search_path=request.search_path, tell=progress.tell,
        )  # fmt: skip


def _worse(one: int, other: int) -> int:
    """The exit code of two comparisons: a difference is worse than what is not decided."""
    return DIFFERENT if DIFFERENT in (one, other) else max(one, other)


def _comparison(request: _Request, one: _Side, other: _Side, progress: Progress) -> Comparison:
    from ..api.sameness import same as compared

    spread = [pair for pair in request.values if is_range(pair[1])]
    set_ = [pair for pair in request.values if not is_range(pair[1])]
    return compared(
        one.path, other.path, material=one.material, second_material=other.material,
        rig=request.rig, pass_=request.pass_, search_path=request.search_path,
        epsilon=request.epsilon, boxes=request.boxes, values=values_of(set_),
        first_values=values_of(request.first_values),
        second_values=values_of(request.second_values),
        ranges=ranges_of((*spread, *request.ranges)), seed=request.seed, tell=progress.tell,
    )  # fmt: skip


def _sides(request: _Request) -> list[tuple[_Side, _Side]]:
    """The pairs of materials: the named ones, the only ones, or those of one name."""
    ours, theirs = (_found(text, request) for text in (request.first, request.second))
    if len(ours) == len(theirs) == 1:
        return [(ours[0], theirs[0])]
    by_name = {side.material: side for side in theirs}
    found = [(side, by_name[side.material]) for side in ours if side.material in by_name]
    if not found:
        names = [", ".join(side.material for side in each) for each in (ours, theirs)]
        raise click.UsageError(
            f"{request.first} has {names[0]}, and {request.second} has {names[1]}: choose one of "
            "each, as in A.burnish#NAME"
        )
    left = {side.material for side in (*ours, *theirs)} - {side.material for side, _ in found}
    if left:
        remark("note", f"only one of both files has {', '.join(sorted(left))}")
    return found


def _found(text: str, request: _Request) -> list[_Side]:
    """The materials of a file, or the one that is named behind ``#``."""
    from ..api.sameness import SameError, names_of
    from ..compiler.diagnostics.nearest import suggestion

    name, mark, material = text.rpartition("#")
    path, wanted = (Path(name), material) if mark and name else (Path(text), request.material)
    names = names_of(path, request.search_path)
    if wanted is not None and wanted not in names:
        hint = suggestion(wanted, names) or (
            f"there are {', '.join(names)}" if names else "it has none"
        )
        raise SameError(f"{path} has no material `{wanted}`: {hint}")
    if not names:
        raise SameError(f"{path} has no material or kernel that could be compared")
    return [_Side(path, each) for each in names if wanted in (None, each)]


# --- what is told --------------------------------------------------------------------------------


def _tell(one: _Side, other: _Side, found: Comparison) -> None:
    for note in found.notes:
        remark("note", note)
    word = Styled(_WORDS[found.verdict], _COLORS[found.verdict], is_bold=True)
    label = one.material if one.material == other.material else f"{one.material}, {other.material}"
    say(word, f"  {label}: {_sentence(found)}")
    for line in _details(found):
        say(f"  {line}")


def _tell_frame(found: FrameComparison) -> None:
    word = Styled(_WORDS[found.verdict], _COLORS[found.verdict], is_bold=True)
    say(word, f"  frame {found.name}: {'; '.join(frame_sentences(found))}")


def _sentence(found: Comparison) -> str:
    if found.means == "expression":
        return "proven, as both are the same expression"
    if found.means == "algebra":
        return "proven for all values, by algebra"
    if found.verdict == "same":
        return (
            f"proven for all values in the ranges: the difference is at most {found.bound:.2g} "
            f"({found.boxes} boxes)"
        )
    if found.witness is not None:
        witness = found.witness
        edge = ", but only where two compared numbers are equal" if witness.is_edge else ""
        return f"{witness.lane} is {witness.first:.6g} in A and {witness.second:.6g} in B{edge}"
    return (
        f"proven for {_percent(found.proven)} of the space; at none of {found.points} points do "
        "they differ by more than is allowed"
    )


def _percent(share: float) -> str:
    """A share that is rounded down: 100 % is said of all only."""
    return f"{math.floor(share * 1000) / 10:g} %"


def _details(found: Comparison) -> Iterator[str]:
    if (witness := found.witness) is not None:
        yield from _point(witness)
        if (source := witness.source) is not None:
            first, second = (
                ", ".join(f"{value:.6g}" for value in each)
                for each in (source.first, source.second)
            )
            yield f"first in `{source.name}`: {first} in A, {second} in B"
            for which, place in (("A", source.first_place), ("B", source.second_place)):
                if place is not None:
                    yield f"  {which}: {place}"
    if found.open is not None:
        sides = [
            f"{name} in {low:.6g}..{high:.6g}" for name, (low, high) in found.open.ranges.items()
        ]
        left = len(sides) - _MOST_SHOWN
        others = f", and {left} more" if left > 0 else ""
        if sides:
            yield f"open, among others: {', '.join(sides[:_MOST_SHOWN])}{others}"
        bound = found.open.bound
        known = f"at most {bound:.2g}" if math.isfinite(bound) else "not bounded"
        yield f"the difference there is {known}; --boxes and --range may show more"


def _point(witness: Witness) -> Iterator[str]:
    """The values for which both differ: all of few, or those that are not at their defaults."""
    is_short = len(witness.values) <= _MOST_SHOWN
    values = {
        name: value for name, value in witness.values.items() if is_short or name in witness.special
    }
    shown = [f"{name} = {value:.6g}" for name, value in values.items()]
    left = len(shown) - _MOST_SHOWN
    rest = f", and {left} more (--format json has all)" if left > 0 else ""
    if shown:
        yield f"where {', '.join(shown[:_MOST_SHOWN])}{rest}"
    if not is_short:
        yield f"{'and all else' if shown else 'where all'} is at its default, or near zero"
    if 0 < len(witness.read) <= _MOST_SHOWN:
        read = ", ".join(f"{name} = {value:.6g}" for name, value in witness.read.items())
        yield f"reads come to {read}"


def _row(one: _Side, other: _Side, found: Comparison) -> dict[str, Any]:
    """A comparison as data for JSON."""
    witness, opened = found.witness, found.open
    return {
        "a": {"file": str(one.path), "material": one.material},
        "b": {"file": str(other.path), "material": other.material},
        "verdict": found.verdict,
        "means": found.means,
        "proven": found.proven,
        "bound": _finite(found.bound),
        "boxes": found.boxes,
        "points": found.points,
        "notes": list(found.notes),
        "witness": None if witness is None else {
            "values": dict(witness.values),
            "special": list(witness.special),
            "read": {name: _finite(value) for name, value in witness.read.items()},
            "lane": witness.lane,
            "a": witness.first,
            "b": witness.second,
            "edge": witness.is_edge,
            "lanes": {name: list(map(_finite, both)) for name, both in witness.lanes.items()},
            "first_difference": None if witness.source is None else _source(witness.source),
        },
        "open": None if opened is None else {
            "ranges": _spans(opened.ranges), "bound": _finite(opened.bound),
        },
        "domain": _spans(found.domain),
    }  # fmt: skip


def _source(source: Any) -> dict[str, Any]:
    return {
        "name": source.name,
        "a": list(map(_finite, source.first)),
        "b": list(map(_finite, source.second)),
        "a_place": None if source.first_place is None else str(source.first_place),
        "b_place": None if source.second_place is None else str(source.second_place),
    }


def _spans(ranges: Mapping[str, tuple[float, float]]) -> dict[str, list[Any]]:
    return {name: list(map(_finite, ends)) for name, ends in ranges.items()}


def _finite(value: float) -> float | None:
    """A number for JSON, which has no infinity."""
    return value if math.isfinite(value) else None
