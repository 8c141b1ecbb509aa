"""The textures that lights bring by steps of their own: a shadow map, drawn with its own camera.

``steps.py`` asks for those that the shader of a step reads, and makes the steps that a light's
equations say, where the first shader needs them.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...ir.frame import Given, Source
from ...ir.leaves import Texture, behind
from ...ir.node import reachable
from ...ir.shader import Shader, TextureInfo
from ...syntax import ast
from ..checking.step_needs import Need
from ..inheritance.records import Definition
from ..state.context import Context
from ..state.scope import FAILURE, Failure
from .inputs import Inputs
from .shaders import inputs_of
from .step_context import EquationOwner, StepContext
from .values import Made


class Bringing:
    """The textures that the single lights of a rig bring to the steps of one frame."""

    def __init__(
        self,
        ctx: Context,
        lights: Mapping[str, EquationOwner],
        check: Callable[[EquationOwner, list[Need]], None],
        made: Callable[[ast.Expression, StepContext], Made],
    ) -> None:
        """``check`` makes the steps that an expression needs, and ``made`` evaluates it."""
        self._ctx = ctx
        self._lights = lights
        self._check = check
        self._made = made
        self._pending: list[str] = []
        """The textures that are being made."""

    def given(self, shader: Shader, inputs: Inputs, e: ast.Call) -> tuple[Given, ...] | None:
        """The textures of lights that a shader reads and that its step is not given otherwise.

        ``None`` after reporting one that nobody makes.
        """
        found = []
        for light in self._lights.values():
            for name, info in _textures(light, shader):
                host, written = info.leaf.name, behind(light.name, name)
                if inputs.sets(host) or inputs.sets(written):
                    continue
                definition = light.instance.record.definitions[name][0]
                assert isinstance(definition.member, ast.Texture)
                if definition.member.brought is not None:
                    source = self._source(light, definition, info, inputs)
                    if isinstance(source, Failure):
                        return None
                    found.append(Given(host, source))
                elif definition.member.default is None:
                    self._report_missing(written, shader, definition.member, e)
                    return None
        return tuple(found)

    def _source(
        self, light: EquationOwner, definition: Definition, info: TextureInfo, inputs: Inputs
    ) -> Source | Failure:
        """The source of a light's texture, with all steps that make it."""
        member = definition.member
        assert isinstance(member, ast.Texture) and member.brought is not None
        written, name = member.brought, behind(light.name, member.name.text)
        if name in self._pending:
            cycle = [*self._pending[self._pending.index(name) :], name]
            self._ctx.report.add(
                rules.FRAME_CYCLE, written.span, name=name, cycle=" → ".join(cycle)
            )
            return FAILURE
        self._pending.append(name)
        self._check(light, list(light.dependencies.needs(written, definition.level)))
        around = StepContext(light, light.scope(definition.owner, definition.level), name)
        made = self._made(written, around)
        self._pending.pop()
        return made if isinstance(made, Failure) else inputs.texture(made, written, info)

    def _report_missing(self, name: str, shader: Shader, member: ast.Texture, e: ast.Call) -> None:
        self._ctx.report.add(
            rules.INPUT_MISSING, e.span, step=shader.pass_name, name=name,
            labels=[Label(member.name.span, "declared here, without a default")],
        )  # fmt: skip


def _textures(light: EquationOwner, shader: Shader) -> Iterator[tuple[str, TextureInfo]]:
    """The textures of a light that a shader reads, by the light's names for them."""
    read = {n.data.name for n in reachable(shader.roots) if isinstance(n.data, Texture)}
    inputs = inputs_of(shader)
    for name, (definition, *_) in light.instance.record.definitions.items():
        if isinstance(definition.member, ast.Texture):
            of_light = behind(light.name, name)
            for host in (of_light, behind(shader.rig_name, of_light)):
                info = inputs.get(host)
                if isinstance(info, TextureInfo) and host in read:
                    yield name, info
