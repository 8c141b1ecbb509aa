"""The inputs and outputs of one stage as a text declares them, and the division of its patches.

``stage.py`` makes ``Fields`` for each stage, and puts the results into the stage's view.
"""

from __future__ import annotations

from collections.abc import Iterator

from ...compiler.ir.program import Field, Output, Program, Stage
from ...compiler.ir.stages import CAPTURE, CONTROL, EVALUATION, PATCHES, TARGET
from ...compiler.ir.types import of_floats
from ...support.frozen import changed
from ..description.shading_language import FieldRole
from .comments import comment_line
from .context import Context
from .views import FieldView, StoreView, TessellationView

DIVIDING = (CONTROL, EVALUATION)
"""The stages that divide patches."""


class Fields:
    """The inputs and outputs of one stage: from and to other stages, the mesh and the host."""

    def __init__(self, context: Context, stage: Stage) -> None:
        self._context = context
        self._stage = stage
        self._names = context.names
        self._roles = dict(_roles_of_inputs(context.program, stage))
        self._inputs = [self._input(field, self._roles[field.name]) for field in stage.inputs]
        self._handed_on = [
            self._field(f, "control point", True, f.invariant) for f in stage.handed_on
        ]
        self._delivered = [self._output(each) for each in stage.results if each.field is not None]

    @property
    def inputs(self) -> list[FieldView]:
        """The stage's inputs, without those that are the same for a whole patch."""
        return [field for field in self._inputs if not field.of_patch]

    @property
    def outputs(self) -> list[FieldView]:
        """The stage's outputs, handed-on inputs included, without those of whole patches."""
        return [*self._handed_on, *(field for field in self._delivered if not field.of_patch)]

    @property
    def delivered(self) -> list[FieldView]:
        """The outputs to which the stage's results go, in their order."""
        return self._delivered

    def names(self) -> list[str]:
        """The names of all inputs and outputs."""
        return [field.name for field in (*self._inputs, *self._handed_on, *self._delivered)]

    def name_of(self, output: Output) -> str:
        """The name of an output that has a location."""
        assert output.field is not None
        return self._name(output.field, self._role(output))

    def capture_stride(self) -> int:
        """The bytes of each captured vertex, if the text has to state them; else 0."""
        capture = self._context.program.shader.capture
        stream = self._context.profile.stream_output
        is_said = stream is not None and stream.told == "text"
        captures = is_said and self._stage.results_of(CAPTURE)
        return capture.stride if capture is not None and captures else 0

    def tessellation(self) -> TessellationView | None:
        """The division of patches, for the two tessellation stages; ``None`` in other stages."""
        patches = self._context.program.shader.tessellation
        if patches is None or self._stage.row not in DIVIDING:
            return None
        is_control = self._stage.row == CONTROL
        language, kind = self._context.language, patches.kind
        crossing = self._delivered if is_control else self._inputs
        return TessellationView(
            patch=language.patches[patches.patch],
            lines=kind.drawn == "line",
            spacing=language.spacings[patches.spacing],
            points=patches.points,
            edge_levels=len(kind.edges),
            inner_levels=len(kind.inner),
            is_control=is_control,
            own=[field for field in crossing if field.of_patch],
            handing=[
                StoreView(self._name(field, "control point"), self._name(field, "varying"))
                for field in self._stage.handed_on
            ],
        )

    def _input(self, field: Field, role: FieldRole) -> FieldView:
        says_so = field.invariant and self._context.profile.invariant_inputs
        return self._field(field, role, field.mode == "corner", says_so)

    def _output(self, output: Output) -> FieldView:
        assert output.field is not None
        view = self._field(output.field, self._role(output), False, output.field.invariant)
        capture = self._context.program.shader.capture
        if output.kind != CAPTURE or capture is None or not self.capture_stride():
            return view
        return changed(view, captured_at=str(capture.member(output.field.name).offset))

    def _role(self, output: Output) -> FieldRole:
        """The role of an output: a render target, or an input of the next stage."""
        if output.kind == TARGET:
            return "render target"
        return "of patch" if self._stage.row.domain == PATCHES else "varying"

    def _name(self, field: Field, role: FieldRole) -> str:
        table = {
            "attribute": self._names.attributes,
            "varying": self._names.varyings,
            "of patch": self._names.varyings,
            "control point": self._names.points,
            "render target": self._names.render_targets,
        }
        return table[role][field.name]

    def _semantic(self, field: Field, role: FieldRole) -> str:
        if role == "attribute":
            return self._names.semantics[field.name]
        return self._context.language.semantic(role, field.name, field.location)

    def _field(self, field: Field, role: FieldRole, per_corner: bool, invariant: bool) -> FieldView:
        name, types = self._name(field, role), self._context.types
        type_ = field.type
        if role == "attribute" and self._context.profile.attributes_of_floats:
            type_ = of_floats(type_)
        return FieldView(
            name=name,
            type=types.type(type_),
            typed=types.declare(name, type_),
            location=field.location,
            semantic=self._semantic(field, role),
            crosses=role == "varying",
            flat=field.mode == "flat" and role == "varying",
            comment=comment_line(field.doc),
            of_patch=role == "of patch",
            per_corner=per_corner,
            invariant=invariant,
        )


def _roles_of_inputs(program: Program, stage: Stage) -> Iterator[tuple[str, FieldRole]]:
    """The names of a stage's inputs, each with its role."""
    for field in stage.inputs:
        yield field.name, "attribute"
    for face in program.interfaces_into(stage):
        role: FieldRole = "of patch" if face.origin == PATCHES else "varying"
        for field in face.fields:
            yield field.name, "control point" if face.through else role
