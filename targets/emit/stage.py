"""Prints one stage: its functions, the body of its entry point, its inputs and outputs.

The emitter makes a ``StagePrinter`` for each stage of a program, and hands the ``EntryView`` that
it returns to the skeleton.
"""

from __future__ import annotations

from collections.abc import Iterator

from ...compiler.ir.node import Node, reachable
from ...compiler.ir.operations import INPUT
from ...compiler.ir.program import Function, Output, Stage
from ...compiler.ir.scattering import Scattered
from ...compiler.ir.shader import Store
from ...compiler.ir.stages import (
    CLIP_POSITION,
    DISCARD,
    EDGE_LEVEL,
    EXTENT,
    FRAGMENT_DEPTH,
    IMAGE,
    INNER_LEVEL,
    LAYER,
    STORE,
    SystemInput,
    inputs_of,
)
from ...compiler.ir.storage import stored_element
from ...compiler.ir.types import Array, Struct
from .comments import comment_lines
from .context import Context
from .declarations import Declarations
from .expressions import Expressions
from .fields import Fields
from .group_functions import GroupFunctions
from .leaves import LeafPrinter
from .namer import Namer
from .natives import EmittedFunction, Natives
from .origins import Mark, Marks
from .precedence import NAME
from .statements import INDENT, Statements
from .views import EntryView, ExpansionView, FunctionView, InputView, StoreView

LEVELS = (EDGE_LEVEL, INNER_LEVEL)
PLACED = (*LEVELS, CLIP_POSITION, DISCARD, EXTENT, FRAGMENT_DEPTH, IMAGE, LAYER)
"""The kinds of results for which skeletons have other places than outputs."""


class StagePrinter:
    """Makes the view of one stage's entry point."""

    def __init__(
        self,
        context: Context,
        declarations: Declarations,
        stage: Stage,
        marks: Marks,
    ) -> None:
        names = context.names
        self._context = context
        self._declarations = declarations
        self._stage = stage
        self._language = context.language
        self._names = names
        self._types = context.types
        self._leaves = LeafPrinter(context, stage)
        self._fields = Fields(context, stage)
        self._functions = {
            function.body: EmittedFunction(
                names.function(stage.name, function.body),
                declarations.arguments(context.passed(stage.name, function.body)),
            )
            for function in stage.functions
        }
        self._groups = GroupFunctions(context, stage, marks)
        self._natives = Natives(context, self._leaves, self._functions, self._groups)
        self._marks = marks
        self._index = ""
        """The name of the index of a kernel's element."""

    def entry(self, name: str) -> EntryView:
        """The entry point, called ``name``."""
        stage = self._stage
        namer = self._locals()
        expressions, statements = self._body(namer, self._marks.mark)
        extent = stage.value_of(EXTENT)
        opening = self._opening(namer, expressions, extent)
        functions = [self._function(function) for function in stage.functions]
        guard = "" if self._groups else self._guard(expressions, extent)
        group = self._context.program.shader.work_group
        if stage.emitted:
            from .strips import Strips

            strips = Strips(self._context, expressions, namer, self._marks.mark)
            lines = strips.emitted(stage, self._delivered)
        else:
            lines = statements.lines(stage.region)
        for output in stage.results:
            if output.field is None and output.store is None and output.kind not in PLACED:
                raise NotImplementedError(f"no skeleton writes a {output.kind}")
        return EntryView(
            stage=stage.name,
            name=name,
            inputs=self._fields.inputs,
            pipeline_inputs=self._pipeline_inputs(),
            outputs=self._fields.outputs,
            blocks=self._declarations.blocks((stage,)),
            buffers=self._declarations.buffers((stage,)),
            images=self._declarations.images((stage,)),
            textures=self._declarations.textures((stage,)),
            functions=[*self._groups.views(self._natives), *functions],
            lines=lines,
            shared=self._groups.shared,
            stores=[] if stage.emitted else list(self._stores(expressions)),
            written=list(self._written(expressions)),
            position=""
            if stage.emitted
            else self._value(expressions, stage.value_of(CLIP_POSITION)),
            invariant=self._context.program.shader.render_state.is_invariant,
            opening=opening,
            guard=guard,
            work_group=() if group is None else group,
            depth=self._value(expressions, stage.value_of(FRAGMENT_DEPTH)),
            discard=self._discard(expressions, stage.value_of(DISCARD)),
            capture_stride=self._fields.capture_stride(),
            expansion=self._expansion(),
            tessellation=self._fields.tessellation(),
        )

    def _expansion(self) -> ExpansionView | None:
        """The declaration of the primitives that a geometry stage gets and emits; else ``None``."""
        expansion = self._context.program.shader.expansion
        if not self._stage.emitted or expansion is None:
            return None
        primitive = self._language.primitives[expansion.primitive]
        is_layered = self._stage.value_of(LAYER) is not None
        emitted = self._language.emitted[expansion.emits]
        places = bool(self._stage.results_of(CLIP_POSITION))
        return ExpansionView(
            primitive, expansion.corners, emitted, places, expansion.vertices, is_layered
        )

    def _delivered(self, output: Output, value: str) -> Iterator[str]:
        """The lines that give an emitted vertex one of its outputs."""
        forms, framebuffer = self._language.forms, self._context.profile.framebuffer
        if output.field is not None:
            name = self._fields.name_of(output)
            yield forms.deliver.format(name=name, value=value)
            return
        if output.kind == LAYER:
            yield forms.deliver_layer.format(value=value)
            return
        position = forms.position
        yield forms.deliver_position.format(value=value)
        if framebuffer.clip_depth == "-1..1":
            yield f"{position}.z = 2.0 * {position}.z - {position}.w;"
        if self._context.flip_y:
            yield f"{position}.y = -{position}.y;"

    def _guard(self, expressions: Expressions, extent: Node | None) -> str:
        """The condition under which an invocation has no element to compute."""
        if extent is None:
            return ""
        return self._marks.mark(f"{self._index} >= {expressions.text(extent)}", extent)

    def _opening(self, namer: Namer, expressions: Expressions, extent: Node | None) -> list[str]:
        """The first statements of a kernel, which name the index of its element or its texel.

        They also compute other numbers by which its invocations differ. Other stages have none.
        """
        own = self._invocation
        if own is None:
            return []
        read, type_ = self._leaves.input(own)
        if read == own.name:
            namer.declare(read)
        self._index = namer.declare(own.name)
        for node in reachable(self._stage.roots):
            if node.op == "input" and INPUT.data(node).name == own.name:
                expressions.bound[node] = self._index, NAME
        if self._groups and extent is not None:
            count = self._marks.mark(expressions.text(extent), extent)
            return self._groups.opening(namer, self._natives, read, count, self._index)
        value = read if type_ == own.type else f"{self._types.type(own.type)}({read})"
        typed = self._types.declare(self._index, own.type)
        return [self._language.forms.let.format(typed=typed, name=self._index, value=value)]

    def _written(self, expressions: Expressions) -> Iterator[str]:
        """The lines by which an invocation of a kernel writes its results."""
        if self._invocation is None:
            return
        lines = list(self._all_written(expressions))
        if not self._groups:
            yield from lines
            return
        forms = self._language.forms
        yield forms.if_.format(condition=self._groups.has_element)
        yield from (INDENT + line for line in lines)
        yield forms.end

    def _all_written(self, expressions: Expressions) -> Iterator[str]:
        forms = self._language.forms
        of_groups = []
        for output in self._stage.results:
            if output.store is None or output.kind != STORE:
                continue
            store = self._store(expressions, output.store, output.value)
            line = forms.assign.format(name=store.name, value=store.value)
            if output.store.of_group > 1:
                of_groups.append((output.store.of_group, line))
            else:
                yield line
        yield from self._texels(expressions)
        for each in self._stage.scattered:
            yield from self._scattered(expressions, each)
        if of_groups:
            size, _ = of_groups[0]
            yield forms.if_.format(condition=f"{self._index} % {size} == 0")
            yield from (INDENT + line for _, line in of_groups)
            yield forms.end

    @property
    def _invocation(self) -> SystemInput | None:
        """The number or texel by which a kernel's invocations differ; ``None`` in other stages."""
        if self._context.program.shader.work_group is None:
            return None
        return inputs_of((self._stage.row,))["texel" if self._stage.images else "index"]

    def _texels(self, expressions: Expressions) -> Iterator[str]:
        """The lines that write the texels of a kernel's images."""
        for output in self._stage.results:
            if output.image is not None:
                text = self._language.forms.store_texel.format(
                    name=self._names.images[output.image.name],
                    place=self._index,
                    value=expressions.text(output.value),
                )
                yield self._marks.mark(text, output.value)

    def _stores(self, expressions: Expressions) -> Iterator[StoreView]:
        """The assignments at the end of the entry point: outputs, and levels of a patch."""
        placed = [output for output in self._stage.results if output.field is not None]
        for field, output in zip(self._fields.delivered, placed, strict=True):
            yield StoreView(field.name, self._value(expressions, output.value))
        forms = self._language.forms
        for kind, form in zip(LEVELS, (forms.edge_level, forms.inner_level), strict=True):
            for number, output in enumerate(self._stage.results_of(kind)):
                yield StoreView(form.format(number=number), self._value(expressions, output.value))

    def _store(self, expressions: Expressions, store: Store, value: Node) -> StoreView:
        """The part of an element that is written, and its value."""
        place = self._index
        if store.of_group > 1:
            place = f"{place} / {store.of_group}"
        if store.stride > 1:
            place = f"{place} * {store.stride}"
            place += f" + {store.offset}" if store.offset else ""
        text = f"{self._names.buffers[store.buffer.name]}[{place}]"
        owner = stored_element(store.buffer.type.element)
        for step in store.path:
            if isinstance(step, int):
                assert isinstance(owner, Array)
                text, owner = f"{text}[{step}]", owner.element
            else:
                assert isinstance(owner, Struct)
                text = f"{text}.{self._names.member(owner.name, step)}"
                owner = owner.member(step)
        return StoreView(text, self._value(expressions, value))

    def _scattered(self, expressions: Expressions, scattered: Scattered) -> Iterator[str]:
        """The lines that join a value with an element of the invocation's choice."""
        language, store = self._language, scattered.store
        assert store.operator is not None
        name = self._names.buffers[store.buffer.name]
        line = language.forms.scatter.format(
            function=language.atomics[store.operator],
            place=f"{name}[{expressions.text(scattered.place)}]",
            value=expressions.text(scattered.value),
        )
        joined = self._marks.mark(line, scattered.value)
        if scattered.condition.op == "constant":
            yield from [joined] if scattered.condition.data else []
            return
        test = language.forms.if_.format(condition=expressions.text(scattered.condition))
        yield self._marks.mark(test, scattered.condition)
        yield INDENT + joined
        yield language.forms.end

    def _discard(self, expressions: Expressions, condition: Node | None) -> list[str]:
        if condition is None:
            return []
        forms = self._language.forms
        test = forms.if_.format(condition=expressions.text(condition))
        return [self._marks.mark(test, condition), INDENT + forms.discard, forms.end]

    def _body(self, namer: Namer, mark: Mark) -> tuple[Expressions, Statements]:
        """The two printers that every function body needs."""
        expressions = Expressions(self._context, self._leaves, self._natives, self._functions)
        return expressions, Statements(self._context, expressions, namer, mark)

    def _value(self, expressions: Expressions, node: Node | None) -> str:
        """A value that a statement in the skeleton uses; empty if there is none."""
        return "" if node is None else self._marks.mark(expressions.text(node), node)

    def _function(self, function: Function) -> FunctionView:
        namer = self._locals()
        mark = self._marks.of(function)
        expressions, statements = self._body(namer, mark)
        forms = self._language.forms
        names = [namer.declare(formal.name) for formal, _type in function.parameters]
        for name, (formal, _type) in zip(names, function.parameters, strict=True):
            expressions.formals[formal] = name
        types = [type_ for _formal, type_ in function.parameters]
        lines = statements.lines(function.region)
        passed = self._declarations.parameters(
            self._context.passed(self._stage.name, function.body)
        )
        own = (
            forms.parameter.format(typed=self._types.declare(name, type_))
            for name, type_ in zip(names, types, strict=True)
        )
        returned = forms.return_.format(value=expressions.text(function.value))
        return FunctionView(
            comments=comment_lines(function.doc),
            head=forms.function.format(
                type=self._types.type(function.value.type),
                name=self._names.function(self._stage.name, function.body),
                parameters=", ".join([*passed, *own]),
            ),
            lines=[*lines, mark(returned, function.value)],
        )

    def _locals(self) -> Namer:
        """A namer for locals, which never hide declarations of the stage's file."""
        if not self._language.global_fields:
            return self._names.locals(())
        return self._names.locals(self._fields.names())

    def _supplied(self) -> tuple[str, ...]:
        """The pipeline's values that the entry point reads; a kernel always reads its index."""
        own, invocation = self._stage.builtin_inputs, self._invocation
        missing = invocation is not None and invocation.name not in own
        return (invocation.name, *own) if invocation and missing else own

    def _pipeline_inputs(self) -> list[InputView]:
        inputs = self._context.dialect.inputs
        return [
            InputView(self._types.declare(name, row.type), row.semantic)
            for name in self._supplied()
            if (row := inputs[name]).semantic
        ]
