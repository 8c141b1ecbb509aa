"""Shows what a material writes with smooth edges: several samples a pixel, in floats until the end.

``burnish view`` draws so, and ``burnish render --samples``. The light of a picture is not rounded
before it is developed, so that no exposure shows steps, and dark colours have none of another hue.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from ...compiler.documents.reflection import Reflection
from ...compiler.ir.shader import Result, Shader
from ...support.frozen import changed
from .exact import Retargeted
from .kernels import has_images
from .subject import Subject

_FORMAT = "rgba16f"
"""The format of light: every API can draw to it with several samples, and blend there."""
_OF_LIGHT = frozenset(("rgba8", "rgba8_srgb", "bgra8", "bgra8_srgb", "rgb10a2", _FORMAT))
"""The formats that it takes the place of."""


@dataclass(frozen=True, slots=True)
class Smooth(Retargeted):
    """A material whose targets are of floats, and have several samples in each pixel."""

    samples: int

    @classmethod
    def of(cls, subject: Subject, samples: int) -> Smooth:
        """The material with such targets. ``can_be_smooth`` says whether it can have them."""
        reflection = subject.reflection
        targets = tuple(
            changed(row, format=_FORMAT, encoding="linear") for row in reflection.targets
        )
        state = changed(reflection.render_state, samples=samples)
        return cls(subject, changed(reflection, targets=targets, render_state=state), samples)

    @property
    def shader(self) -> Shader:
        """The shader of the material as it is meant."""
        return self._smooth(self.subject.shader)

    def emitted(self, profile: str) -> Shader:
        """The shader that the texts for a profile compute."""
        return self._smooth(self.subject.emitted(profile))

    def _smooth(self, shader: Shader) -> Shader:
        results = tuple(map(_in_floats, shader.results))
        state = changed(shader.render_state, samples=self.samples)
        return changed(shader, results=results, render_state=state)


def can_be_smooth(reflection: Reflection) -> bool:
    """True for what draws light to one layer, in a single sample that it does not ask for."""
    return (
        bool(reflection.targets)
        and not has_images(reflection)
        and reflection.draw.layers is None
        and reflection.render_state.samples == 1
        and _are_of_light(row.format for row in reflection.targets)
    )


def _are_of_light(formats: Iterable[str]) -> bool:
    return _OF_LIGHT.issuperset(formats)


def _in_floats(result: Result) -> Result:
    if result.state is None:
        return result
    return changed(result, state=changed(result.state, format=_FORMAT))
