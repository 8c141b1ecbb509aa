"""Splits the graph of a shader into functions that an engine calls, instead of stages.

``stage_functions`` calls it last, and ``targets/legalise`` again if that has changed some values.
Each function is scheduled by itself: what two of them share is computed by both.
"""

from __future__ import annotations

from collections.abc import Sequence

from ..ir.program import Field, Output, Program
from ..ir.shader import Result, Shader
from ..ir.stages import VALUE
from ..ir.walks import visible
from .split_stages import Work, stage_of


def split_functions(shader: Shader) -> Program:
    """The program of a shader whose results are returned by functions."""
    functions: dict[str, list[Result]] = {}
    for result in shader.results_of(VALUE):
        functions.setdefault(result.function, []).append(result)
    stages = tuple(
        stage_of(_work(name, results), shader, (), ()) for name, results in functions.items()
    )
    textures = tuple(
        info.leaf
        for info in shader.textures
        if any(info.leaf in stage.textures for stage in stages)
    )
    return Program(shader, stages, (), textures, ())


def _work(name: str, results: Sequence[Result]) -> Work:
    outputs = tuple(
        Output(VALUE, result.value, Field(result.name, result.value.type, number, doc=result.doc))
        for number, result in enumerate(results)
    )
    nodes = visible([output.value for output in outputs], into_bodies=True)
    return Work(results[0].stage, outputs, (), (), nodes, name)
