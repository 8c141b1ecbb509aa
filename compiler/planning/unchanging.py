"""Finds the steps of a frame that leave the same in every frame, so that the first one is enough.

``plan.py`` asks for them. Such a step draws no models and no lights, which are the host's, and all
that it is given is known when compiling, or was left by other such steps: tables, for example.
"""

from __future__ import annotations

from collections.abc import Iterable

from ..ir.frame import Elements, Frame, Previous, RenderStep, Step, StepTexture, Use
from ..ir.leaves import Buffer, Parameter, Texture
from ..ir.node import Node, reachable
from .lifetimes import Left, attachments_of, read_by, sources_of, written_by


def unchanging(frame: Frame) -> frozenset[str]:
    """The names of these steps.

    Outputs for the host, results that others draw over, and textures that are exchanged with those
    of the last frame are drawn anew in each frame.
    """
    drawn_anew: set[Left | None] = {output.source for output in frame.outputs}
    for step in frame.steps:
        drawn_anew.update(each.over for each in attachments_of(step))
        drawn_anew.update(each.of for each in sources_of(step) if isinstance(each, Previous))
    found = {
        step.name: step
        for step in frame.steps
        if _is_known(frame, step) and drawn_anew.isdisjoint(written_by(step))
    }
    while changing := [step for step in found.values() if not _is_among(frame, step, found)]:
        for step in changing:
            del found[step.name]
    return frozenset(found)


def _is_among(frame: Frame, step: Step, found: Iterable[str]) -> bool:
    """True if all steps are in ``found`` whose results this step reads or draws to."""
    images = {*written_by(step), *read_by(step)}
    return all(
        other.name in found for other in frame.steps if not images.isdisjoint(written_by(other))
    )


def _is_known(frame: Frame, step: Step) -> bool:
    """True if all inputs and attachments of a step are known.

    They are neither the host's nor the last frame's.
    """
    given = list(sources_of(step))
    numbers = [source for source in given if isinstance(source, int)]
    for left in written_by(step):
        if isinstance(left, Elements) or left.size.value is None:
            return False
        numbers.append(left.size.value)
    if isinstance(step, RenderStep):
        numbers += step.settings
        for drawn in step.draws:
            if drawn.vertices is None or drawn.light:
                return False
            numbers.append(drawn.vertices)
    if any(attachment.over is not None for attachment in attachments_of(step)):
        return False
    return (
        all(isinstance(source, int | StepTexture) for source in given)
        and all(_is_constant(frame.values[number]) for number in numbers)
        and all(_is_given_all(use) for use in step.uses)
    )


def _is_constant(value: Node) -> bool:
    return not any(isinstance(node.data, Parameter | Texture) for node in reachable((value,)))


def _is_given_all(use: Use) -> bool:
    """True if the frame sets all that a shader reads."""
    names = {given.name for given in use.given}
    return all(
        node.data.name in names
        for node in reachable(use.shader.shader.roots)
        if isinstance(node.data, Parameter | Texture | Buffer)
    )
