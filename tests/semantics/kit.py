"""Helpers for the tests of semantics: the shader of a text, and its values on a triangle."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

from burnish.compiler.diagnostics.diagnostic import CompileError, Report
from burnish.compiler.frontend import Frontend
from burnish.compiler.ir.leaves import Attribute, Parameter, Texture
from burnish.compiler.ir.node import Node
from burnish.compiler.ir.operations import CROSS
from burnish.compiler.ir.shader import Shader
from burnish.compiler.ir.stages import TARGET
from burnish.compiler.ir.types import Struct
from burnish.compiler.reference.evaluate import LeafValues, evaluate
from burnish.compiler.reference.namespace import Lanes

Given = Mapping[str, Lanes]
"""Values of leaves by name: lanes, columns, elements. Other parameters have their default."""

MESH: dict[str, Lanes] = {
    "vertex_position": (0.5, 0.25, 0.0),
    "vertex_normal": (0.0, 0.0, 2.0),
    "vertex_uv": (0.25, 0.75),
}


@dataclass(frozen=True)
class Painted:
    """A texture whose filtered reads are a function of the coordinate."""

    color: Callable[[float, float], Lanes]

    def read(self, name: str, operands: tuple[Lanes, ...]) -> Lanes:
        """The value of a read."""
        assert name.startswith("sample"), name
        return self.color(*operands[0])


LEAVES = ("parameter", "texture", "attribute", "input")


def shader(source: str | Path, rig: str | None = None, pass_: str | None = None) -> Shader:
    """The only shader of a text or a file, as semantics makes it."""
    report = Report()
    frontend = Frontend(report)
    module = (
        frontend.open_file(source)
        if isinstance(source, Path)
        else frontend.open_text(source, "<test>")
    )
    assert module is not None
    found = frontend.shaders(module, None, rig, pass_)
    if report.failed:
        raise CompileError(report.diagnostics)
    (only,) = found
    return only


def leaves(whole: Shader, given: Given) -> LeafValues:
    """The values of leaves: those ``given``, or their defaults, or those of ``MESH``."""
    defaults = {info.leaf.name: info.default for info in whole.parameters}
    known: Mapping[str, Any] = {**defaults, **MESH, **given}

    def found(node: Node) -> Lanes | None:
        leaf = node.data
        name = leaf.name if isinstance(leaf, Parameter | Attribute | Texture) else str(leaf)
        default = known.get(name) if node.op in LEAVES else None
        if isinstance(leaf, Parameter) and isinstance(leaf.type, Struct):
            members = cast(Sequence[Any], default)
            return tuple(each if isinstance(each, tuple) else (each,) for each in members)
        return default if default is None or isinstance(default, tuple) else (default,)

    return found


def at(whole: Shader, root: Node, given: Given | None = None) -> Lanes:
    """The value of a root if all vertices of the mesh are the same point."""
    return evaluate(root, leaves(whole, given or {}))


def amid(whole: Shader, root: Node, corners: Sequence[Given]) -> Lanes:
    """The value of a root in the middle of a triangle."""
    plain = leaves(whole, corners[0])

    def crossing(node: Node) -> Lanes | None:
        if node.op != "cross":
            return plain(node)
        values = [at(whole, node.operands[0], corner) for corner in corners]
        lanes = zip(*values, strict=True)
        return (
            values[0]
            if CROSS.data(node).mode == "flat"
            else tuple(sum(ls) / len(values) for ls in lanes)
        )

    return evaluate(root, crossing)


def color(
    source: str | Path,
    given: Given | None = None,
    rig: str | None = None,
    pass_: str | None = None,
) -> Lanes:
    """The colour of the only material of a text."""
    whole = shader(source, rig, pass_)
    return at(whole, whole.results_of(TARGET)[0].value, given)[:3]


def lanes(expression: str, members: str = "", head: str = "", /, **given: Lanes) -> Lanes:
    """The three lanes of an expression of type ``vec3`` in a material."""
    return color(f"{head}\nmaterial M {{\n{members}\ncolor = {expression}\n}}", given)


def number(expression: str, members: str = "", head: str = "", /, **given: Lanes) -> float:
    """The number, or the ``bool`` as 1 or 0, of an expression in a material."""
    value = lanes(f"vec3(float({expression}))", members, head, **given)[0]
    assert isinstance(value, float)
    return value
