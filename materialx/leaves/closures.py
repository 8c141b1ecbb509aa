"""How closures are put together; what they are made of are functions of ``std.mtlx.closures``."""

from __future__ import annotations

from ..expressions import Call, Expression
from ..networks import Application, Row
from ..problems import UnsupportedError
from ..values import CLOSURES
from .application import Written
from .arithmetic import ROWS as ARITHMETIC


def _by_type(name: str, *inputs: str) -> Written:
    """A row for closures of light that is scattered; what is sent
    out adds up as other colours do."""
    other = ARITHMETIC[{"added": "add", "scaled": "multiply", "mixed": "mix"}[name]]

    def row(node: Application) -> Expression:
        if node.type != "BSDF":
            return other(node)
        return Call(node.library(name), node.inputs(*inputs))

    return Written(name, inputs, row)


def _layer(node: Application) -> Expression:
    name = "layer_on_volume" if node.input_type("base") == "VDF" else "layer"
    return Call(node.library(name), node.inputs("top", "base"))


def _volume(node: Application) -> Expression:
    if node.network.asked is None:
        raise UnsupportedError("a volume can only be part of a surface")
    return Call(node.library("absorbing_volume"), (node.network.asked, node.input("absorption")))


def _uniform(node: Application) -> Expression:
    return node.input("color")


ROWS: dict[str, Row] = {
    "layer": Written("layer", ("top", "base"), _layer),
    "anisotropic_vdf": _volume,
    "absorption_vdf": _volume,
    "uniform_edf": _uniform,
}
CLOSURE_ROWS: dict[str, Written] = {
    "mix": _by_type("mixed", "bg", "fg", "mix"),
    "add": _by_type("added", "in1", "in2"),
    "multiply": _by_type("scaled", "in1", "in2"),
}
"""Rows of categories that have others for values."""


def is_closure(kind: str) -> bool:
    """True for the types of MaterialX that say how light is scattered, sent out or absorbed."""
    return kind in CLOSURES
