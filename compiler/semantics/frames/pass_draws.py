"""The draws of a pass: models with materials, or vertices without them, and their shaders.

``steps.py`` asks for it, by the first argument of a pass.
"""

from __future__ import annotations

from collections.abc import Mapping

from ....support.frozen import frozen, record
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...diagnostics.source import Span
from ...ir import build
from ...ir.blending import REPLACES
from ...ir.frame import Drawn, FrameShader, Use
from ...ir.leaves import Attribute
from ...ir.node import Node, reachable
from ...ir.stages import TARGET
from ...ir.types import INT
from ...syntax import ast
from ..checking.step_needs import SCREEN
from ..declarations.fitting import fit
from ..names.modules import Symbol
from ..state.context import Context
from ..state.evaluation import node_of
from ..state.scope import Failure, Scope
from .inputs import Inputs
from .light_textures import Bringing
from .shaders import Shaders, required_of
from .values import Numbers, on_host

CORNERS = 3
"""The vertices of ``screen``."""
VERTICES = "vertices"
"""``vertices(n)``: as many as that, which have nothing but their numbers."""
BARE = ("point", "triangle")
"""The primitives that vertices without a mesh can make."""


@frozen(eq=False)
class What:
    """The objects that a pass draws: models with materials, or vertices without them."""

    models: str = ""
    materials: tuple[Symbol | None, ...] = (None,)
    vertices: int | None = None
    """The number of the value that says how many."""


@record
class ModelsOf:
    """Models that a frame declares, and the materials that they may have."""

    member: ast.Models
    materials: tuple[Symbol, ...]


class Draws:
    """Finds the draws of the passes of one frame."""

    def __init__(
        self,
        ctx: Context,
        shaders: Shaders,
        models: Mapping[str, ModelsOf],
        numbers: Numbers,
        bringing: Bringing,
    ) -> None:
        self._ctx = ctx
        self._shaders = shaders
        self._models = models
        self._numbers = numbers
        self._bringing = bringing

    def what(self, e: ast.Expression, scope: Scope) -> What | None:
        """The objects to draw, by the first argument of a pass; ``None`` after an error report."""
        name = e.name if isinstance(e, ast.Reference) else ""
        if name in self._models:
            materials = self._models[name].materials
            return What(name, materials) if materials else None
        tree = self._ctx.tree
        if name == SCREEN:
            return self._vertices(build.constant(tree, INT, CORNERS))
        match e:
            case ast.Call(callee=ast.Reference(name=called), arguments=(count,)):
                if called == VERTICES:
                    node = node_of(self._ctx, count, scope)
                    number = fit(self._ctx, node, INT, "int", count.span)
                    return self._vertices(on_host(self._ctx, number, count.span))
        self._not_drawn(name, e.span)
        return None

    def _not_drawn(self, name: str, span: Span) -> None:
        """Reports what a pass is told to draw, with the names that the frame has for models."""
        known = [*self._models, SCREEN, f"{VERTICES}(n)"]
        hint = f"there is {', '.join(f'`{each}`' for each in known)}"
        declared = [models.member.name.span for models in self._models.values()]
        elsewhere = [each for each in declared if name and each.source is not span.source]
        if elsewhere:
            hint += f"; what is imported draws `{name}`: declare the models as `models {name}`"
        elif name and not self._models:
            hint += f"; models of the host's scene are declared by `models {name}`"
        labels = [Label(each, "these models have another name") for each in elsewhere]
        self._ctx.report.add(rules.NOT_DRAWN, span, hint=hint, labels=labels)

    def _vertices(self, count: Node | Failure) -> What | None:
        number = self._numbers.number(count)
        return None if isinstance(number, Failure) else What(vertices=number)

    def draws(
        self,
        symbol: Symbol,
        what: What,
        inputs: Inputs,
        e: ast.Call,
        by_light: bool,
    ) -> list[Drawn] | None:
        """The draws of a pass, one behind the other; ``None`` after reporting an error."""
        rig = self._shaders.rig.declaration
        lights = rig.entries if by_light and isinstance(rig, ast.Rig) else (None,)
        draws = []
        for light in lights:
            uses = []
            for material in what.materials:
                shader = self._shaders.drawn(symbol, material, light)
                if shader is None or (light and not self._is_added(shader, symbol, e)):
                    return None
                if material is None and not self._is_bare(shader, symbol, e):
                    return None
                use = self.use(material.name if material else "", shader, symbol, inputs, e)
                if use is None:
                    return None
                uses.append(use)
            named = light.name.text if light else ""
            draws.append(Drawn(what.models, what.vertices, tuple(uses), named))
        return draws

    def _is_added(self, shader: FrameShader, symbol: Symbol, e: ast.Call) -> bool:
        """True if the light's part is added to that of others, and does not replace it."""
        for result in shader.shader.results_of(TARGET):
            if result.state is not None and result.state.blend == REPLACES:
                self._ctx.report.add(rules.NOT_ADDED, e.span, target=result.name, step=symbol.name)
                return False
        return True

    def _is_bare(self, shader: FrameShader, symbol: Symbol, e: ast.Call) -> bool:
        """True if a shader can be drawn without a mesh."""
        span, step = e.arguments[0].span, symbol.name
        expansion = shader.shader.expansion
        primitive = expansion.primitive if expansion else "triangle"
        if shader.shader.tessellation:
            primitive = "patch"
        if primitive not in BARE:
            kinds = primitive.replace("_", " with ") + ("es" if primitive == "patch" else "s")
            self._ctx.report.add(rules.NO_SHARED_VERTICES, span, step=step, primitives=kinds)
            return False
        for node in reachable(shader.shader.roots):
            if isinstance(node.data, Attribute):
                self._ctx.report.add(rules.NO_VERTEX_INPUTS, span, step=step, input=node.data.name)
                return False
        return True

    def use(
        self, material: str, shader: FrameShader, symbol: Symbol, inputs: Inputs, e: ast.Call
    ) -> Use | None:
        """A shader with its inputs; ``None`` after reporting inputs that it lacks."""
        found = inputs.of(shader.shader)
        missing = inputs.lacks(required_of(self._ctx.records.of(symbol)))
        for name in missing:
            self._ctx.report.add(
                rules.INPUT_MISSING, e.span, step=symbol.name, name=name.text,
                labels=[Label(name.span, "declared here, without a default")],
            )  # fmt: skip
        brought = self._bringing.given(shader.shader, inputs, e)
        if found is None or brought is None or missing:
            return None
        return Use(material, shader, (*found, *brought))
