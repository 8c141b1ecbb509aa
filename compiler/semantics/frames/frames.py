"""A frame declaration as a checked ``Frame``: its steps, in an order in which they can be drawn.

``Frontend`` calls ``frame_of`` for each frame of a file that is not abstract.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from ....support.frozen import frozen
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label, Report
from ...ir.frame import Elements, Frame, FrameOutput, Models, Step, StepTexture
from ...ir.shader import BufferInfo, TextureInfo
from ...syntax import ast
from ..checking.expressions import RULES
from ..checking.slots import slot
from ..checking.step_needs import Dependencies, Need
from ..checking.unknown_names import unknown
from ..declarations.parameters import Leaves, all_parameters, leaves_of, of_kind
from ..inheritance.flattening import Records, root_of
from ..inheritance.records import Record
from ..inheritance.ties import draws_as, tie_of
from ..lowering.outlining import lowered
from ..names.modules import Module, Symbol
from ..shading.host_names import Entry, names_taken
from ..shading.instances import instance_of
from ..shading.rigs import entries_of
from ..shading.room import has_room
from ..shading.unread_slots import NamedIn, warn_of_unread
from ..state.context import Context
from ..state.scope import FAILURE, OUTERMOST, Instance
from .invariance import with_invariant_positions
from .pass_draws import ModelsOf
from .samples import check_readable
from .shaders import Shaders
from .step_context import EquationOwner, StepContext
from .steps import Steps
from .values import no_result


@frozen
class Surroundings:
    """The surroundings in which a frame is checked."""

    module: Module
    rig: Symbol
    report: Report
    records: Records
    reached: set[Symbol]
    """Gets every declaration that was checked on the way."""


def frame_of(symbol: Symbol, around: Surroundings) -> Frame | None:
    """The frame that a declaration says, or ``None`` after reporting why there is none."""
    if not has_room(symbol, around.records, around.report):
        return None
    return _Checking(symbol, around).frame()


class _Checking:
    def __init__(self, symbol: Symbol, around: Surroundings) -> None:
        self._symbol = symbol
        self._around = around
        self._ctx = ctx = Context(around.report, around.records, RULES)
        self._record: Record = around.records.of(symbol)
        self._leaves: Leaves = leaves_of(ctx, self._record)
        self._instance: Instance = instance_of(ctx, self._record, self._leaves)
        taken = names_taken((self._leaves,), symbol.module)
        self._entries: list[Entry] = entries_of(ctx, around.rig, taken)
        lights = dict(self._single_lights())
        ctx.lights.named.update((name, light.instance) for name, light in lights.items())
        self._models = self._all_models()
        root = root_of(symbol.module, "material")
        assert root is not None
        shaders = Shaders(
            symbol.name, around.module, around.rig, root, around.report, around.records,
            around.reached,
        )  # fmt: skip
        self._shaders = shaders
        self._own = EquationOwner(self._instance, Dependencies(self._record, around.report))
        for each in (self._own, *lights.values()):
            ctx.is_step[each.instance] = each.dependencies.is_step
        self._steps = Steps(ctx, self._own, lights, shaders, self._models)

    def frame(self) -> Frame | None:
        declaration, ctx = self._symbol.declaration, self._ctx
        assert isinstance(declaration, ast.Record)
        self._around.reached.add(self._symbol)
        outputs = list(self._outputs())
        needed = tuple(self._steps.steps)
        written = list(self._record.every(ast.Output))
        self._check_rest(are_whole=0 < len(outputs) == len(written))
        self._steps.settle_previous()
        ctx.deferred.report()
        self._check_ties()
        if not written and not self._record.baseless and not ctx.report.unread_names:
            ctx.report.add(rules.NO_OUTPUT, declaration.name.span, name=self._symbol.name)
        self._around.reached.update(ctx.reached())
        if ctx.report.failed:
            return None
        return self._made(declaration, outputs, needed)

    def _made(
        self, declaration: ast.Record, outputs: list[FrameOutput], needed: tuple[Step, ...]
    ) -> Frame:
        of_lights = [info for _, leaves in self._entries for info in leaves]
        values, _graph, _notes = lowered(self._ctx, self._steps.numbers.nodes)
        used = {use.shader for step in needed for use in step.uses}
        drawn = [shader for shader in self._shaders.made if shader in used]
        shaders, steps = with_invariant_positions(drawn, needed)
        return Frame(
            name=self._symbol.name,
            doc=declaration.doc,
            span=declaration.name.span,
            rig=self._around.rig.name,
            values=tuple(values),
            parameters=all_parameters((*self._leaves, *of_lights), self._ctx.externs.infos),
            textures=of_kind(TextureInfo, self._leaves),
            buffers=of_kind(BufferInfo, self._leaves),
            models=tuple(
                Models(name, tuple(m.name for m in each.materials), each.member.doc,
                       each.member.name.span)
                for name, each in self._models.items()
            ),
            shaders=shaders,
            steps=steps,
            outputs=tuple(outputs),
        )  # fmt: skip

    # --- the draws of the frame, and their lights ---

    def _check_ties(self) -> None:
        """Warn of materials that no step draws by the pass to which they are tied."""
        passes: dict[Symbol, list[Symbol]] = {}
        for key in self._shaders.known:
            if key.material is not None:
                passes.setdefault(key.material, []).append(key.step)
        records, report = self._around.records, self._ctx.report
        for material, drawn_by in passes.items():
            tie = tie_of(material, records, report)
            if tie is None or any(draws_as(each, tie, records) for each in drawn_by):
                continue
            report.add(
                rules.NOT_BY_ITS_PASS, self._symbol.declaration.name.span,
                name=material.name, tied=tie.pass_.name,
                labels=[Label(tie.name.span, "this is its pass")],
            )  # fmt: skip

    def _single_lights(self) -> Iterator[tuple[str, EquationOwner]]:
        for entry, leaves in self._entries:
            if entry.kind == "single":
                light = instance_of(self._ctx, entry.record, leaves)
                light.replaced.update(entry.replaced)
                overrides = {
                    name: each.definition
                    for name, each in entry.replaced.items()
                    if each.definition is not None
                }
                dependencies = Dependencies(entry.record, self._ctx.report, overrides)
                yield entry.short_name, EquationOwner(light, dependencies, entry.short_name)

    def _all_models(self) -> dict[str, ModelsOf]:
        return {
            member.name.text: ModelsOf(member, self._materials(member, owner))
            for member, owner, _level in self._record.every(ast.Models)
        }

    def _materials(self, member: ast.Models, owner: Symbol) -> tuple[Symbol, ...]:
        """The materials of the file, own ones and imported ones, that models may have."""
        module = self._around.module
        visible = [*module.declared.values(), *module.imported.values()]
        every = [symbols[0] for symbols in visible if _is_material(symbols[0])]
        base = member.material
        if base is not None:
            symbols = owner.module.find(base.text)
            if not symbols or not _is_record(symbols[0], "material"):
                known = [symbol.name for symbol in every]
                unknown(self._ctx, "material", base.text, base.span, known)
                return ()
            every = [s for s in every if symbols[0] in self._ctx.records.of(s).chain]
        if not every:
            self._ctx.report.add(rules.NO_MATERIAL_TO_DRAW, member.name.span, name=member.name.text)
        return tuple(every)

    # --- steps ---

    def _outputs(self) -> Iterator[FrameOutput]:
        """The outputs, with all steps that they need."""
        written = list(self._record.every(ast.Output))
        needs = (self._own.dependencies.needs(member.value, level) for member, _, level in written)
        self._steps.check(self._own, list(chain.from_iterable(needs)))
        for member, owner, level in written:
            around = StepContext(self._own, self._own.scope(owner, level), member.name.text)
            made = self._steps.made(member.value, around)
            if isinstance(made, StepTexture | Elements):
                check_readable(self._ctx.report, made, member.value.span)
                yield FrameOutput(member.name.text, made, member.doc, member.name.span)
            else:
                no_result(self._ctx, made, member.value.span)

    def _check_rest(self, *, are_whole: bool) -> None:
        """Checks the slots that no output needs: other steps, and numbers.

        Unless all outputs ``are_whole``, nobody knows what they would need, so nothing is said of
        steps that seem to be too many.
        """
        for name, definitions in self._record.definitions.items():
            member = definitions[0].member
            if not isinstance(member, ast.Slot):
                continue
            key, span = (name, OUTERMOST), member.name.span
            if not self._is_step(name):
                slot(self._ctx, self._instance, name, span)
            elif key not in self._own.values:
                self._steps.check(self._own, [Need(key, span, before=True)])
                if definitions[0].owner.module is self._around.module and are_whole:
                    self._warn(name, member)
        told = {name for name in self._record.definitions if self._is_step(name)}
        told |= {name for (name, _), value in self._instance.values.items() if value is FAILURE}
        warn_of_unread(self._ctx, self._record, told, beside=NamedIn(self._record.symbol.module))

    def _is_step(self, name: str) -> bool:
        return self._own.dependencies.is_step((name, OUTERMOST))

    def _warn(self, name: str, member: ast.ReadMember) -> None:
        self._ctx.report.add(rules.NOT_NEEDED, member.name.span, name=name)


def _is_record(symbol: Symbol, kind: str) -> bool:
    declaration = symbol.declaration
    return isinstance(declaration, ast.Record) and declaration.kind == kind


def _is_material(symbol: Symbol) -> bool:
    """True if a symbol is a material that can be drawn."""
    declaration = symbol.declaration
    return (
        isinstance(declaration, ast.Record)
        and _is_record(symbol, "material")
        and (not declaration.abstract)
    )
