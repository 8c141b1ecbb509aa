"""Specialises shaders: their texts serve only some of the values that parameters may have.

``compiling.py`` calls ``specialised`` with what ``compile(values=…)`` or ``burnish compile --set``
was given, before all passes.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from ..compiler.diagnostics import rules
from ..compiler.diagnostics.diagnostic import Report
from ..compiler.ir.frame import Frame, FrameShader, Given, KernelStep, Step
from ..compiler.ir.leaves import Parameter
from ..compiler.ir.shader import ParameterInfo, Shader
from ..compiler.passes.narrow import narrow
from ..support.frozen import changed

Values = Sequence[tuple[str, str]]
"""Names of parameters, and what is said of each: a value, or a range such as ``0.3..0.5``."""
Names = Mapping[str, ParameterInfo]
"""The parameters of a shader or a frame that can be narrowed, by the names that hosts use."""
Narrowed = dict[Parameter, ParameterInfo]
"""The new declarations of parameters."""


def specialised(
    shaders: Sequence[Shader], values: Values, report: Report, *, told: bool = False
) -> list[Shader]:
    """The shaders of materials or kernels for some values; mistakes are in the report.

    Where hosts are only ``told``, the shaders still serve all values.
    """
    found = _narrowed([_own_names(each) for each in shaders], values, report)
    if told:
        found = [_told(narrowed) for narrowed in found]
    return [_with(shader, new) for shader, new in zip(shaders, found, strict=True)]


def _told(narrowed: Narrowed) -> Narrowed:
    """New defaults and ranges, with all that passes prove by as it was declared."""
    return {leaf: changed(info, leaf=leaf) for leaf, info in narrowed.items()}


def specialised_frames(frames: Iterable[Frame], values: Values, report: Report) -> list[Frame]:
    """The frames with their shaders for some values; ``Clay.base`` is that of one material.

    A parameter of a frame is narrowed in each shader to which the frame hands it on as it is.
    """
    frames = list(frames)
    shaders = [(frame, each) for frame in frames for each in frame.shaders]
    known = [
        *(_names_in(frame, shader) for frame, shader in shaders),
        *({info.leaf.name: info for info in frame.parameters} for frame in frames),
    ]
    found = _narrowed(known, values, report)
    pairs = zip((shader for _frame, shader in shaders), found, strict=False)
    new = {old: FrameShader(old.name, _with(old.shader, n)) for old, n in pairs}
    of_frames = zip(frames, found[len(shaders) :], strict=True)
    return [_with_shaders(frame, new, narrowed) for frame, narrowed in of_frames]


def _with(shader: Shader, narrowed: Narrowed) -> Shader:
    return narrow(shader, narrowed) if narrowed else shader


def _own_names(shader: Shader) -> dict[str, ParameterInfo]:
    """The parameters of a shader, by name, but those that count the elements of buffers."""
    counts = {info.count.leaf.name for info in shader.buffers}
    return {i.leaf.name: i for i in shader.parameters if i.leaf.name not in counts}


def _names_in(frame: Frame, shader: FrameShader) -> dict[str, ParameterInfo]:
    """The parameters of a shader by the names that hosts of its frame use."""
    uses = [use for step in frame.steps for use in step.uses if use.shader is shader]
    given = [each for use in uses for each in use.given]
    own = _own_names(shader.shader)
    inputs = {each.name: own.pop(each.name) for each in given if each.name in own}
    materials = {use.material for use in uses if use.material}
    owned = {f"{owner}.{name}": info for owner in materials for name, info in own.items()}
    handed = {
        source: info
        for name, info in inputs.items()
        if (source := _handed_on(frame, [each for each in given if each.name == name], len(uses)))
    }
    return {**own, **owned, **handed}


def _handed_on(frame: Frame, given: Sequence[Given], uses: int) -> str:
    """The name of the frame's parameter that all uses of a shader get; empty if there is none."""
    values = [frame.values[each.source] for each in given if isinstance(each.source, int)]
    sources = {value.data.name for value in values if isinstance(value.data, Parameter)}
    is_same = len(sources) == 1 and len(values) == uses
    return sources.pop() if is_same else ""


def _with_shaders(
    frame: Frame, new: Mapping[FrameShader, FrameShader], narrowed: Narrowed
) -> Frame:
    """A frame that draws with other shaders, and declares some parameters otherwise."""

    def of(step: Step) -> Step:
        if isinstance(step, KernelStep):
            return changed(step, use=changed(step.use, shader=new[step.use.shader]))
        draws = (
            changed(drawn, uses=tuple(changed(u, shader=new[u.shader]) for u in drawn.uses))
            for drawn in step.draws
        )
        return changed(step, draws=tuple(draws))

    return changed(
        frame,
        shaders=tuple(new[each] for each in frame.shaders),
        steps=tuple(map(of, frame.steps)),
        parameters=tuple(narrowed.get(info.leaf, info) for info in frame.parameters),
    )


def _narrowed(known: Sequence[Names], values: Values, report: Report) -> list[Narrowed]:
    """The new declarations of parameters, for the names of each shader or frame."""
    found: list[Narrowed] = [{} for _ in known]
    for name, text in values:
        having = [
            (names[name], new) for names, new in zip(known, found, strict=True) if name in names
        ]
        problem = _problem(name, text, having, known)
        if problem:
            report.add(rules.NOT_SPECIALISED, None, problem=problem)
    return found


def _problem(
    name: str, text: str, having: Iterable[tuple[ParameterInfo, Narrowed]], known: Iterable[Names]
) -> str:
    """Declare a parameter otherwise in all shaders that have it; what is wrong, if anything is."""
    from ..targets.runner.instances.names import no_parameter
    from ..targets.runner.instances.values import ParameterError
    from .narrowed_values import narrowed_info

    if not having:
        return no_parameter(name, list(dict.fromkeys(_every_name(known))))
    try:
        for info, narrowed in having:
            narrowed[info.leaf] = narrowed_info(info, text, name)
    except ParameterError as error:
        return str(error)
    return ""


def _every_name(known: Iterable[Names]) -> Iterator[str]:
    for names in known:
        yield from names
