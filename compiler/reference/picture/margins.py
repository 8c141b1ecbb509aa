"""Finds pixels whose value depends on a decision that rounding to float32 may change.

While a stage is evaluated, ``Margins`` watches every operation. Comparisons, roundings and similar
operations jump. A pixel close to a jump is undecided, unless the operand is steady: a uniform, or a
value at the end of its range, such as the zero of ``max(dot(n, l), 0)`` on the whole dark side.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import reduce
from typing import Any

import numpy as np

from ....stdlib.builtins import texture
from ....stdlib.builtins.facts import SMALLEST_NORMAL
from ...ir.node import Node
from ...ir.operations import builtin_of
from ...ir.types import scalar_kind
from ..namespace import Lane, Lanes
from ..vectors import inner
from .scene import Bools

ABSOLUTE_MARGIN = 1e-5
RELATIVE_MARGIN = 1e-5
"""Closer than this to a jump, absolutely and relative to the operands, is too close."""

Jump = tuple[Lane, Lane]
"""A function that jumps at zero or at whole numbers, and the error that float32 may have."""


def margin(*lanes: Lane) -> Lane:
    """The error that lanes may have in float32."""
    largest: Lane = 0.0
    for lane in lanes:
        largest = np.maximum(largest, np.abs(lane))
    return ABSOLUTE_MARGIN + RELATIVE_MARGIN * largest


def _difference(x: Lane, y: Lane) -> Jump:
    return x - y, margin(x, y)


def _itself(x: Lane) -> Jump:
    return x, margin(x)


def _middle(x: Lane) -> Jump:
    return x + 0.5, margin(x)


def _towards_zero(x: Lane) -> Jump:
    """Truncation does not jump at zero."""
    return np.maximum(np.abs(x), 0.5), margin(x)


def _quotient(x: Lane, y: Lane) -> Jump:
    """Modulo zero is zero, whatever the dividend is."""
    none = np.abs(y) < SMALLEST_NORMAL
    divisor = np.where(none, 1.0, y)
    return np.where(none, 0.5, x / divisor), np.where(none, 0.0, margin(x) / np.abs(divisor))


def _narrow_step(low: Lane, high: Lane, x: Lane) -> Jump:
    """A smooth step of width zero jumps."""
    narrow = np.abs(high - low) <= margin(low, high)
    return np.where(narrow, x - low, np.inf), margin(x, low)


def _behind(y: Lane, x: Lane) -> Jump:
    """The angle jumps along the negative axis."""
    return np.where(x < margin(x), y, np.inf), margin(y)


def _total_reflection(incident: Lanes, normal: Lanes, ratio: Lanes) -> Jump:
    (eta,), cosine = ratio, inner(normal, incident)
    return 1.0 - eta * eta * (1.0 - cosine * cosine), margin(1.0, eta * eta)


def _facing(_normal: Lanes, incident: Lanes, reference: Lanes) -> Jump:
    return inner(reference, incident), margin(1.0)


def _lit_side(diffuse: Lanes, specular: Lanes, _power: Lanes) -> Jump:
    """The highlight jumps to zero where the light disappears below the horizon."""
    (nl,), (nh,) = diffuse, specular
    return np.where(nh < 0, np.inf, nl), margin(nl)


def _everywhere(x: Lane) -> Jump:
    """Any rounding changes the last bit of a float, so it jumps everywhere."""
    return np.zeros_like(x), margin(x)


def _at_power_of_two(x: Lane) -> Jump:
    magnitude = np.maximum(np.abs(x), SMALLEST_NORMAL)
    return np.log2(magnitude), margin(x) / magnitude * _LOG2_E


def _between_halves(x: Lane) -> Jump:
    """A jump in the middle between two floats of 16 bits, which differ by at least 2^-24."""
    _, exponent = np.frexp(x)
    step = np.ldexp(1.0, np.maximum(exponent - _HALF_BITS, _LEAST_HALF_EXPONENT))
    return x / step + 0.5, margin(x) / step


def _between_parts(largest: int, least: float) -> Callable[[Lane], Jump]:
    """A jump in the middle between two numbers that a packed lane can hold."""

    def jump(x: Lane) -> Jump:
        return np.clip(x, least, 1.0) * largest + 0.5, margin(x) * largest

    return jump


_LOG2_E = 1.4426950408889634
_HALF_BITS, _LEAST_HALF_EXPONENT = 11, -24

_AT_ZERO: Mapping[str, Callable[..., Jump]] = {
    **dict.fromkeys(("lt", "le", "gt", "ge", "eq", "ne", "step"), _difference),
    "sign": _itself,
    "smoothstep": _narrow_step,
    "atan2": _behind,
    "bits_of": _everywhere,
}
_AT_WHOLE: Mapping[str, Callable[..., Jump]] = {
    **dict.fromkeys(("floor", "ceil", "fract"), _itself),
    **dict.fromkeys(("trunc", "to_int", "to_uint"), _towards_zero),
    "round": _middle,
    "mod": _quotient,
    **dict.fromkeys(("exponent", "mantissa"), _at_power_of_two),
    "quantize_half": _between_halves,
}
"""Builtins on floats that jump, lane by lane."""

EXACT = frozenset(
    {"lt", "le", "gt", "ge", "eq", "ne", "step", "sign", "floor", "ceil", "trunc", "round",
     "to_int", "to_uint", "bits_of", "exponent", "quantize_half"}
)  # fmt: skip
"""Builtins whose result does not change between two jumps."""
_EVERYWHERE: Bools = np.ones((), dtype=np.bool_)

_OF_VECTORS: Mapping[str, Callable[..., Jump]] = {
    "refract": _total_reflection,
    "faceforward": _facing,
    "lit": _lit_side,
}
"""Builtins on whole vectors that jump at zero."""

READS = frozenset(row.name for row in texture.ROWS)
"""Builtins that read textures, which compute margins of their own."""

_PACKING: Mapping[str, Callable[[Lane], Jump]] = {
    "pack_unorm4x8": _between_parts(255, 0.0),
    "pack_snorm4x8": _between_parts(127, -1.0),
    "pack_unorm2x16": _between_parts(65535, 0.0),
    "pack_snorm2x16": _between_parts(32767, -1.0),
    "pack_half2x16": _between_halves,
}
"""Builtins that round each lane of a vector, and pack them into one integer."""

_NOT_BY_LANE = READS | frozenset(
    {"any", "all", "dot", "cross", "length", "distance", "normalize", "nonzero", "reflect",
     "transpose", "determinant", "inverse", "outer", "hadamard", "unpack_unorm4x8",
     "unpack_unorm2x16", "unpack_snorm4x8", "unpack_snorm2x16", "unpack_half2x16", *_PACKING,
     *_OF_VECTORS}
)  # fmt: skip


class Margins:
    """Watches an evaluation on arrays of one shape, and marks undecided pixels.

    A leading axis of the operands is that of variants: if they decide differently, the pixel is
    undecided.
    """

    def __init__(self, shape: tuple[int, ...]) -> None:
        self.undecided: Bools = np.zeros(shape, dtype=np.bool_)
        self._steady: dict[int, tuple[Lane, Bools]] = {}
        """By the identity of the lane, which is kept alive for this; swizzles and others pass lanes
        on."""

    def watch(self, node: Node, operands: list[Lanes], value: Lanes) -> None:
        """Examine one operation that has been computed."""
        if node.op == "select":
            self._learn_choice(operands, value)
        elif (builtin := builtin_of(node)) is not None:
            self._called(builtin, node, operands, value)

    def spread(self) -> None:
        """Make all pixels of a quad undecided if one of them is.

        All four pixels are operands of a quad's derivatives, and so are their decisions.
        """
        self.undecided |= self.undecided.any(axis=(-2, -1), keepdims=True)

    def at_zero(self, value: Lane, allowed: Lane, steady: Bools | bool = False) -> None:
        """Record that something jumps where ``value`` is zero."""
        if np.ndim(value):
            self._mark(~(np.abs(value) > allowed), value < 0, steady)

    def at_whole(self, value: Lane, allowed: Lane, steady: Bools | bool = False) -> None:
        """Record that something jumps where ``value`` is a whole number."""
        if np.ndim(value):
            close = ~(np.abs(value - np.rint(value)) > allowed)
            self._mark(close, np.floor(value), steady)

    def hand_on(self, lane: Lane, new: Lane) -> None:
        """Record that ``new``, which replaces ``lane``, is as steady."""
        if id(lane) in self._steady:
            self._learn(new, self._steady[id(lane)][1])

    def _mark(self, close: Bools, side: Lane, steady: Bools | bool) -> None:
        if np.ndim(side) > self.undecided.ndim and len(side) > 1:
            close = close | (side != side[:1])
        close = np.asarray(close & ~np.asarray(steady))
        if close.ndim > self.undecided.ndim:
            close = np.asarray(close.any(axis=0))
        self.undecided |= close

    def _called(self, name: str, node: Node, operands: list[Lanes], value: Lanes) -> None:
        if name in _OF_VECTORS:
            self.at_zero(*_OF_VECTORS[name](*operands), self._all_steady(operands))
        if name in _PACKING:
            self._packed(_PACKING[name], operands[0], value)
        if name in _NOT_BY_LANE or any(isinstance(lanes[0], tuple) for lanes in (value, *operands)):
            return
        wide = [lanes * len(value) if len(lanes) == 1 else lanes for lanes in operands]
        jumps = scalar_kind(node.operands[0].type) == "float"
        for lane, *given in zip(value, *wide, strict=True):
            if np.ndim(lane):
                steady = self._steadiness(name, given)
                if jumps and name in _AT_ZERO:
                    self.at_zero(*_AT_ZERO[name](*given), steady)
                elif jumps and name in _AT_WHOLE:
                    self.at_whole(*_AT_WHOLE[name](*given), steady)
                self._learn(lane, _EVERYWHERE if name in EXACT and jumps else steady)

    def _packed(self, jump: Callable[[Lane], Jump], lanes: Lanes, value: Lanes) -> None:
        """Record that a packed value does not change between two jumps of its lanes."""
        for lane in lanes:
            if np.ndim(lane):
                self.at_whole(*jump(lane), self._is_steady(lane))
        self._learn(value[0], _EVERYWHERE)

    # --- what is steady ---------------------------------------------------------------------------

    def _learn(self, lane: Lane, steady: Bools | bool) -> None:
        if not isinstance(steady, bool):
            self._steady[id(lane)] = (lane, steady)

    def _is_steady(self, lane: Lane) -> Bools | bool:
        if not np.ndim(lane):
            return True
        known = self._steady.get(id(lane))
        return False if known is None else known[1]

    def _all_steady(self, operands: list[Lanes]) -> Bools | bool:
        known = [self._is_steady(lane) for lanes in operands for lane in lanes]
        if any(mask is False for mask in known):
            return False
        return np.asarray(reduce(np.logical_and, known))

    def _learn_choice(self, operands: list[Lanes], value: Lanes) -> None:
        (condition,), then, otherwise = operands
        if not np.ndim(condition) or isinstance(value[0], tuple):
            return
        for lane, a, b in zip(value, then, otherwise, strict=True):
            sides = self._is_steady(a), self._is_steady(b)
            if not all(side is False for side in sides):
                self._learn(lane, np.where(condition, *sides))

    def _steadiness(self, name: str, given: list[Any]) -> Bools | bool:
        """Where an operation's value does not change if its operands change a little."""
        known = [self._is_steady(lane) for lane in given]
        rule = _PINNED.get(name)
        pinned = rule(given, known) if rule is not None else False
        if any(mask is False for mask in known):
            return pinned
        return np.asarray(pinned | reduce(np.logical_and, known))


def _at_end(given: list[Any], known: list[Any], low: int | None, high: int | None) -> Any:
    """Where the first operand is beyond another one, which replaces it."""
    x = given[0]
    pinned: Any = False
    if low is not None and known[low] is not False:
        pinned = pinned | ((x < given[low] - margin(given[low])) & known[low])
    if high is not None and known[high] is not False:
        pinned = pinned | ((x > given[high] + margin(given[high])) & known[high])
    return pinned


def _larger(given: list[Any], known: list[Any]) -> Any:
    return _at_end(given, known, 1, None) | _at_end(given[::-1], known[::-1], 1, None)


def _smaller(given: list[Any], known: list[Any]) -> Any:
    return _at_end(given, known, None, 1) | _at_end(given[::-1], known[::-1], None, 1)


def _clamped(given: list[Any], known: list[Any]) -> Any:
    return _at_end(given, known, 1, 2)


def _saturated(given: list[Any], known: list[Any]) -> Any:
    return _at_end([given[0], 0.0, 1.0], [known[0], True, True], 1, 2)


def _times_zero(given: list[Any], known: list[Any]) -> Any:
    pinned: Any = False
    for lane, steady in zip(given, known, strict=True):
        if np.ndim(lane) and steady is not False:
            pinned = pinned | ((lane == 0) & steady)
    return pinned


_PINNED: Mapping[str, Callable[[list[Any], list[Any]], Any]] = {
    "max": _larger,
    "min": _smaller,
    "clamp": _clamped,
    "saturate": _saturated,
    "mul": _times_zero,
}
"""Where an operation is steady although its operands are not."""
