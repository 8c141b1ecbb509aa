"""The facts about a program of a page: the types and values of its equations, and its diagnostics.

``claims.py`` compares the marks with them. Types are those of the type checker, values those of the
reference evaluator, and diagnostics those of ``burnish check``.
"""

from __future__ import annotations

from dataclasses import dataclass

import burnish
from burnish.compiler.diagnostics.diagnostic import Diagnostic, Report
from burnish.compiler.frontend import Frontend
from burnish.compiler.ir.meaning import Meaning
from burnish.compiler.ir.node import Node
from burnish.compiler.ir.types import Array, Struct, Type
from burnish.compiler.reference.evaluate import evaluate
from burnish.compiler.reference.namespace import Lanes
from burnish.compiler.reference.operations import NotConstantError
from burnish.compiler.semantics.checking.slots import slot
from burnish.compiler.semantics.inheritance.flattening import Records
from burnish.compiler.semantics.lowering.outlining import lowered
from burnish.compiler.semantics.names.modules import Module, Symbol
from burnish.compiler.semantics.shading.assembly import Parts, set_up
from burnish.compiler.syntax import ast


@dataclass(frozen=True)
class Equation:
    """The type and the value of one equation of a material."""

    name: str
    type: str
    """The type as diagnostics name it; empty if the equation is wrong."""
    value: Lanes | None
    """The value; ``None`` if the equation is wrong, or reads what only a host or a mesh knows."""


def equations(program: str) -> dict[int, Equation]:
    """The equations of a program's materials, by the lines on which they end, from 1.

    If several end on one line, the last one is given.
    """
    report = Report()
    module = Frontend(report).open_text(program, "<page>")
    found: dict[int, Equation] = {}
    for symbols in () if module is None else module.declared.values():
        for symbol in symbols:
            assert module is not None
            if isinstance(symbol.declaration, ast.Record) and symbol.declaration.kind == "material":
                found.update(_of_material(module, symbol, symbol.declaration))
    return found


def _of_material(module: Module, symbol: Symbol, record: ast.Record) -> dict[int, Equation]:
    """The equations of one material, as they are under the library's lights and pass."""
    (rig,), (pass_,) = module.find("Daylight"), module.find("Forward")
    report = Report()
    setting = set_up(Parts(symbol, rig, pass_, module), report, Records(report))
    found = {}
    for member in record.members:
        if isinstance(member, ast.Slot) and member.value is not None:
            name, end = member.name, member.value.span
            line, _column = end.source.position(end.end)
            node = slot(setting.ctx, setting.surface, name.text, name.span)
            if isinstance(node, Node):
                type_ = type_name(node.type, setting.ctx.meanings.of(node))
                (root,), _graph, _notes = lowered(setting.ctx, [node])
                found[line] = Equation(name.text, type_, _value(root))
            else:
                found[line] = Equation(name.text, "", None)
    return found


def type_name(type_: Type, meaning: Meaning | None) -> str:
    """A type as it is written in the language; the meaning of an array is that of its elements."""
    if isinstance(type_, Array):
        return f"{type_name(type_.element, meaning)}[{type_.count}]"
    return str(type_ if meaning is None or isinstance(type_, Struct) else meaning)


def _value(root: Node) -> Lanes | None:
    try:
        return evaluate(root)
    except NotConstantError:
        return None


def diagnostics(program: str) -> dict[int, list[Diagnostic]]:
    """The diagnostics of ``burnish check``, by lines from 1; line 0 has what is about no line."""
    found: dict[int, list[Diagnostic]] = {}
    for diagnostic in burnish.check(program):
        span = diagnostic.span
        line = 0 if span is None else span.source.position(span.start)[0]
        found.setdefault(line, []).append(diagnostic)
    return found
