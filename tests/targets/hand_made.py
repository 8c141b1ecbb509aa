"""Compiles shaders that tests have put together by hand, and no file declares."""

from __future__ import annotations

from collections.abc import Sequence

from burnish.api.compiled import CompiledMaterial
from burnish.api.compiling import _material, _printed
from burnish.api.graphs import KeptGraphs, PlaceOfGraphs, ResultGraphs
from burnish.compiler.ir.shader import Shader
from burnish.compiler.passes.pipeline import Options, stage
from burnish.targets import registry
from burnish.targets.emit.emitter import EmitOptions


def compiled_shader(
    shader: Shader, profiles: Sequence[str], options: EmitOptions | None = None
) -> CompiledMaterial:
    """The texts of a shader for profiles that can do all that it needs."""
    options = options or EmitOptions()
    chosen = [registry.select(name) for name in profiles]
    graphs = _printed(shader, stage(shader, Options()), chosen, options)
    kept = KeptGraphs(lambda: ResultGraphs((graphs,), ()), stay=True)
    return _material(graphs, {}, chosen, options, PlaceOfGraphs(kept, 0))
