"""Noises, patterns, adjustments of colours and compositing: functions of ``std.mtlx``."""

from __future__ import annotations

from ..expressions import Call, Expression, Given, Member, Number, binary, call_with, called
from ..networks import Application, Row
from .application import SUFFIXES


def _noise(name: str, place: str, *others: str) -> Row:
    """Noise with an amplitude for each lane: one number stands for all of them."""

    def row(node: Application) -> Expression:
        suffix = SUFFIXES[node.type]
        given = [Given(place, node.input(place))]
        for other in ("amplitude", *others):
            value = node.input(other)
            if other == "amplitude" and suffix and node.input_type(other) == "float":
                value = Call(suffix[1:], (value,))
            given.append(Given(other, value, node.network.is_default(node.node, other)))
        return call_with(node.library(name + suffix), given)

    return row


def _blended(row: Row) -> Row:
    """A way of compositing with its mix: how much of the result there is above the background."""

    def mixed(node: Application) -> Expression:
        amount = node.input("mix")
        if amount == Number(1.0):
            return row(node)
        return Call("mix", (node.input("bg"), row(node), amount))

    return mixed


def _alpha(value: Expression) -> Expression:
    return Member(value, "a")


def _plus(node: Application) -> Expression:
    return binary("+", *node.inputs("bg", "fg"))


def _minus(node: Application) -> Expression:
    return binary("-", *node.inputs("bg", "fg"))


def _difference(node: Application) -> Expression:
    return called("abs", binary("-", *node.inputs("bg", "fg")))


def _screen(node: Application) -> Expression:
    foreground, background = node.inputs("fg", "bg")
    one = Number(1.0)
    return binary("-", one, binary("*", binary("-", one, foreground), binary("-", one, background)))


def _in(node: Application) -> Expression:
    foreground, background = node.inputs("fg", "bg")
    return binary("*", foreground, _alpha(background))


def _mask(node: Application) -> Expression:
    foreground, background = node.inputs("fg", "bg")
    return binary("*", background, _alpha(foreground))


def _out(node: Application) -> Expression:
    foreground, background = node.inputs("fg", "bg")
    return binary("*", foreground, binary("-", Number(1.0), _alpha(background)))


def _over(node: Application) -> Expression:
    foreground, background = node.inputs("fg", "bg")
    rest = binary("*", background, binary("-", Number(1.0), _alpha(foreground)))
    return binary("+", foreground, rest)


def _outside(node: Application) -> Expression:
    value, mask = node.inputs("in", "mask")
    return binary("*", value, binary("-", Number(1.0), mask))


ROWS: dict[str, Row] = {
    "noise2d": _noise("noise2d", "texcoord", "pivot"),
    "noise3d": _noise("noise3d", "position", "pivot"),
    "fractal2d": _noise("fractal2d", "texcoord", "octaves", "lacunarity", "diminish"),
    "fractal3d": _noise("fractal3d", "position", "octaves", "lacunarity", "diminish"),
    "plus": _blended(_plus),
    "minus": _blended(_minus),
    "difference": _blended(_difference),
    "screen": _blended(_screen),
    "in": _blended(_in),
    "mask": _blended(_mask),
    "out": _blended(_out),
    "over": _blended(_over),
    "inside": lambda node: binary("*", *node.inputs("in", "mask")),
    "outside": _outside,
}
