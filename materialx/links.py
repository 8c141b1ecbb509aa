"""What connections of a document lead to, as far as they lead anywhere."""

from __future__ import annotations

from .model import Graph, Node, Port
from .problems import UnsupportedError


def output_of(graph: Graph, name: str) -> Port:
    """The output of a graph with a name, or its first one if no name is given."""
    found = graph.outputs.get(name) if name else next(iter(graph.outputs.values()), None)
    if found is None:
        quoted = f" '{name}'" if name else ""
        owner = f"the graph {graph.name}" if graph.name else "the document"
        raise UnsupportedError(f"{owner} has no output{quoted}")
    return found


def check_type(node: Node, output: str, port: Port) -> None:
    """Tell a connection between two types."""
    if node.definition is None:
        return
    if node.output(output) not in ("", *node.definition.outputs):
        raise UnsupportedError(f"the node {node.name} has no output '{output}'")
    kind = node.output_type(output)
    if kind not in (port.type, "multioutput"):
        raise UnsupportedError(
            f"the input '{port.name}' of the type {port.type} is connected to '{node.name}', "
            f"which is of the type {kind}"
        )
