"""The shaders of a frame: each pass with each material and the lights it is drawn under, once.

``steps.py`` asks for them where a step applies a pass or a kernel.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ....support.frozen import changed, fresh, frozen, record
from ...diagnostics.diagnostic import Report
from ...ir.frame import FrameShader
from ...ir.leaves import behind
from ...ir.shader import BufferInfo, ParameterInfo, Shader, TextureInfo
from ...syntax import ast
from ..inheritance.flattening import Records
from ..inheritance.records import Record
from ..names.modules import Module, Symbol
from ..shading.assembly import Parts, set_up
from ..shading.elaborate import elaborate
from ..shading.kernels.kernel import kernel_shader
from ..shading.room import has_room

Input = ParameterInfo | TextureInfo | BufferInfo
"""An input of a shader that a host, or a frame, sets."""


@frozen
class Key:
    """The parts of which a shader is made."""

    step: Symbol
    """A pass or a kernel."""
    material: Symbol | None
    light: str
    """The only entry of the rig under which it is drawn; empty for the whole rig."""


@record
class Shaders:
    """The shaders that the steps of a frame have asked for."""

    frame: str
    module: Module
    rig: Symbol
    root: Symbol
    """The material that passes draw where there is none of their own."""
    report: Report
    records: Records
    reached: set[Symbol]
    known: dict[Key, FrameShader | None] = fresh(factory=dict)

    @property
    def made(self) -> tuple[FrameShader, ...]:
        """All shaders that have no errors."""
        return tuple(shader for shader in self.known.values() if shader is not None)

    def drawn(
        self, pass_: Symbol, material: Symbol | None, light: ast.RigEntry | None = None
    ) -> FrameShader | None:
        """A pass that draws a material, or no material of its own; under one light, or all."""
        key = Key(pass_, material, "" if light is None else light.name.text)
        if key not in self.known:
            self.known[key] = self._drawn(key, light)
        return self.known[key]

    def kernel(self, kernel: Symbol) -> FrameShader | None:
        """A kernel."""
        key = Key(kernel, None, "")
        if key not in self.known:
            report = self.report.apart()
            shader = kernel_shader(kernel, self.module, report, self.records)
            self.report.extend(report.since(0))
            self.reached.add(kernel)
            self.known[key] = None if shader is None else self._named(key, shader)
        return self.known[key]

    def _drawn(self, key: Key, light: ast.RigEntry | None) -> FrameShader | None:
        symbol = key.material or key.step
        if not has_room(symbol, self.records, self.report):
            return None
        rig = self.rig if light is None else _alone(self.rig, light)
        parts = Parts(key.material or self.root, rig, key.step, self.module)
        setting = set_up(parts, self.report.apart(), self.records)
        shader = elaborate(setting, self.reached)
        self.report.extend(setting.ctx.report.since(0))
        return None if shader is None else self._named(key, shader)

    def _named(self, key: Key, shader: Shader) -> FrameShader:
        parts = (self.frame, key.step.name, key.material and key.material.name, key.light)
        name = ".".join(part for part in parts if part)
        declaration = (key.material or key.step).declaration
        assert isinstance(declaration, ast.Record)
        return FrameShader(name, changed(shader, name=name, doc=declaration.doc))


def _alone(rig: Symbol, light: ast.RigEntry) -> Symbol:
    """A rig with one light of an entry, which has the entry's name."""
    declaration = rig.declaration
    assert isinstance(declaration, ast.Rig)
    single = changed(light, count=None, number="one")
    return Symbol(changed(declaration, entries=(single,)), rig.module)


def inputs_of(shader: Shader) -> Mapping[str, Input]:
    """The inputs of a shader that can be set, by the names that hosts know."""
    counts = {info.count.leaf.name for info in shader.buffers}
    found: dict[str, Input] = {
        info.leaf.name: info for info in shader.parameters if info.leaf.name not in counts
    }
    found |= {info.leaf.name: info for info in shader.textures}
    return found | {info.leaf.name: info for info in shader.buffers}


def host_name(shader: Shader, name: str, inputs: Mapping[str, Input]) -> str | None:
    """The hosts' name of the input that a frame calls ``name``; a pass's own one comes first."""
    own = behind(shader.pass_name, name)
    return own if own in inputs else name if name in inputs else None


def required_of(record: Record) -> Iterator[ast.Name]:
    """The textures without a default and the buffers that a pass, a kernel or a light declares."""
    for definitions in record.definitions.values():
        member = definitions[0].member
        is_open = isinstance(member, ast.Texture) and member.default is None
        if is_open or isinstance(member, ast.Buffer):
            yield member.name
