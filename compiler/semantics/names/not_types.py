"""Names that are declared, but stand for no type, where one is written."""

from __future__ import annotations

from ...syntax import ast
from .modules import Symbol


def not_a_type(symbols: tuple[Symbol, ...]) -> str:
    """The hint for a written type that is the name of something else; empty for others."""
    if not symbols:
        return ""
    name = symbols[0].name
    match symbols[0].declaration:
        case ast.Record(kind="light"):
            return (
                f"`{name}` is a light, and no type: lights stand in a rig, "
                f"`rig Name {{ one : {name} }}`, and a `term … per light` reads them"
            )
        case ast.Record(kind=kind):
            return (
                f"`{name}` is a {kind}, and no type: a {kind} has its members if it extends it, "
                f"`{kind} Name : {name} {{ … }}`"
            )
        case ast.Mixin(kind=kind):
            return (
                f"`{name}` is a mixin, and no type: a {kind} has its members if it names it "
                f"behind its base, `{kind} Name : Base + {name} {{ … }}`"
            )
        case ast.Rig():
            return f"`{name}` is a rig, and no type: it is chosen when compiling, `--rig {name}`"
        case ast.Function():
            return f"`{name}` is a function, and no type: `{name}(…)` is a value"
        case ast.Constant():
            return f"`{name}` is a value, and no type: its equation is `name = {name}`"
        case ast.Space():
            return f"`{name}` is a space: types name one in brackets, as in `point<{name}>`"
    return ""
