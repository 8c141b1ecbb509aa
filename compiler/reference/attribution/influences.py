"""Measures the effect of a small error of each operation on a pixel, for ``explanation.py``.

The shader is evaluated with one way for each lane of each operation. In its own way a lane is a
little larger, and everything that follows from it shows by how much this changes the picture. The
differences between the ways also add up to the error of every value on the way.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...ir.node import Node
from ...ir.operations import BUILTIN_OPS
from ...ir.types import scalar_kind
from ..namespace import Lane, Lanes
from ..operations import apply
from ..picture.scene import Floats
from .jumps import Jump, by_lane, coordinates, jump_at, rule_of
from .local_errors import LocalErrors, flat
from .pixel import AttributionReader, Occurrence, PixelShader

AT_ONCE = 256
"""The number of ways evaluated at once: few, so that their values stay in the CPU's cache."""
MOST_WAYS = 4096
"""The limit of lanes; with more, all evaluations of one node share their ways."""
PROBE = 2.0**-24
"""The least error that is tried, relative to a value: one rounding to float32."""
SMALLEST = 2.0**-10
"""Smaller values are tried with the error of a value of this size."""
_TINY_CHANGE = 2.0**-30
"""A relative change that is small enough for slopes."""

Tried = tuple[Occurrence, int]
"""A lane of one evaluation of a node."""


@dataclass(eq=False, slots=True)
class Site:
    """The measurements of one evaluation of one node."""

    where: Occurrence
    node: Node
    value: list[float]
    """The exact lanes in the pixel; in the vertex stage, each at the corner where it is largest."""
    local: list[float]
    """The error of each lane that the operation itself makes."""
    probe: list[float]
    """The error that is tried for each lane."""
    given: list[Lanes]
    """The exact operands."""
    operands: list[tuple[float, float]]
    """The value and the error of each lane of the operands that are floats."""
    jumps: list[Jump]
    error: list[float]
    """The error of each lane: its own, and those of everything before it."""
    effect: Floats
    """(lanes, lanes of the picture): by how much the error that was tried changes the picture."""

    @property
    def reads(self) -> bool:
        """True if it reads a texture."""
        return bool(self.given) and isinstance(self.given[0][0], AttributionReader)

    @property
    def contribution(self) -> Floats:
        """The picture's error because of the operation's own rounding: (lanes of the picture,)."""
        return self._scaled(self.local)

    @property
    def passing(self) -> Floats:
        """(lanes of the picture,): the picture's error because of the error of this value."""
        return self._scaled(self.error)

    def part(self, lane: int) -> float:
        """The fraction of the tried error of a lane that is really made."""
        return self.local[lane] / self.probe[lane] if self.probe[lane] > 0 else 0.0

    def rates(self, lane: int) -> Floats:
        """(lanes of the picture,): how fast the picture changes with a lane."""
        found: Floats = self.effect[lane] / (self.probe[lane] or np.inf)
        return found

    def _scaled(self, errors: Sequence[float]) -> Floats:
        parts = [error * self.rates(lane) for lane, error in enumerate(errors)]
        return np.asarray(sum(parts, np.zeros(self.effect.shape[1])))


Disturb = Callable[[Site, int, Lane, int], Lane]
"""Changes one lane of a value in one way."""
Seen = Callable[[Site, list[Lanes], Lanes], None]
"""Called with the operands and the value of everything that is evaluated."""


@dataclass(frozen=True, eq=False, slots=True)
class Influences:
    """The measurements at one pixel."""

    picture: Floats
    """(lanes,): the exact lanes of all render targets, one target after the other."""
    sites: tuple[Site, ...]
    """Operations, constants and interpolated values, in the order of evaluation."""


def influences(pixel: PixelShader, errors: LocalErrors) -> Influences:
    """Evaluate the pixel as often as it takes to try an error in every lane."""
    return _Measuring(pixel, errors).measured()


class _Measuring:
    def __init__(self, pixel: PixelShader, errors: LocalErrors) -> None:
        self._pixel = pixel
        self._errors = errors
        self._sites: dict[Occurrence, Site] = {}

    def measured(self) -> Influences:
        exact = self._pixel.evaluated(1, self._enlisted).lanes
        for site in self._sites.values():
            site.effect = np.zeros((len(site.value), exact.shape[1]))
        for group in _portions(self._ways()):
            self._try(group)
        for jumps in _portions(self._tipping()):
            self._tip(jumps)
        return Influences(exact[0], tuple(self._sites.values()))

    # --- the first evaluation ---------------------------------------------------------------------

    def _enlisted(
        self, where: Occurrence, node: Node, operands: list[Lanes], value: Lanes
    ) -> Lanes:
        """Notes values that can have an error of their own, or jump."""
        errors = self._errors.of(node, operands, value)
        shown = (map(self._shown, pair) for pair in zip(errors, flat(value), strict=True))
        # The error of an infinite value says nothing.
        local = [error if math.isfinite(error + lane) else 0.0 for error, lane in shown]
        rule = rule_of(node)
        rounds = _rounds(node) if node.op != "constant" else any(local)
        if rounds or rule is not None:
            values = [self._shown(lane) for lane in flat(value)]
            probe = [
                max(own, PROBE * max(abs(shown), SMALLEST))
                if rounds and math.isfinite(shown)
                else 0.0
                for own, shown in zip(local, values, strict=True)
            ]
            self._sites[where] = Site(
                where, node, values, local, probe,
                given=operands,
                operands=[(self._shown(lane), 0.0) for lane in _floats(operands)],
                jumps=[] if rule is None else [
                    jump_at(rule, lane, self._shown(coordinate))
                    for lane, coordinate in enumerate(coordinates(rule, operands))
                ],
                error=[0.0] * len(values),
                effect=np.zeros((0, 0)),
            )  # fmt: skip
        return value

    def _shown(self, lane: Lane) -> float:
        """The exact value of a lane in the pixel."""
        return float(self._pixel.seen(lane)[0])

    # --- one error after the other ----------------------------------------------------------------

    def _ways(self) -> list[list[Tried]]:
        """The errors tried in each way: of a lane of one evaluation, or of all those of a node."""
        tried = [
            (site.where, lane)
            for site in self._sites.values()
            for lane, probe in enumerate(site.probe)
            if probe > 0
        ]
        if len(tried) <= MOST_WAYS:
            return [[one] for one in tried]
        groups: dict[tuple[str, int, int], list[Tried]] = {}
        for where, lane in tried:
            groups.setdefault((where.domain, where.node, lane), []).append((where, lane))
        return list(groups.values())

    def _try(self, ways: list[list[Tried]]) -> None:
        """Evaluates with these errors, each in its way, and adds their effects to all values."""

        def off(site: Site, lane: int, value: Lane, way: int) -> Lane:
            shape, signs = self._pixel.quad(site.where)
            if max(np.shape(value)[1:], default=1) == 1:
                # A value that is the same everywhere is rounded in the same way everywhere.
                shape, signs = (1,) * len(shape), np.ones(())
            change = np.zeros((len(ways) + 1, *shape))
            change[way] = site.probe[lane] * signs
            return value + change

        parts = np.array([self._sites[where].part(lane) for ((where, lane), *_) in ways])

        def add(site: Site, operands: list[Lanes], value: Lanes) -> None:
            self._add(site, operands, value, parts)

        changes = self._changes(ways, off, add)
        # Jumps are tried by themselves, and an infinite value has no slope.
        changes = np.where(np.isfinite(changes), changes, 0.0)
        for lanes, change in zip(ways, changes, strict=True):
            for where, lane in lanes:
                self._sites[where].effect[lane] = change / len(lanes)

    def _changes(self, ways: list[list[Tried]], disturb: Disturb, seen: Seen) -> Floats:
        """The change of the picture by each way: (ways, lanes of the picture).

        It is infinite where the pixel is discarded.
        """
        places: dict[Occurrence, list[tuple[int, int]]] = {}
        for way, lanes in enumerate(ways, start=1):
            for where, lane in lanes:
                places.setdefault(where, []).append((lane, way))

        def change(where: Occurrence, _: Node, operands: list[Lanes], value: Lanes) -> Lanes:
            site = self._sites.get(where)
            if site is None:
                return value
            if where in places:
                lanes = list(flat(value))
                for lane, way in places[where]:
                    lanes[lane] = disturb(site, lane, lanes[lane], way)
                value = _rebuilt(value, iter(lanes))
            seen(site, operands, value)
            return value

        outcome = self._pixel.evaluated(len(ways) + 1, change)
        changes = np.abs(outcome.lanes[1:] - outcome.lanes[0])
        changes[outcome.discarded[1:]] = np.inf
        return np.where(np.isnan(changes), 0.0, changes)

    def _add(self, site: Site, operands: list[Lanes], value: Lanes, parts: Floats) -> None:
        """Add the errors of these ways to those of a value and of its operands.

        ``parts`` is how much of the error that a way tries is really made.
        """

        def error(lane: Lane) -> float:
            if np.ndim(lane) == 0 or len(lane) == 1 or lane.dtype.kind != "f":
                return 0.0
            seen = self._pixel.seen(lane)
            changes = np.abs(seen[1:] - seen[0])
            return float(np.where(np.isfinite(changes), changes, 0.0) @ parts)

        for number, lane in enumerate(flat(value)):
            site.error[number] += error(lane)
        for number, lane in enumerate(_floats(operands)):
            shown, before = site.operands[number]
            site.operands[number] = shown, before + error(lane)
        if site.jumps and (rule := rule_of(site.node)) is not None:
            for jump, lane in zip(site.jumps, coordinates(rule, operands), strict=True):
                jump.error += error(lane)

    # --- jumps ------------------------------------------------------------------------------------

    def _tipping(self) -> list[list[Tried]]:
        """The jumps that rounding may tip, each in a way of its own."""
        return [
            [(site.where, jump.lane)]
            for site in self._sites.values()
            for jump in site.jumps
            if jump.may_tip
        ][:MOST_WAYS]

    def _tip(self, ways: list[list[Tried]]) -> None:
        """Evaluate with each of these jumps on its other side."""

        def other(site: Site, lane: int, value: Lane, way: int) -> Lane:
            rule = rule_of(site.node)
            assert rule is not None
            operands = by_lane(site.given)[lane]
            shape, _ = self._pixel.quad(site.where)
            whole = np.broadcast_to(value, (len(ways) + 1, *shape)).copy()
            beyond = rule.beyond(value, site.jumps[lane].side, operands)
            whole[way] = np.broadcast_to(beyond, whole.shape)[way]
            return whole

        changes = self._changes(ways, other, lambda _site, _operands, _value: None)
        for ((where, lane),), change in zip(ways, changes, strict=True):
            self._sites[where].jumps[lane].effect = change


def _portions(ways: list[list[Tried]]) -> Iterator[list[list[Tried]]]:
    for begin in range(0, len(ways), AT_ONCE):
        yield ways[begin : begin + AT_ONCE]


def _rounds(node: Node) -> bool:
    """True if a value can have an error of its own."""
    if scalar_kind(node.type) != "float":
        return False
    return node.op in BUILTIN_OPS or node.op in ("constant", "cross", "input")


def _floats(operands: list[Lanes]) -> Iterator[Lane]:
    """The lanes of operands that are floats."""
    return filter(_is_float, flat(tuple(operands)))


def _is_float(lane: Lane) -> bool:
    return isinstance(lane, float) or (isinstance(lane, np.ndarray) and lane.dtype.kind == "f")


def _rebuilt(value: Any, lanes: Iterator[Lane]) -> Any:
    """A value with other lanes, in the order of ``flat``."""
    return tuple(
        _rebuilt(part, lanes) if isinstance(part, tuple) else next(lanes) for part in value
    )


def slopes(site: Site, pixel: PixelShader) -> Iterator[tuple[float, list[float]]]:
    """Yields the steepness of an operation in each lane of its operands.

    Only lanes that are floats and not zero count. Each comes as its value, and by how much each
    lane of the result changes for a tiny relative change in it, divided by that change.
    """
    lanes = list(flat(tuple(site.given)))
    for number, lane in enumerate(lanes):
        shown = float(pixel.seen(lane)[0]) if _is_float(lane) else 0.0
        if shown == 0.0:
            continue
        moved = [*lanes[:number], lane + shown * _TINY_CHANGE, *lanes[number + 1 :]]
        there = flat(apply(site.node, list(_rebuilt(tuple(site.given), iter(moved))), np))
        changes = [
            abs(float(pixel.seen(moved_lane)[0]) - value) / _TINY_CHANGE
            for moved_lane, value in zip(there, site.value, strict=True)
        ]
        yield shown, changes
