"""Sentences about blocks and fields, which all languages write in their comments."""

from __future__ import annotations

from collections.abc import Iterator

from .fields import Field
from .model import Binding, Block


def about_block(binding: Binding, block: Block) -> str:
    """Where a block is bound, how often a host fills it, and from what it is computed."""
    if block.about:
        return block.about
    places = {
        f"group {bound.group}, binding {bound.binding}"
        for material in binding.materials
        for profile in material.profiles
        for bound in profile.bound
        if bound.name == block.name and bound.group is not None
    }
    parts = [places.pop().capitalize()] if len(places) == 1 else []
    parts.append(f"per {block.group}" if parts else f"Per {block.group}")
    if not block.layout_id:
        parts = [f"Per {block.group}; bound nowhere, as only derived values need it"]
    names = sources(block)
    return "; ".join([*parts, f"computed from {names}"] if names else parts) + "."


def sources(block: Block) -> str:
    """The blocks from which one is computed: ``Material and Rig``."""
    return " and ".join(f"`{source.plain_name}`" for source in block.sources)


def about_field(field: Field) -> str:
    """What a field means, and what a host may set it to; empty if its name says it all."""
    return "; ".join(_parts(field))


def in_one_line(doc: str) -> str:
    """A doc comment in one line."""
    return " ".join(doc.split())


def choices_text(field: Field) -> str:
    """The members of the enumeration that a field is: ``0 fresh, 1 worn``."""
    return ", ".join(f"{number} {name}" for number, name in enumerate(field.choices))


def range_text(bounds: tuple[float, float]) -> str:
    """A range, in which large whole numbers are not rounded: ``0 to 0.5``, ``0 to 2147483647``."""
    shown = (str(int(each)) if float(each).is_integer() else f"{each:g}" for each in bounds)
    return " to ".join(shown)


def _parts(field: Field) -> Iterator[str]:
    if field.doc:
        yield in_one_line(field.doc).rstrip(".")
    if field.computed:
        return
    if field.choices:
        yield choices_text(field)
    elif field.range is not None:
        yield range_text(field.range)
    if field.meaning in _UNITS:
        yield _UNITS[field.meaning]
    if field.is_unit:
        yield "length 1"
    if field.default is None and not field.counts and not field.capacity:
        yield "no default: has to be set"


_UNITS = {"angle": "radians", "rgb": "linear", "rgba": "linear"}
