"""Makes the contents of storage buffers from the values of a host.

These are a list of elements, each like the value of a parameter; or a NumPy array, of numbers or
with a field for each member of a structure, which NumPy packs as a whole. NumPy is imported only
then.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping

from .blocks import write
from .contents import Contents, Layout
from .values import ParameterError, accepted, initial, shown, unset


def packed(layout: Layout, given: object) -> Contents:
    """The contents that a host means by ``given``.

    Raises ``ParameterError`` if it is no list of elements, and for an element that does not fit,
    breaks a promise, or lacks a member.
    """
    if hasattr(given, "dtype") and hasattr(given, "shape"):
        from .arrays import packed_array

        found = packed_array(layout, given)
        if found is not None:
            return found
    items = given.tolist() if hasattr(given, "tolist") else given
    if isinstance(items, str | bytes | Mapping) or not isinstance(items, Collection):
        wanted = f"`{layout.name}` takes a list of elements ({layout.type})"
        raise ParameterError(layout.name, f"{wanted}, and was given {shown(given)}")
    data = bytearray(len(items) * layout.stride)
    for number, item in enumerate(items):
        name = f"{layout.name}[{number}]"
        value = accepted(layout.element, item, initial(layout.element), name)
        missing = next(unset(layout.element, value, name), None)
        if missing is not None:
            raise ParameterError(missing[0], f"`{missing[0]}` has no value ({missing[1].type})")
        write(data, number * layout.stride, layout.element, value)
    return Contents(layout, len(items), bytes(data))
