"""Random render states of passes, and random frames that draw with the pass of a program."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import get_args

from burnish.compiler.ir.render_state import StencilOperation

from .expressions import FUEL, Writer
from .scope import Scope, variable
from .tree import Node, listed, walk

COMPARISONS = ("less", "less_equal", "greater", "always")
OPERATIONS = get_args(StencilOperation)
_RASTER = {
    "cull": ("none", "front", "back"), "front": ("clockwise", "counter_clockwise"),
    "invariant": ("true", "false"),
}  # fmt: skip
_DEPTH = {
    "compare": COMPARISONS, "write": ("true", "false"), "bias": ("-3", "0", "1000"),
    "slope_bias": ("-0.5", "2"), "bias_clamp": ("0.001", "-0.1"),
}  # fmt: skip
_STENCIL = {
    "compare": COMPARISONS, "reference": ("0", "1", "255"), "read_mask": ("1", "255"),
    "write_mask": ("0", "3", "255"), "fail": OPERATIONS, "depth_fail": OPERATIONS,
    "front.pass": OPERATIONS, "back.pass": OPERATIONS, "back.compare": ("not_equal", "never"),
}  # fmt: skip
_SEVERAL = {"samples": ("4",)}
_COVERED = {"samples": ("4", "4, alpha_to_coverage = true")}
_ALPHA = re.compile(r"\b(rgba8|rgba8_srgb|bgra8|bgra8_srgb|rgb10a2|rgba16f)\b")
_FLOATS = re.compile(r"\b(r|rg|rgba)32f\b")
"""The formats of which samples have no mean."""
_NUMBERS = Scope((variable("amount", "float"), variable("float(many)", "float")))
"""The variables of which a frame computes numbers."""


def render_states(writer: Writer, program: Sequence[Node], *, is_deep: bool) -> list[Node]:
    """The faces that a program's pass draws, and its settings for depths and stencil values.

    ``program`` is all that has a part in what the pass draws. One that ``is_deep`` has no targets:
    its depths are looked at, so they are written, and there is one for each pixel.
    """
    found = []
    several = _COVERED if _has_alpha(program) else _SEVERAL
    raster = {**_RASTER, **several} if _may_have_samples(program) and not is_deep else _RASTER
    depth = {name: said for name, said in _DEPTH.items() if not (is_deep and name == "write")}
    for kind, settings in (("raster", raster), ("depth", depth), ("stencil", _STENCIL)):
        if writer.maybe(0.2):
            chosen = [name for name in settings if writer.maybe(0.5)]
            said = ", ".join(f"{name} = {writer.chance.choice(settings[name])}" for name in chosen)
            found.append(f"{kind} {{{{ {said} }}}}")
    return [Node(text, optional=True) for text in found]


def _may_have_samples(program: Sequence[Node]) -> bool:
    """True if a pass may have several samples: without lines, layers, views and large floats."""
    return not any(
        (node.role == "strips" and node.form.startswith("line "))
        or (node.role == "tessellation" and node.form.startswith("tessellate isoline"))
        or node.role in ("layers", "views")
        or (node.role == "target" and _FLOATS.search(node.form))
        for part in program
        for _, node in walk(part)
    )


def _has_alpha(program: Sequence[Node]) -> bool:
    """True if all targets of a pass have an alpha, or it has only those of its base."""
    return all(
        _ALPHA.search(node.form)
        for part in program
        for _, node in walk(part)
        if node.role == "target"
    )


def frame(writer: Writer, drawn: Node, program: Sequence[Node]) -> Node:
    """A frame that draws all models with the pass ``drawn``, and shows its targets or its depths.

    It declares the textures and buffers that parts of the ``program`` read, and computes some of
    the pass's parameters.
    """
    bound = [*_bound(program)]
    inputs = [Node(f"{each.name} = {each.name}") for each in bound]
    inputs += _computed(writer, drawn)
    inputs += _settings(writer, drawn)
    with_ = listed(" with {{ {} }}", inputs, ", ") if inputs else Node("")
    repeated = "sum lamp in rig : " if _adds(drawn) and writer.maybe(0.7) else ""
    items = (
        Node("param amount : float = 0.5"),
        Node("param many : int in 1..4 = 2"),
        Node("models scene"),
        *bound,
        Node(f"first = {repeated}Drawn(scene){{}}", (with_,)),
        *(Node(f"output {name} = first.{name}") for name in _targets(drawn)),
    )
    made = listed("frame Shown {{\n    {}\n}}", items, "\n    ", "frame")
    return replace(made, optional=True)


def _bound(program: Sequence[Node]) -> Iterator[Node]:
    """The textures without defaults, and the buffers, that a program declares."""
    for part in program:
        for _, node in walk(part):
            if node.role == "buffer" or (node.role == "map" and " = " not in node.form):
                keyword, name, _, type_ = node.form.split()[:4]
                yield Node(f"{keyword} {name} : {type_}", name=name)


def _computed(writer: Writer, drawn: Node) -> Iterator[Node]:
    """Parameters of a pass to which the frame gives other numbers."""
    for _, node in walk(drawn):
        if node.role == "parameter" and node.form.split()[3] == "float" and writer.maybe(0.5):
            number = writer.expression("float", _NUMBERS, FUEL // 4)
            yield Node(f"{node.name} = {{}}", (number,), optional=True)


def _settings(writer: Writer, drawn: Node) -> Iterator[Node]:
    """The settings of the rectangle that the step draws to, and of the colours before it draws."""
    if writer.maybe(0.2):
        yield Node("viewport = ivec4(size.x / 4, 0, size.x / 2, size.y)", optional=True)
    if writer.maybe(0.2):
        yield Node("scissor = ivec4(2, 3, size.x - many, size.y)", optional=True)
    for target in _targets(drawn):
        if writer.maybe(0.2):
            yield Node(f"clear.{target} = 0.5", optional=True)


def _targets(drawn: Node) -> Iterator[str]:
    """The names of what a pass leaves: without a base, it has no targets, and leaves depths."""
    yield "color" if " : Forward" in drawn.form else "depth"
    yield from (node.name for _, node in walk(drawn) if node.role == "target")


def _adds(drawn: Node) -> bool:
    """True if a pass can be drawn once for each light, because all of its targets are added up."""
    targets = [node for _, node in walk(drawn) if node.role == "target"]
    return all(" blend add" in each.form for each in (drawn, *targets))
