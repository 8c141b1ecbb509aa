"""Prints nodes as short formulas in Burnish's notation.

``burnish graph`` and the proofs show them to people.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

from ..stdlib.builtins import BUILTINS
from .ir.leaves import Attribute, Buffer, Parameter, Texture
from .ir.node import Formal, Node
from .ir.operations import CALL, CONSTANT, CROSS, FOLD, MEMBER, SWIZZLE, builtin_of
from .ir.shader import Notes
from .ir.types import Scalar

DEEPEST = 5
"""The number of levels of a formula that are printed; deeper ones are ``…``."""
LONGEST = 60
"""The approximate number of characters of a formula."""

_INDEX = "i"
"""The variable of a closed body."""
WORDS = {"and": "and", "or": "or", "not": "not ", "mod": "mod"}
_FOLDS = {"add": "sum", "mul": "product"}
_CONVERSION = "to_"
"""The prefix of conversions, which are printed as their type: ``to_int`` as ``int``."""
_LANES = "xyzw"
_IN_BITS = 1_000_000
"""Larger whole numbers are printed in hexadecimal, because they probably are bit patterns."""
TIGHTNESS = {
    "or": 1, "and": 2, "eq": 3, "ne": 3, "lt": 3, "le": 3, "gt": 3, "ge": 3,
    "bit_or": 4, "bit_xor": 5, "bit_and": 6, "shift_left": 7, "shift_right": 7,
    "add": 8, "sub": 8, "mul": 9, "div": 9, "mod": 9,
}  # fmt: skip
SIGN, _TIGHTEST = 10, 13


class Formulas:
    """Prints formulas, with the user's names for values that have one."""

    def __init__(self, notes: Notes) -> None:
        self._notes = notes

    def text(self, node: Node) -> str:
        """The name of a value, or the way it is computed."""
        return self.name(node) or self.computed(node)

    def name(self, node: Node) -> str | None:
        """The name of a value in the user's text, or ``None``."""
        return _leaf_name(node) or self._notes.names.get(node.id)

    def computed(self, node: Node, inner: Callable[[Node], str | None] | None = None) -> str:
        """The way a value is computed; ``inner`` may supply texts for the values inside."""
        text = self._formula(node, DEEPEST, inner or self.name)
        return text if len(text) <= LONGEST else self._formula(node, 2, inner or self.name)

    def call(self, builtin: str, operands: Sequence[Node]) -> str:
        """A builtin applied to some operands."""
        return self._call(builtin, operands, DEEPEST - 1, self.name)

    def _inner(
        self, node: Node, depth: int, named: Callable[[Node], str | None], tightness: int = 0
    ) -> str:
        # Equal constants are one node: its name may be that of an unrelated one.
        name = None if node.op == "constant" else named(node)
        if name is not None:
            return name
        if depth <= 0 and node.operands:
            return "…"
        text = self._formula(node, depth, named)
        builtin = builtin_of(node)
        loose = builtin is not None and TIGHTNESS.get(builtin, _TIGHTEST) < tightness
        return f"({text})" if loose or (tightness and node.op in ("select", "fold")) else text

    def _formula(self, node: Node, depth: int, named: Callable[[Node], str | None]) -> str:
        def part(operand: Node, tightness: int = 0) -> str:
            return self._inner(operand, depth - 1, named, tightness)

        operands = node.operands
        match node.op:
            case "call" | "native":
                return self._call(CALL.data(node), operands, depth - 1, named)
            case "constant":
                return _constant(node)
            case "swizzle":
                lanes = "".join(_LANES[lane] for lane in SWIZZLE.data(node))
                return f"{part(operands[0], _TIGHTEST)}.{lanes}"
            case "index":
                return f"{part(operands[0], _TIGHTEST)}[{part(operands[1])}]"
            case "member":
                return f"{part(operands[0], _TIGHTEST)}.{MEMBER.data(node)}"
            case "select":
                condition, then, otherwise = map(part, operands)
                return f"if {condition} then {then} else {otherwise}"
            case "cross":
                return f"@{CROSS.data(node).origin} {part(operands[0], _TIGHTEST)}"
            case "fold":
                data = FOLD.data(node)
                word = _FOLDS.get(data.operator, data.operator)
                index = data.index.name if data.formals else _INDEX
                return f"{word} {index} in 0..{part(operands[0])} : {part(operands[2])}"
            case "iterate":
                return f"iterate up to {part(operands[0])} from {part(operands[1])}"
            case "apply":
                name = self._notes.functions.get(operands[0].id, "shade")
                return f"{name}({', '.join(map(part, operands[1:]))})"
            case "vector" | "splat" | "matrix":
                return f"{node.type}({', '.join(map(part, operands))})"
            case _:
                return _INDEX if node.op == "bound" else _leaf_text(node)

    def _call(
        self, name: str, operands: Sequence[Node], depth: int, named: Callable[[Node], str | None]
    ) -> str:
        tightness = TIGHTNESS.get(name)
        sign = WORDS.get(name) or BUILTINS[name].operator
        if tightness and len(operands) == 2:
            left = self._inner(operands[0], depth, named, tightness)
            right = self._inner(operands[1], depth, named, tightness + 1)
            return f"{left} {sign} {right}"
        if sign and len(operands) == 1:
            return f"{sign}{self._inner(operands[0], depth, named, SIGN)}"
        texts = [self._inner(operand, depth, named) for operand in operands]
        if name == "sample":
            return f"{texts[0]}({', '.join(texts[1:])})"
        return f"{name.removeprefix(_CONVERSION)}({', '.join(texts)})"


def _leaf_name(node: Node) -> str | None:
    """The declared name of a leaf, or ``None`` for any other node."""
    match node.data:
        case Parameter() | Attribute() | Texture() | Buffer():
            return node.data.name
        case Formal(name=name) if node.op == "formal":
            return name
    return None


def _leaf_text(node: Node) -> str:
    """A leaf, or an operation that has no notation."""
    return _leaf_name(node) or str(node.data or node.op)


_BOOLS: Mapping[bool, str] = {True: "true", False: "false"}


def _constant(node: Node) -> str:
    data = CONSTANT.data(node)
    lanes = data if isinstance(data, tuple) else (data,)
    texts = [_BOOLS[lane] if isinstance(lane, bool) else _number(lane) for lane in lanes]
    if isinstance(node.type, Scalar):
        return texts[0]
    return f"{node.type}({texts[0] if len(set(texts)) == 1 else ', '.join(texts)})"


def _number(lane: object) -> str:
    if isinstance(lane, int) and abs(lane) >= _IN_BITS:
        return f"{lane:#x}"
    return f"{lane:g}" if isinstance(lane, int | float) else "…"
