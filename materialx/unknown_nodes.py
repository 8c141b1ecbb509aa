"""Says why a node has no definition: MaterialX knows no such category, or not of such a type."""

from __future__ import annotations

from ..compiler.diagnostics.nearest import nearest
from .known import known
from .library import library
from .model import Definition, Node


def no_definition(node: Node) -> str:
    """The sentence about a node for which MaterialX finds no definition."""
    definitions = known(node.category)
    if not definitions:
        names = {found.getNodeString() for found in library().getNodeDefs()}
        meant = nearest(node.category, names)
        way_out = f": did you mean '{meant}'?" if meant else ""
        return f"MaterialX knows no '{node.category}' of these types{way_out}"
    fitting = [each for each in definitions if _type(each) == node.type]
    if not fitting:
        types = list(dict.fromkeys(map(_type, definitions)))
        return f"{node.category} is of the type {_one_of(types)}, and not '{node.type}'"
    return f"MaterialX knows no {node.category} of these types"


def _type(definition: Definition) -> str:
    """The type of a node with this definition, as documents write it."""
    outputs = list(definition.outputs.values())
    return outputs[0].type if len(outputs) == 1 else "multioutput"


def _one_of(words: list[str]) -> str:
    return words[0] if len(words) == 1 else f"{', '.join(words[:-1])} or {words[-1]}"
