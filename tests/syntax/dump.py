"""Prints expressions and declarations with all parentheses, for tests of the parser."""

from __future__ import annotations

from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.diagnostics.source import Source
from burnish.compiler.semantics.types.typenames import described
from burnish.compiler.syntax import ast
from burnish.compiler.syntax.parser import parse


def parsed(text: str) -> ast.File:
    """The tree of a text that has no mistakes."""
    report = Report()
    file = parse(Source("test.burnish", text), report)
    assert [found.message for found in report.diagnostics] == []
    return file


def messages(text: str) -> list[str]:
    """The messages about a text."""
    report = Report()
    parse(Source("test.burnish", text), report)
    return [found.message for found in report.diagnostics]


def expression(text: str) -> str:
    """The tree of an expression, printed."""
    (constant,) = parsed(f"value = {text}").declarations
    assert isinstance(constant, ast.Constant)
    return show(constant.value)


def show(node: ast.Expression) -> str:  # noqa: PLR0912
    """``node`` with all its parentheses."""
    match node:
        case ast.Number(text=text, kind=kind, unit=unit):
            return f"{text}{unit or ('u' if kind == 'uint' else '')}"
        case ast.Color(channels=channels):
            return f"color{channels}"
        case ast.Boolean(value=value):
            return str(value).lower()
        case ast.Reference(name=name):
            return name
        case ast.Unary(operator=operator, operand=operand):
            return f"({operator} {show(operand)})"
        case ast.Binary(operator=operator, left=left, right=right):
            return f"({show(left)} {operator} {show(right)})"
        case ast.Conditional(condition=condition, then=then, otherwise=otherwise):
            return f"(if {show(condition)} then {show(then)} else {show(otherwise)})"
        case ast.Call(callee=callee, arguments=arguments):
            return f"{show(callee)}({', '.join(map(show, arguments))})"
        case ast.Field(operand=operand, name=name):
            return f"{show(operand)}.{name.text}"
        case ast.Index(operand=operand, index=index):
            return f"{show(operand)}[{show(index)}]"
        case ast.With(operand=operand, replacements=replacements):
            slots = ", ".join(f"{name.text} = {show(value)}" for name, value in replacements)
            return f"({show(operand)} with {{{slots}}})"
        case ast.Conversion(operand=operand, space=space):
            return f"({show(operand)} in {space.text})"
        case ast.Ascription(operand=operand, type=kind):
            return f"({show(operand)} as {described(kind)})"
        case ast.AtRate(rate=rate, operand=operand):
            return f"(@{rate.text} {show(operand)})"
        case ast.Array(elements=elements):
            return f"[{', '.join(map(show, elements))}]"
        case ast.Fold(operator=operator, turns=turns, initial=initial, body=body):
            first = "" if initial is None else f" from {show(initial)}"
            return f"({operator} {_turns(turns)}{first} : {show(body)})"
        case ast.FoldOver(operator=operator, variable=variable, over=whole, body=body):
            return f"({operator} {variable.text} in {show(whole)} : {show(body)})"
        case ast.Iterate(state=state, initial=initial, turns=turns, condition=c, body=body):
            going_on = "" if c is None else f" while {show(c)}"
            over = f"for {_turns(turns)}" if turns.variable.text else f"up to {show(turns.end)}"
            return f"(iterate {state.text} from {show(initial)} {over}{going_on} : {show(body)})"


def _turns(turns: ast.Turns) -> str:
    most = "" if turns.most is None else f" up to {show(turns.most)}"
    return f"{turns.variable.text} in {show(turns.start)}..{show(turns.end)}{most}"
