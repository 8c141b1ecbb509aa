"""A graph of nodes that is being written, by the package ``MaterialX``."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

from ..known import known
from ..model import Definition
from ..names import slot_name
from ..values import numbers_of
from .unsayable import UnsayableError
from .values import SAME_LANES, Constant, Linked, Picture, Several, Value, lanes_of, retyped

Input = Value | str
"""A value, or a text, of an input."""
NO_NODE = "compute it by other nodes, or give the document a texture of it"
"""What can be done where no node fits."""
_NEVER = 1000
"""The cost of what cannot be converted."""


class Nodes:
    """The nodes of one graph. Equal nodes are written once."""

    def __init__(self, element: Any) -> None:
        self.element = element
        self._made: dict[tuple[object, ...], Linked] = {}
        self._inputs: dict[str, tuple[str, Mapping[str, Input]]] = {}
        self._last = ""
        self.upright: dict[str, Value] = {}
        """Coordinates as they were before a node turned v upside down, by the nodes."""

    def interface(self, name: str, value: Constant, about: Mapping[str, str]) -> Linked:
        """An input of the graph, with its value and what people read of it."""
        found = self.element.addInput(self.element.createValidChildName(name), value.type)
        # People look for inputs in front of the nodes.
        self.element.setChildIndex(found.getName(), len(self.element.getInputs()) - 1)
        found.setValueString(value.text)
        if value.space:
            found.setColorSpace(value.space)
        for attribute, text in about.items():
            found.setAttribute(attribute, text)
        return Linked(value.type, interface=found.getName())

    def node(
        self, category: str, given: Mapping[str, Input], wanted: str = "", must: bool = False
    ) -> Value:
        """A node with these inputs, of the definition that needs the fewest conversions.

        ``wanted`` is the type that its reader would like; with ``must``, none of other lanes will
        do. Raises ``UnsayableError``.
        """
        definition = _chosen(category, given, wanted, must)
        _check_color(category, definition, given)
        inputs = {
            name: value if isinstance(value, str | Picture)
            else self.converted(value, definition.inputs[name].type)
            for name, value in given.items()
        }  # fmt: skip
        return self.defined(category, definition, inputs)

    def defined(self, category: str, definition: Definition, inputs: Mapping[str, Input]) -> Value:
        """A node of this definition, whose inputs have the types that it asks for."""
        outputs = {name: port.type for name, port in definition.outputs.items()}
        if len(outputs) == 1:
            (kind,) = outputs.values()
            return self.plain(category, kind, inputs, definition)
        made = self.plain(category, "multioutput", inputs, definition)
        return several(made, outputs)

    def plain(
        self,
        category: str,
        kind: str,
        inputs: Mapping[str, Input],
        definition: Definition | None = None,
    ) -> Linked:
        """A node of a type, written as it is."""
        kept = {
            name: value for name, value in inputs.items()
            if definition is None or not _is_default(definition, name, value)
        }  # fmt: skip
        key = (category, kind, *((name, _key(value)) for name, value in kept.items()))
        if key not in self._made:
            name = self.element.createValidChildName(category)
            made = self.element.addNode(category, name, kind)
            for input_name, value in kept.items():
                types = {} if definition is None else definition.inputs
                write(made, input_name, value, types[input_name].type if types else "")
            self._made[key] = Linked(kind, made.getName())
            self._inputs[made.getName()] = category, kept
            self._last = made.getName()
        return self._made[key]

    def named(self, value: Value, name: str) -> Value:
        """Give a node that was just made, and that nothing reads yet, the name of its equation."""
        links = list(value.members.values()) if isinstance(value, Several) else [value]
        old = {link.node if isinstance(link, Linked) else "" for link in links}
        if old != {self._last} or not self._last:
            return value
        fresh = self.element.createValidChildName(name)
        self.element.getNode(self._last).setName(fresh)
        self._made = {
            key: replace(each, node=fresh) if each.node == self._last else each
            for key, each in self._made.items()
        }
        self._inputs[fresh] = self._inputs.pop(self._last)
        if self._last in self.upright:
            self.upright[fresh] = self.upright.pop(self._last)
        self._last = ""
        if isinstance(value, Several):
            return Several({
                member: replace(link, node=fresh)
                for member, link in value.members.items() if isinstance(link, Linked)
            })  # fmt: skip
        assert isinstance(value, Linked)
        return replace(value, node=fresh)

    def lane(self, value: Linked, place: int) -> Value:
        """A lane of a vector; of one that is put together of single lanes, what was put in."""
        category, inputs = self._inputs.get(value.node, ("", {}))
        put_in = inputs.get(f"in{place + 1}")
        singles = all(
            isinstance(each, Constant | Linked) and lanes_of(each.type) == 1
            for each in inputs.values()
        )
        if category.startswith("combine") and singles and isinstance(put_in, Constant | Linked):
            return put_in
        return self.node("extract", {"in": value, "index": Constant("integer", (float(place),))})

    def decoded(self, value: Linked, space: str) -> Value:
        """A colour of some colour space: an image tells of its file, all else has a node."""
        category, inputs = self._inputs.get(value.node, ("", {}))
        file = inputs.get("file")
        if category == "image" and isinstance(file, Picture) and not file.space:
            return self.node("image", {**inputs, "file": replace(file, space=space)}, value.type)
        return self.node(f"{space}_to_lin_rec709", {"in": value}, value.type)

    def whole(self, color: Value, alpha: Value) -> Value | None:
        """The value with four lanes whose first three are a colour, and whose last one is its
        alpha; nothing if they come from different ones."""
        if not isinstance(color, Linked) or not isinstance(alpha, Linked):
            return None
        category, first = self._inputs.get(color.node, ("", {}))
        other, last = self._inputs.get(alpha.node, ("", {}))
        is_split = (category, other) == ("convert", "extract") and first["in"] == last["in"]
        is_last = last.get("index") == Constant("integer", (3.0,))
        found = first["in"] if is_split and is_last else None
        return None if isinstance(found, str) else found

    def prune(self) -> None:
        """Remove the nodes that no output reads, and the inputs that no node reads."""
        waiting = [output.getNodeName() for output in self.element.getOutputs()]
        read: set[str] = set()
        while waiting:
            name = waiting.pop()
            if name and name not in read:
                read.add(name)
                waiting += [port.getNodeName() for port in self.element.getNode(name).getInputs()]
        for node in self.element.getNodes():
            if node.getName() not in read:
                self.element.removeChild(node.getName())
        named = {
            port.getInterfaceName() for node in self.element.getNodes()
            for port in node.getInputs()
        }  # fmt: skip
        for port in self.element.getInputs():
            if port.getName() not in named:
                self.element.removeChild(port.getName())

    def ordered(self, names: Iterable[str]) -> None:
        """Bring the inputs of the graph into an order."""
        inputs = [name for name in names if self.element.getInput(name) is not None]
        for place, name in enumerate(inputs):
            self.element.setChildIndex(name, place)

    def converted(self, value: Value, kind: str) -> Value:
        """A value as another type. Raises ``UnsayableError``."""
        if kind == "EDF" and _cost(value, "color3") < _NEVER:
            return self.node("uniform_edf", {"color": value})
        if isinstance(value, Constant):
            found = retyped(value, kind)
            if found is not None:
                return found
        elif isinstance(value, Linked):
            if value.type == kind:
                return value
            if _cost(value, kind) < _NEVER:
                return self.plain("convert", kind, {"in": value})
        have = getattr(value, "type", "structure")
        raise UnsayableError(f"a {have} cannot become a {kind} in MaterialX", "convert it")


def several(made: Linked, outputs: Mapping[str, str]) -> Several:
    """The outputs of a node, by the names of the members that they are; with their types."""
    return Several({
        slot_name(name): Linked(kind, made.node, name) for name, kind in outputs.items()
    })  # fmt: skip


def write(made: Any, name: str, value: Input, kind: str = "") -> None:
    """Write an input of a node, or of anything else that has inputs."""
    if isinstance(value, str):
        made.addInput(name, kind or "string").setValueString(value)
    elif isinstance(value, Picture):
        found = made.addInput(name, "filename")
        found.setValueString(value.file)
        if value.space:
            found.setColorSpace(value.space)
    elif isinstance(value, Constant):
        found = made.addInput(name, value.type)
        found.setValueString(value.text)
        if value.space:
            found.setColorSpace(value.space)
    elif isinstance(value, Linked):
        found = made.addInput(name, value.type)
        if value.interface:
            found.setInterfaceName(value.interface)
        else:
            found.setNodeName(value.node)
            if value.output:
                found.setOutputString(value.output)


def _key(value: Input) -> object:
    return (value.name, value.file, value.space) if isinstance(value, Picture) else value


def _is_default(definition: Definition, name: str, value: Input) -> bool:
    """True if an input has this value anyway."""
    port = definition.inputs[name]
    if not _is_decided(definition, name):
        return False
    if isinstance(value, str):
        return port.value == value and port.type != "filename"
    if not isinstance(value, Constant) or port.value is None or port.geometry or value.space:
        return False
    if value.type == "boolean":
        return port.value == value.text
    numbers = numbers_of(port.value)
    return tuple(numbers * (len(value.numbers) // len(numbers))) == value.numbers


def _is_decided(definition: Definition, name: str) -> bool:
    """True if the type of an input chooses between no definitions with the same result."""
    first = next(iter(definition.outputs.values()))
    others = [
        other.inputs[name].type for other in known(definition.category)
        if name in other.inputs and next(iter(other.outputs.values())).type == first.type
    ]  # fmt: skip
    return len(set(others)) == 1


def _chosen(category: str, given: Mapping[str, Input], wanted: str, must: bool) -> Definition:
    """The definition of a category that fits best. Raises ``UnsayableError``."""
    costs = [(_price(each, given, wanted, must), each) for each in known(category)]
    best = min((cost for cost, _each in costs), default=_NEVER)
    if best >= _NEVER:
        types = " and ".join(
            dict.fromkeys(
                value.type for value in given.values() if isinstance(value, Constant | Linked)
            )
        )
        raise UnsayableError(
            f"MaterialX has no node `{category}` of {types or 'this kind'}", NO_NODE
        )
    return next(each for cost, each in costs if cost == best)


def _price(definition: Definition, given: Mapping[str, Input], wanted: str, must: bool) -> int:
    """What a definition costs: the conversions of its inputs and of its result."""
    if not given.keys() <= definition.inputs.keys():
        return _NEVER
    total = 0
    for name, value in given.items():
        kind = definition.inputs[name].type
        if isinstance(value, str | Picture):
            total += 0 if kind in ("string", "filename") else _NEVER
        else:
            total += _cost(value, kind)
    outputs = list(definition.outputs.values())
    if wanted and len(outputs) == 1 and outputs[0].type != wanted:
        is_alike = SAME_LANES.get(wanted) == outputs[0].type
        total += 1 if is_alike else _NEVER if must else 2
    return total


def _check_color(category: str, definition: Definition, given: Mapping[str, Input]) -> None:
    """MaterialX decodes the files of nodes that give colours, and of no others."""
    is_color = any(isinstance(value, Picture) and value.is_color for value in given.values())
    first = next(iter(definition.outputs.values()))
    if is_color and not first.type.startswith("color"):
        raise UnsayableError(
            f"`{category}` would read a picture of colours as numbers",
            "declare it with `intent = data`",
        )


def _cost(value: Value, kind: str) -> int:
    """What it costs to make a value one of a type."""
    if kind == "EDF" and getattr(value, "type", "") != "EDF":
        return _cost(value, "color3")
    if isinstance(value, Constant):
        if retyped(value, kind) is None:
            return _NEVER
        return 3 if len(value.numbers) == 1 and lanes_of(kind) > 1 else 0
    if not isinstance(value, Linked):
        return _NEVER
    if value.type == kind:
        return 0
    if SAME_LANES.get(value.type) == kind:
        return 3
    spreads = value.type == "float" and lanes_of(kind) > 1
    return 8 if spreads else _NEVER
