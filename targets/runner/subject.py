"""The shaders that are drawn: compiled materials, as ``burnish.compile`` returns them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import chain
from typing import Protocol

from ...compiler.documents.reflection import Reflection
from ...compiler.ir.shader import Shader
from .codes import ShaderFile
from .routes import Route


class Subject(Protocol):
    """A compiled material with its texts for the profiles of all routes that will draw it."""

    @property
    def name(self) -> str:
        """The name of the material."""

    @property
    def files(self) -> Sequence[ShaderFile]:
        """The emitted texts."""

    @property
    def lacking(self) -> Mapping[str, str]:
        """The reason for each profile that has no texts."""

    @property
    def reflection(self) -> Reflection:
        """The reflection, by which a host binds."""

    @property
    def shader(self) -> Shader:
        """The shader before the passes, as the material means it."""

    def emitted(self, profile: str) -> Shader:
        """The shader that the texts for a profile compute, which the reference bounds."""


def lacking(shaders: Iterable[Subject], route: Route) -> str | None:
    """The reason why a route cannot draw something with these shaders, or ``None``."""
    reasons = (shader.lacking.get(route.profile) or _unknown(shader, route) for shader in shaders)
    return next(filter(None, reasons), None)


def _unknown(shader: Subject, route: Route) -> str | None:
    """A value of the pipeline that the route's compiler does not know, as a reason."""
    read = chain.from_iterable(shader.reflection.pipeline_inputs.values())
    unknown = next((name for name in read if name in route.unknown_inputs), None)
    return None if unknown is None else f"{route.compiler} does not know `{unknown}`"
