"""Translates a skeleton to a function in Python, which fills it in without Jinja.

To import Jinja takes longer than to compile most materials. So ``templates.py`` has Jinja parse the
skeletons when the package is built, and this module translates the trees. A skeleton with other
features of Jinja than those that are translated here is left to Jinja itself: then ``translated``
raises ``UnsupportedError``.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from jinja2 import nodes

FILTERS = {"length": "len"}
"""Filters, with the functions of Python that do the same."""
PARAMETERS = ("file", "forms", "profile", "flip_y")
"""The variables of a skeleton."""
GLOBALS = ("joiner",)
"""Functions of Jinja that ``templates.py`` supplies."""

_INDENT = "    "
_COMPARISONS = {"eq": "==", "ne": "!=", "lt": "<", "lteq": "<=", "gt": ">", "gteq": ">="}

Lines = Iterator[str]


class UnsupportedError(Exception):
    """The skeleton uses a feature of Jinja that is not translated here."""


def translated(tree: nodes.Template, function: str) -> str:
    """The code of a function, which takes ``PARAMETERS`` and calls ``GLOBALS``."""
    _check_variables(tree)
    lines = [f"def {function}({', '.join(map(_variable, PARAMETERS))}):", *_body(tree.body)]
    return "\n".join(lines)


def _check_variables(tree: nodes.Template) -> None:
    """Raise ``UnsupportedError`` where Python's local variables would mean something else.

    Jinja forgets a loop's variables after each iteration. So a name may be set in one loop only, or
    outside of loops only, and no variable of a loop may hide another one.
    """
    known = {*PARAMETERS, *GLOBALS}
    known.update(name.name for name in tree.find_all(nodes.Name) if name.ctx != "load")
    known.update(macro.name for macro in tree.find_all(nodes.Macro))
    for used in tree.find_all(nodes.Name):
        if used.name not in known:
            raise UnsupportedError(used.name)
    owners: dict[str, nodes.Node] = {}
    pending: list[tuple[nodes.Node, nodes.Node, frozenset[str]]] = [(tree, tree, frozenset())]
    while pending:
        node, scope, running = pending.pop()
        if isinstance(node, nodes.For | nodes.Macro):
            scope = node
        if isinstance(node, nodes.For):
            names = frozenset(name.name for name in _names(node.target))
            if names & running:
                raise UnsupportedError("a variable of a loop inside a loop with the same")
            running |= names
        if isinstance(node, nodes.Assign):
            for name in _names(node.target):
                if owners.setdefault(name.name, scope) is not scope:
                    raise UnsupportedError(f"{name.name} is set in two places")
        pending += [(child, scope, running) for child in node.iter_child_nodes()]
    targets = (name.name for loop in tree.find_all(nodes.For) for name in _names(loop.target))
    if any(name in owners for name in targets):
        raise UnsupportedError("a variable of a loop is also set")


def _names(target: nodes.Node) -> list[nodes.Name]:
    return [target] if isinstance(target, nodes.Name) else list(target.find_all(nodes.Name))


def _body(statements: Sequence[nodes.Node]) -> Lines:
    """The body of a function that returns the text that the statements print."""
    yield f"{_INDENT}out = []"
    yield from _indented(statements)
    yield f"{_INDENT}return ''.join(out)"


def _indented(statements: Sequence[nodes.Node]) -> Lines:
    empty = True
    for statement in statements:
        for line in _statement(statement):
            empty = False
            yield _INDENT + line
    if empty:
        yield f"{_INDENT}pass"


def _statement(node: nodes.Node) -> Lines:
    match node:
        case nodes.Output(nodes=parts):
            yield f"out.append({_joined(parts)})"
        case nodes.For(target=target, iter=iterated, body=body, else_=[], test=None):
            yield f"for {_target(target)} in {_text(iterated)}:"
            yield from _indented(body)
        case nodes.If(test=test, body=body, elif_=others, else_=otherwise):
            yield f"if {_text(test)}:"
            yield from _indented(body)
            for other in others:
                yield f"elif {_text(other.test)}:"
                yield from _indented(other.body)
            if otherwise:
                yield "else:"
                yield from _indented(otherwise)
        case nodes.Assign(target=target, node=value):
            yield f"{_target(target)} = {_text(value)}"
        case nodes.Macro(name=name, args=parameters, defaults=[], body=body):
            yield f"def {_variable(name)}({', '.join(map(_target, parameters))}):"
            yield from _body(body)
        case _:
            raise UnsupportedError(type(node).__name__)


def _joined(parts: Sequence[nodes.Node]) -> str:
    """An expression for several parts in a row: texts of the template, and values.

    Python compiles a formatting by ``%`` of a literal text to the same as an f-string; but within
    an f-string, quotation marks cannot be nested.
    """
    texts = [node.data if isinstance(node, nodes.TemplateData) else None for node in parts]
    values = [_text(node) for node in parts if not isinstance(node, nodes.TemplateData)]
    if not values:
        return repr("".join(filter(None, texts)))
    form = "".join("%s" if text is None else text.replace("%", "%%") for text in texts)
    return f"{form!r} % ({', '.join(values)},)"


def _target(node: nodes.Node) -> str:
    """The left side of an assignment: a variable, or several."""
    match node:
        case nodes.Name(name=name):
            return _variable(name)
        case nodes.Tuple(items=items):
            return ", ".join(map(_target, items))
    raise UnsupportedError(type(node).__name__)


def _text(node: nodes.Node) -> str:
    """An expression in Python, in parentheses where it needs any."""
    match node:
        case nodes.Name(name=name):
            return _variable(name)
        case nodes.Const(value=value):
            return repr(value)
        case nodes.Getattr(node=owner, attr=name):
            return f"{_text(owner)}.{name}"
        case nodes.Getitem(node=owner, arg=place):
            return f"{_text(owner)}[{_text(place)}]"
        case nodes.Call(node=called, args=given, kwargs=[], dyn_args=None, dyn_kwargs=None):
            return f"{_text(called)}({_list(given)})"
        case nodes.Filter(node=nodes.Node() as value, name=name, args=[]) if name in FILTERS:
            return f"{FILTERS[name]}({_text(value)})"
        case nodes.Tuple(items=items) | nodes.List(items=items):
            return f"[{_list(items)}]"
        case nodes.Not(node=value):
            return f"(not {_text(value)})"
        case nodes.BinExpr(left=left, right=right, operator=operator):
            return f"({_text(left)} {operator} {_text(right)})"
        case nodes.Concat(nodes=parts):
            return f"''.join(map(str, [{_list(parts)}]))"
        case nodes.Compare(expr=left, ops=[nodes.Operand(op=op, expr=right)]) if op in _COMPARISONS:
            return f"({_text(left)} {_COMPARISONS[op]} {_text(right)})"
    raise UnsupportedError(type(node).__name__)


def _list(items: Sequence[nodes.Node]) -> str:
    return ", ".join(map(_text, items))


def _variable(name: str) -> str:
    """A template's variable, kept apart from Python's own names."""
    return f"{name}_"
