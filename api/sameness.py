"""Compares two materials by their meaning: ``burnish.same``, which ``entry_points.py`` hands on."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path

from ..compiler.diagnostics.diagnostic import CompileError, Report
from ..compiler.diagnostics.nearest import suggestion
from ..compiler.equivalence.comparing import (
    EPSILON,
    Comparison,
    Settings,
    Witness,
    compare,
)
from ..compiler.equivalence.domain import Domain, is_of
from ..compiler.equivalence.programs import NotComparableError, TooLargeError
from ..compiler.frontend import Frontend
from ..compiler.ir.shader import Shader
from ..compiler.ir.types import Scalar, Vector
from ..compiler.passes.lower_stages import lower_stages
from ..support.garbage import seldom_collected
from .compiling import opened, sources

__all__ = ["Comparison", "Range", "SameError", "Value", "Witness", "names_of", "same"]

Value = float | Sequence[float]
Range = tuple[float, float]


class SameError(Exception):
    """Two materials cannot be compared; the text says why."""


@seldom_collected
def same(
    first: str | Path,
    second: str | Path,
    *,
    material: str | None = None,
    second_material: str | None = None,
    rig: str | None = None,
    pass_: str | None = None,
    search_path: Sequence[str | Path] = (),
    epsilon: float = EPSILON,
    boxes: int | None = None,
    values: Mapping[str, Value] | None = None,
    first_values: Mapping[str, Value] | None = None,
    second_values: Mapping[str, Value] | None = None,
    ranges: Mapping[str, Range] | None = None,
    seed: int = 1,
    tell: Callable[[float], None] = lambda _share: None,
) -> Comparison:
    """Prove that two materials mean the same, or find where they do not.

    ``first`` and ``second`` are paths or texts, as for ``compile``; ``material`` and
    ``second_material`` choose one of several. ``epsilon`` is how much numbers may differ: of the
    larger one, or of 1. Of ``boxes``, at most so many are looked at. ``values`` are set in both,
    ``first_values`` and ``second_values`` in one of them, and all else has any value in its range:
    the declared one, unless ``ranges`` has another. ``tell`` is called with the share of the space
    that is proven so far.

    Raises ``CompileError`` for errors in a file, and ``SameError`` if the two cannot be compared.
    """
    shaders = (
        _shader(first, material, rig, pass_, search_path),
        _shader(second, second_material or material, rig, pass_, search_path),
    )
    common, spread = dict(values or {}), dict(ranges or {})
    settings = [{**common, **dict(own or {})} for own in (first_values, second_values)]
    _check(shaders, (common, spread), (first_values or {}, second_values or {}))
    ours, theirs = (Domain(spread, _lanes(each, shaders)) for each in settings)
    if not 0.0 < epsilon < math.inf:
        raise SameError(f"the allowed difference is {epsilon}, and has to be more than 0")
    asked = Settings(epsilon, boxes, seed, ours, theirs, tell)
    try:
        return compare(*shaders, asked)
    except NotComparableError as error:
        raise SameError(str(error)) from error
    except TooLargeError as error:
        raise SameError(
            f"{error} is too large to be compared: written out, with the turns of its loops, it "
            "has too many operations"
        ) from error


def names_of(source: str | Path, search_path: Sequence[str | Path] = ()) -> tuple[str, ...]:
    """The materials of a file that can be compared; of a file without any, its kernels.

    Raises ``CompileError``.
    """
    report = Report()
    given, folders = sources(source, search_path)
    frontend = Frontend(report, folders)
    module = opened(given, frontend)
    if module is None or report.failed:
        raise CompileError(report.diagnostics)
    return frontend.declared(module, "material") or frontend.declared(module, "kernel")


def _shader(
    source: str | Path,
    material: str | None,
    rig: str | None,
    pass_: str | None,
    search_path: Sequence[str | Path],
) -> Shader:
    """The shader of a material. Raises ``CompileError`` and ``SameError``."""
    given, folders = sources(source, search_path)
    report = Report()
    frontend = Frontend(report, folders)
    module = opened(given, frontend)
    shaders = [] if module is None else frontend.shaders(module, material, rig, pass_)
    if report.failed:
        raise CompileError(report.diagnostics)
    if len(shaders) != 1:
        names = ", ".join(shader.name for shader in shaders)
        where = source if isinstance(source, Path) else "the text"
        raise SameError(
            f"{where} has {len(shaders)} materials, {names}: choose one"
            if shaders
            else f"{where} has no material or kernel that could be compared"
        )
    return lower_stages(shaders[0])


# --- what is set ---------------------------------------------------------------------------------


def _check(
    shaders: Sequence[Shader],
    common: tuple[Mapping[str, Value], Mapping[str, Range]],
    own: tuple[Mapping[str, Value], Mapping[str, Value]],
) -> None:
    """Raise ``SameError`` for names that no program has, and for ranges that are none."""
    known = [list(_names(shader)) for shader in shaders]
    for values, names in ((common[0], [*known[0], *known[1]]), (common[1], [*known[0], *known[1]]),
                          (own[0], known[0]), (own[1], known[1])):  # fmt: skip
        for name in values:
            if not any(is_of(name, each) for each in names):
                hint = suggestion(name, names) or "`burnish docs same` says what can be set"
                raise SameError(f"there is no parameter or input `{name}`: {hint}")
    for name, (low, high) in common[1].items():
        if not -math.inf < low <= high < math.inf:
            raise SameError(f"`{name}`: {low:g}..{high:g} is no range")


def _names(shader: Shader) -> Iterable[str]:
    """The names of all that can be set: parameters, textures, buffers and inputs."""
    yield from (info.leaf.name for info in shader.leaves)
    for stage in shader.chain:
        yield from (supplied.name for supplied in stage.inputs)


def _lanes(
    values: Mapping[str, Value], shaders: Sequence[Shader]
) -> Mapping[str, tuple[float, ...]]:
    """Each value as its lanes. Raises ``SameError`` if a parameter has not so many."""
    types = {info.leaf.name: info.leaf.type for each in shaders for info in each.leaves}
    found = {}
    for name, value in values.items():
        lanes = (float(value),) if isinstance(value, float | int) else tuple(map(float, value))
        type_ = types.get(name)
        size = type_.size if isinstance(type_, Vector) else 1
        if isinstance(type_, Scalar | Vector) and len(lanes) not in (1, size):
            raise SameError(f"`{name}` has {size} numbers, and not {len(lanes)}")
        if not lanes or not all(map(math.isfinite, lanes)):
            raise SameError(f"`{name}` needs finite numbers")
        found[name] = lanes
    return found
