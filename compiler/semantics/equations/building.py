"""Builds the graph of a material's own equations, of syntax that has been checked.

``Frontend`` calls ``equations_of`` for a material that it has elaborated. Each declaration of the
material is one node, and so is each operation in an equation; the outermost operation shares the
node of its equation. What a base, a mixin or the library declares is folded into one node.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain, count

from ....support.frozen import EMPTY, changed
from ...diagnostics.source import Span
from ...ir.node import Node
from ...ir.stages import CLIP_POSITION
from ...ir.types import Array
from ...syntax import ast
from ..inheritance.records import Definition
from ..shading.assembly import Setting
from ..state.context import Context
from ..state.scope import OUTERMOST
from .model import EquationNode, Equations, NodeKind, Row
from .operations import ConstantForm, Form, InRow, Operation, Outside, SlotForm, operation
from .reads import Behind, Key, Where, is_knob, reads_of

LIGHTS, PASS = "lights", "pass"
"""The keys of the nodes of the rig and of the pass."""
_LEAVES: Mapping[type, NodeKind] = {
    ast.Param: "parameter", ast.Texture: "texture", ast.Buffer: "buffer",
    ast.Attribute: "attribute",
}  # fmt: skip
_READ_BY_PASS = (ast.Target, ast.Discard, ast.Depth, ast.Capture)
"""The members of a pass that read the material."""


def equations_of(setting: Setting) -> Equations:
    """The graph of a material, of which everything has been checked without errors."""
    return _Building(setting).equations()


class _Building:
    """The nodes of one material, as far as they have been made."""

    def __init__(self, setting: Setting) -> None:
        self._setting = setting
        self._surface = setting.surface
        self._record = setting.surface.record
        self._behind = Behind(setting.surface)
        self._types = _types(setting.ctx)
        self._where = Where(self._record.symbol.module, self._surface, self._surface)
        self._nodes: dict[str, EquationNode] = {}
        self._names = set(self._record.definitions)
        """The names that are taken, so that each name in a row is that of one node."""

    def equations(self) -> Equations:
        for definition in self._own():
            self._declare(definition)
        for statement in self._record.statements:
            if statement.level == 0 and isinstance(statement.member, ast.Expand | ast.Tessellate):
                self._state(statement.member)
        self._pass()
        parts, declaration = self._setting.parts, self._record.symbol.declaration
        assert isinstance(declaration, ast.Record)
        return Equations(
            self._record.name, declaration.doc, parts.pass_.name, parts.rig.name,
            tuple(_ordered(self._nodes)),
        )  # fmt: skip

    # --- declarations ----------------------------------------------------------------------------

    def _own(self) -> list[Definition]:
        """The definitions that the material itself has, in the order of the text."""
        nearest = (definitions[0] for definitions in self._record.definitions.values())
        own = (definition for definition in nearest if definition.level == 0)
        return sorted(own, key=lambda definition: definition.member.span.start)

    def _declare(self, definition: Definition) -> None:
        member, name = definition.member, definition.member.name
        key, type_ = name.text, self._type((name.text, OUTERMOST))
        if isinstance(member, ast.Slot):
            kind: NodeKind = "equation"
            node = EquationNode(key, kind, name.text, type_, member.doc, span=name.span)
            self._nodes[key] = node
            if member.value is not None:
                self._nodes[key] = self._filled(node, member.value)
        else:
            kind = _LEAVES[type(member)]
            text = _default(member)
            self._nodes[key] = EquationNode(
                key, kind, name.text, type_, member.doc, text, span=name.span
            )

    def _filled(self, node: EquationNode, written: ast.Expression) -> EquationNode:
        """The node of an equation, with the outermost operation of its expression."""
        form = operation(written, self._where)
        if isinstance(form, Operation):
            rows = self._rows(form)
            if _is_node(form, rows):
                doc = node.doc or form.doc
                return changed(node, note=form.name, rows=rows, text=form.text, doc=doc)
        row = self._source(written)
        return changed(node, rows=(row,)) if row.source else changed(node, text=row.words)

    def _state(self, member: ast.Expand | ast.Tessellate) -> None:
        """A member that reads slots, without a name that others read."""
        made = member.primitive if isinstance(member, ast.Expand) else member.patch
        word = "expand" if isinstance(member, ast.Expand) else "tessellate"
        name = self._new(f"{word} {made.text}")
        rows = tuple(map(self._slot, reads_of((member,), self._where).slots))
        self._nodes[name] = EquationNode(
            name, "statement", name, doc=member.doc, rows=rows, span=member.span
        )

    def _pass(self) -> None:
        """The pass, with rows for all that the material can change of what it reads."""
        passing = self._setting.passing
        texts = [s.member for s in passing.record.statements if isinstance(s.member, _READ_BY_PASS)]
        where = Where(passing.record.symbol.module, self._surface, passing)
        slots = dict.fromkeys(reads_of(texts, where).slots)
        if self._surface.has(CLIP_POSITION) and not passing.has(CLIP_POSITION):
            slots[CLIP_POSITION, OUTERMOST] = None
        rows = tuple(row for key in slots for row in self._folded_rows(key, with_knobs=True))
        self._nodes[PASS] = EquationNode(PASS, "pass", self._new(passing.record.name), rows=rows)

    # --- expressions -----------------------------------------------------------------------------

    def _source(self, written: ast.Expression) -> Row:
        """The row of whatever reads an expression, after making the nodes for it."""
        made: dict[int, Row] = {}
        forms: dict[int, Form] = {}
        pending = [written]
        while pending:
            e = pending[-1]
            if id(e) not in forms:
                forms[id(e)] = operation(e, self._where)
                pending += _operands(forms[id(e)])
                continue
            pending.pop()
            if id(e) not in made:
                made[id(e)] = self._row(e, forms[id(e)], made)
        return made[id(written)]

    def _row(self, e: ast.Expression, form: Form, made: Mapping[int, Row]) -> Row:
        match form:
            case ConstantForm(text=text):
                return Row("", text)
            case SlotForm(key=key):
                return self._slot(key)
            case Outside(name=name):
                self._nodes.setdefault(
                    name, EquationNode(name, form.kind, name, self._types.get(form.span, ""))
                )
                return Row("", name, name)
            case InRow(form=words, operand=operand):
                read = made[id(operand)]
                return Row("", words.format(read.words), read.source)
        rows = self._rows(form, made)
        if not _is_node(form, rows):
            return Row("", _plain(e))
        name = self._new(form.name)
        self._nodes[name] = EquationNode(
            name, form.kind, name, self._types.get(e.span, ""), form.doc, form.text,
            rows=rows, span=e.span,
        )  # fmt: skip
        return Row("", name, name)

    def _rows(self, form: Operation, made: Mapping[int, Row] = EMPTY) -> tuple[Row, ...]:
        """The rows of an operation: its operands, then what it reads besides, then the lights."""
        rows = [
            changed(made.get(id(operand)) or self._source(operand), label=label)
            for label, operand in form.operands
        ]
        if form.reads is not None:
            for key in form.reads.slots:
                rows += self._folded_rows(key) if form.is_called else [self._slot(key)]
            if form.reads.lights:
                rows.append(changed(self._lights(), label="each light"))
        return tuple(rows)

    # --- what is folded --------------------------------------------------------------------------

    def _folded_rows(self, key: Key, *, with_knobs: bool = False) -> Iterator[Row]:
        """The row of a slot that something folded reads, if the material says anything of it.

        Otherwise there is one only for a constant that it could set.
        """
        if self._behind.depends_on_own(key):
            yield changed(self._slot(key), label=key[0])
        elif with_knobs and is_knob(self._record.at(*key).member):
            yield Row(key[0], _default(self._record.at(*key).member))

    def _slot(self, key: Key) -> Row:
        """The row of whatever reads a slot; the first read makes a node of an inherited one."""
        definition = self._record.at(*key)
        if definition.level == 0:
            return Row("", key[0], key[0])
        owner, name = definition.owner.name, f"inherited.{key[0]}" if key[1] >= 0 else key[0]
        node_key = f"{owner}.{key[0]}"
        if node_key not in self._nodes:
            self._nodes[node_key] = EquationNode(node_key, "inherited", name)
            self._nodes[node_key] = self._inherited(node_key, name, key, definition)
        return Row("", name, node_key)

    def _inherited(
        self, node_key: str, name: str, key: Key, definition: Definition
    ) -> EquationNode:
        """What a base or a mixin declares, with rows for all that the material says of it."""
        member, note = definition.member, f"of {definition.owner.name}"
        kind, type_ = _LEAVES.get(type(member), "inherited"), self._type(key)
        if not self._behind.depends_on_own(key):
            text = _default(member) if is_knob(member) else ""
            return EquationNode(node_key, kind, name, type_, member.doc, text, note)
        ends = self._behind.of(key)
        rows = tuple(row for end in ends for row in self._folded_rows(end, with_knobs=True))
        return EquationNode(node_key, kind, name, type_, member.doc, note=note, rows=rows)

    def _lights(self) -> Row:
        rig = self._setting.parts.rig
        if LIGHTS not in self._nodes:
            lines = _entries(rig.declaration)
            name = self._new(rig.name)
            self._nodes[LIGHTS] = EquationNode(LIGHTS, "lights", name, lines=lines)
        return Row("", self._nodes[LIGHTS].name, LIGHTS)

    # --- names and types -------------------------------------------------------------------------

    def _new(self, name: str) -> str:
        """A name that no other node has."""
        numbered = chain((name,), (f"{name} {number}" for number in count(2)))
        found = next(each for each in numbered if each not in self._names)
        self._names.add(found)
        return found

    def _type(self, key: Key) -> str:
        """The type of a slot: as it is written, or as it was found."""
        typing = self._record.typing(key[0])
        if typing is not None and typing.member.type is not None:
            return " ".join(typing.member.type.span.text.split())
        value = self._surface.values.get(key)
        return _shown(self._setting.ctx, value) if isinstance(value, Node) else ""


def _operands(form: Form) -> Sequence[ast.Expression]:
    match form:
        case Operation(operands=operands):
            return [operand for _label, operand in reversed(operands)]
        case InRow(operand=operand):
            return (operand,)
        case _:
            return ()


def _is_node(form: Operation, rows: Sequence[Row]) -> bool:
    """True if an operation is worth a node: it reads one, or is the call of a file's function."""
    return form.is_called or any(row.source for row in rows)


def _plain(e: ast.Expression) -> str:
    """The text of an expression on one line."""
    return " ".join(e.span.text.split())


def _default(member: object) -> str:
    """The default of a parameter or a texture, or the constant of a slot."""
    match member:
        case ast.Param(default=e) | ast.Slot(value=e) if e is not None:
            return _plain(e)
        case ast.Texture(default=word) if word is not None:
            return word.text
        case _:
            return ""


def _entries(rig: object) -> tuple[str, ...]:
    """The lights of a rig, as they are written, without what is set for each."""
    if not isinstance(rig, ast.Rig):
        return ()
    number = {"one": "", "exactly": "[{}]", "at_most": "[<= {}]", "any": "[]"}
    return tuple(
        f"{entry.name.text} : {entry.light.text}"
        + number[entry.number].format("" if entry.count is None else _plain(entry.count))
        for entry in rig.entries
    )


def _types(ctx: Context) -> Mapping[Span, str]:
    """The types of all expressions, by their places."""
    return {span: _shown(ctx, ctx.tree.nodes[id_]) for id_, span in ctx.places.every()}


def _shown(ctx: Context, node: Node) -> str:
    """The type of a value, or its meaning, which says more."""
    meaning = ctx.meanings.of(node)
    if meaning is None or meaning.kind == "struct" or isinstance(node.type, Array):
        return str(node.type)
    return str(meaning)


def _ordered(nodes: Mapping[str, EquationNode]) -> Iterator[EquationNode]:
    """The nodes, each behind those that it reads, and otherwise as they were made."""
    done: set[str] = set()
    entered: set[str] = set()
    pending = list(nodes)[::-1]
    while pending:
        key = pending[-1]
        if key in done:
            pending.pop()
        elif key in entered:
            pending.pop()
            done.add(key)
            yield nodes[key]
        else:
            entered.add(key)
            pending += (row.source for row in reversed(nodes[key].rows) if row.source)
