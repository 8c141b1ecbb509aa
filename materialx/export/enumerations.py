"""Members of enumerations: whole numbers, or the words that nodes have for them."""

from __future__ import annotations

from ...compiler.semantics.equations.reads import MeantSlot, Where, meant
from ...compiler.syntax import ast
from .unsayable import UnsayableError
from .values import Constant, Value


def member(e: ast.Field, where: Where) -> Constant | None:
    """The number of a member, as of ``Mode.add``; nothing for members of other things."""
    if not isinstance(e.operand, ast.Reference):
        return None
    found = meant(e.operand.name, where)
    for symbol in () if isinstance(found, MeantSlot) else found or ():
        if isinstance(symbol.declaration, ast.Enumeration):
            names = [each.name.text for each in symbol.declaration.members]
            return Constant("integer", (float(names.index(e.name.text)),))
    return None


def word(name: str, value: Value, words: tuple[str, ...]) -> str:
    """The word for the member that is given to the input ``name``. Raises ``UnsayableError``."""
    number = int(value.numbers[0]) if isinstance(value, Constant) else -1
    if not 0 <= number < len(words):
        raise UnsayableError(f"`{name}` has to be a constant: {', '.join(words)}")
    return words[number]
