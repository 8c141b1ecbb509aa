"""Shows exactly what a material writes: its targets hold every number, and nothing is mixed.

A pass without targets shows the depths of what it draws, also where it keeps stencil values only.

``conform`` compares such pictures, ``burnish render`` draws them, and so do tests.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeVar

from ...compiler.documents.drawing import RenderStateRow, TargetRow
from ...compiler.documents.reflection import Reflection
from ...compiler.ir.blending import REPLACES
from ...compiler.ir.formats import TARGET_FORMATS
from ...compiler.ir.render_state import RenderState
from ...compiler.ir.shader import Result, Shader
from ...compiler.ir.types import Type
from ...support.frozen import changed
from .codes import ShaderFile
from .drivers.render_state import ALL_LANES
from .subject import Subject

_FLOATS: Mapping[Type, str] = {
    TARGET_FORMATS[name].type: name for name in ("r32f", "rg32f", "rgba32f")
}
"""For each type that is written to a target, a format that can hold every value of it."""

_WHOLE: Any = {"samples": 1, "alpha_to_coverage": False}
"""The state by which each fragment is written to a whole pixel."""

_State = TypeVar("_State", RenderState, RenderStateRow)


@dataclass(frozen=True, slots=True)
class Retargeted:
    """A material that is drawn to other targets than those that its pass declares."""

    subject: Subject
    reflection: Reflection

    @property
    def name(self) -> str:
        """The name of the material."""
        return self.subject.name

    @property
    def files(self) -> Sequence[ShaderFile]:
        """The emitted texts, which do not depend on the formats of targets."""
        return self.subject.files

    @property
    def lacking(self) -> Mapping[str, str]:
        """The reason for each profile that has no texts."""
        return self.subject.lacking


@dataclass(frozen=True, slots=True)
class Exact(Retargeted):
    """A material whose targets keep what it writes.

    They are neither rounded to the declared formats nor blended, and each pixel has one sample.
    """

    @classmethod
    def of(cls, subject: Subject) -> Exact:
        """The material with such targets."""
        reflection = subject.reflection
        return cls(
            subject,
            changed(
                reflection,
                targets=tuple(map(_exact_row, reflection.targets)),
                render_state=_exact_state(reflection.render_state, bool(reflection.targets)),
            ),
        )

    @property
    def shader(self) -> Shader:
        """The shader of the material as it is meant."""
        return exact_shader(self.subject.shader)

    def emitted(self, profile: str) -> Shader:
        """The shader that the texts for a profile compute."""
        return exact_shader(self.subject.emitted(profile))


def exact_shader(shader: Shader) -> Shader:
    """The shader with targets that keep what it writes."""
    results = tuple(map(_exact_result, shader.results))
    state = _exact_state(shader.render_state, bool(shader.targets))
    return changed(shader, results=results, render_state=state)


def _exact_state(state: _State, has_targets: bool) -> _State:
    """The state by which each fragment is kept whole: in the targets, or else in the depths."""
    whole: _State = changed(state, **_WHOLE)
    return whole if has_targets else changed(whole, depth=changed(whole.depth, write=True))


def exact_format(declared: str) -> str:
    """The format that takes the same values as a declared one, and keeps them."""
    return _FLOATS[TARGET_FORMATS[declared].type]


def _exact_row(row: TargetRow) -> TargetRow:
    format_ = exact_format(row.format)
    return changed(row, format=format_, encoding="linear", blend=None, mask=ALL_LANES)


def _exact_result(result: Result) -> Result:
    if result.state is None:
        return result
    format_ = exact_format(result.state.format)
    return changed(
        result, state=changed(result.state, format=format_, blend=REPLACES, mask=ALL_LANES)
    )
