"""The promises of a shader: vectors of which the host says that they are not zero.

``nonzero(v)`` makes one. The reflection lists them for hosts, and ``burnish render`` names those
that the reference found broken.
"""

from __future__ import annotations

from collections.abc import Iterator

from ..frozen import frozen
from ..stdlib.builtins import BUILTINS
from .formula import Formulas
from .ir.leaves import Parameter
from .ir.node import Node, reachable
from .ir.operations import builtin_of
from .ir.shader import Shader


@frozen
class Promise:
    """One value that is promised not to be zero."""

    node: Node
    """The call of ``nonzero``."""
    value: str
    """The value as a formula with the user's names."""
    parameters: tuple[str, ...]
    """Names of the parameters that the value depends on."""


def promises(shader: Shader) -> Iterator[Promise]:
    """All promises that the results of a shader rest on."""
    formulas = Formulas(shader.notes)
    for node in reachable(shader.roots):
        name = builtin_of(node)
        if name is not None and BUILTINS[name].is_promise:
            leaves = (leaf.data for leaf in reachable(node.operands))
            names = (leaf.name for leaf in leaves if isinstance(leaf, Parameter))
            text = formulas.computed(node.operands[0])
            yield Promise(node, text, tuple(dict.fromkeys(names)))
