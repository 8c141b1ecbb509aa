"""The results of compiling a file: its materials, with their texts, reflection and proofs.

``compiling.py`` makes these records, and users of the library and the commands read them. Values
that many users never need are computed when they are first read.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import TYPE_CHECKING, Any

from ..compiler.diagnostics.diagnostic import Diagnostic
from ..compiler.diagnostics.source import Source, Span
from ..compiler.inputs import Inputs
from ..compiler.ir.leaves import Leaf
from ..compiler.ir.node import reachable
from ..compiler.ir.shader import Shader
from ..compiler.passes.guard import Guard
from ..compiler.passes.pipeline import Staged
from ..support.frozen import EMPTY, cached_property, changed, frozen
from ..support.garbage import seldom_collected
from ..targets.description.profile import Profile
from ..targets.description.shading_language import Language
from ..targets.emit.reflection import backend_row
from ..targets.selection import full_name
from .graphs import KeptGraphs, PlaceOfGraphs

if TYPE_CHECKING:
    from ..compiler.documents.plan import FramePlan
    from ..compiler.documents.reflection import Reflection
    from ..compiler.ir.frame import Frame
    from ..compiler.ir.program import StageName
    from ..compiler.passes.proofs import Proof
    from ..compiler.passes.removals import Removal
    from ..targets.runner.instances.instance import Instance

FileStage = str
"""The stage that a text is for, such as ``vertex``; ``all`` for a text that contains all stages."""


@frozen
class OutputFile:
    """One emitted shader text."""

    name: str
    """The name of the file: ``Plastic.frag.wgsl``; if the profile is not the target's default,
    ``Plastic.gl330.frag.glsl``; under a pass and a rig of several,
    ``Plastic.Fog.Night.frag.wgsl``."""
    target: str
    profile: str
    stage: FileStage
    entry_points: Mapping[StageName, str]
    """The entry point of each stage in the text."""
    text: str
    checkers: tuple[str, ...] = ()
    """The downstream compilers that must accept it."""
    spans: Mapping[int, Span] = EMPTY
    """The source map: for each line of ``text``, counted from 1, the part of the material that its
    statement belongs to. Every statement has one."""
    sources: tuple[Source, ...] = ()
    """The files that line directives in ``text`` name; their numbers count from 1."""


@frozen
class CompiledMaterial:
    """The results of compiling one material."""

    name: str
    stem: str
    """The beginning of its files' names: its own name, and those of a pass and a rig that were
    named, unless they would draw it in any case. That of the reflection is ``STEM.json``."""
    files: tuple[OutputFile, ...]
    lacking: Mapping[str, str]
    """For each profile without texts, the feature that it lacks and the material needs."""
    guards: tuple[Guard, ...]
    """Operations that keep a guard in some text, because their operands could not be proven
    safe."""
    _place: PlaceOfGraphs
    """Where the graphs are, which ``graphs.py`` drops, and makes again when they are asked for."""

    def __repr__(self) -> str:
        """The material with the names of its files, since the whole shader would fill pages."""
        return f"<CompiledMaterial {self.name}: {', '.join(file.name for file in self.files)}>"

    def text(self, target: str, stage: FileStage) -> str:
        """The text of one stage for one target (``"glsl"`` or ``"glsl:gl330"``).

        Raises ``KeyError`` if the material was not compiled for it.
        """
        for file in self.files:
            if file.stage == stage and target in (file.target, f"{file.target}:{file.profile}"):
                return file.text
        raise KeyError(f"{self.name} has no {stage} text for {target}")

    @cached_property
    @seldom_collected
    def reflection(self) -> Reflection:
        """The data that a host needs to bind; ``to_json`` makes data for JSON of it."""
        from ..compiler.reflection import reflect

        graphs = self._place.graphs()
        rows = {
            full_name(legal.language, legal.profile): backend_row(
                legal.program, legal.language, legal.profile, emission,
                self._files(legal.language, legal.profile),
                front=graphs.shader.render_state.front,
                flip_y=full_name(legal.language, legal.profile) in graphs.flipped,
                source_maps=self._source_maps(legal.language, legal.profile),
            )
            for legal, emission in graphs.emissions
        }  # fmt: skip
        derived = {value.parameter: value.expression for value in graphs.staged.derived}
        # The vertex inputs that a storage buffer replaces are known after the passes.
        last = graphs.staged.program.shader
        bound = changed(
            graphs.shader,
            parameters=last.parameters, attributes=last.attributes, buffers=last.buffers,
        )  # fmt: skip
        return reflect(bound, graphs.staged.program, rows, derived)

    @property
    def shader(self) -> Shader:
        """The shader before any pass, which the reference draws.

        One with a geometry stage it does not draw, but the same material compiled without. A kernel
        over images it draws as a full-screen pass.
        """
        return self._place.graphs().shader

    @property
    def staged(self) -> Staged:
        """The program that is written in each language, with the passes' decision records."""
        return self._place.graphs().staged

    @cached_property
    def proofs(self) -> tuple[Proof, ...]:
        """The proofs for operations without a guard, and the reasons for guards that stay."""
        from ..compiler.passes.proofs import Proofs

        evidence = self.staged.evidence
        return tuple(Proofs(evidence.ranges, evidence.notes).explain(evidence.remarks))

    @cached_property
    def removals(self) -> tuple[Removal, ...]:
        """What the shader does not compute, as values of parameters make it dead; and why."""
        from ..compiler.passes.removals import Removals

        staged = self.staged
        evidence = staged.evidence
        outside = [*staged.program.shader.roots, *(each.expression for each in staged.derived)]
        read = {node.data.name for node in reachable(outside) if isinstance(node.data, Leaf)}
        return tuple(Removals(evidence.ranges, evidence.first_notes, evidence.before, read).told())

    def emitted(self, profile: str) -> Shader:
        """The graph that the texts for a profile (``glsl:es300``) compute, as a shader.

        Raises ``KeyError`` if the material has no texts for it.
        """
        from ..targets.legalise.emitted import emitted

        for legal, _emission in self._place.graphs().emissions:
            if full_name(legal.language, legal.profile) == profile:
                return emitted(legal)
        raise KeyError(f"{self.name} has no texts for {profile}")

    def __reduce__(self) -> tuple[Any, ...]:
        """Pickle the record without graphs, but with what has been computed of them."""
        return CompiledMaterial, tuple(getattr(self, n) for n in self.__match_args__), self.__dict__

    def instance(self) -> Instance:
        """An instance with named values to draw the material with; they start as its defaults."""
        from ..targets.runner.instances.instance import Instance

        return Instance(self.reflection)

    def _source_maps(self, target: Language, profile: Profile) -> dict[str, Mapping[int, Span]]:
        return {
            file.name: file.spans
            for file in self.files
            if (file.target, file.profile) == (target.name, profile.name)
        }

    def _files(self, target: Language, profile: Profile) -> dict[str, str]:
        return {
            file.stage: file.name
            for file in self.files
            if (file.target, file.profile) == (target.name, profile.name)
        }


@frozen
class CompiledFrame:
    """The results of compiling one frame."""

    name: str
    stem: str
    """The beginning of its plan's file: ``STEM.plan.json``; it may name a rig, as in materials."""
    shaders: tuple[CompiledMaterial, ...]
    """The shaders, in the order of the plan's ``shaders``: one for each pass with each material and
    its lights, and one for each kernel."""
    _graphs: KeptGraphs
    """The graphs of the result, to which the frame belongs."""
    _number: int
    """The position of the frame among those of the result."""

    def __repr__(self) -> str:
        """The frame with the names of its shaders."""
        return f"<CompiledFrame {self.name}: {', '.join(shader.name for shader in self.shaders)}>"

    @property
    def frame(self) -> Frame:
        """The checked frame, which the reference draws."""
        return self._graphs.graphs().frames[self._number]

    @cached_property
    def plan(self) -> FramePlan:
        """The steps by which a host draws the frame; ``to_json`` makes data for JSON of it."""
        return self._planned(shares=True)

    @cached_property
    def plan_of_reference(self) -> FramePlan:
        """The plan that the reference executes for ``conform``: every result has its own texture.

        So nothing that is wrong with ``plan`` is wrong here as well.
        """
        return self._planned(shares=False)

    def _planned(self, *, shares: bool) -> FramePlan:
        from ..compiler.planning.plan import plan
        from ..compiler.reflection.plan import plan_document

        found = plan(self.frame, shares=shares)
        return plan_document(found, [f"{shader.stem}.json" for shader in self.shaders])


@frozen
class CompileResult:
    """All materials of a file, with the diagnostics (only warnings, since it compiled)."""

    materials: tuple[CompiledMaterial, ...]
    """The materials; for a file with frames, their shaders."""
    diagnostics: tuple[Diagnostic, ...]
    inputs: Inputs
    """The files that were read, and the places where files were searched."""
    frames: tuple[CompiledFrame, ...] = ()

    def __iter__(self) -> Iterator[CompiledMaterial]:
        """The materials in the order of the file."""
        return iter(self.materials)

    def __len__(self) -> int:
        """The number of materials."""
        return len(self.materials)

    def __getitem__(self, name: str) -> CompiledMaterial:
        """The material called ``name``; ``KeyError`` if there is none."""
        for material in self.materials:
            if material.name == name:
                return material
        raise KeyError(name)
