"""The base of all records of a glTF file, and the numbers and names that these consist of.

``schema.py`` and ``materials_schema.py`` put records together of them.
"""

from __future__ import annotations

from typing import Annotated

from msgspec import Meta, Struct

Index = Annotated[int, Meta(ge=0, lt=2**31)]
Size = Annotated[int, Meta(ge=1, lt=2**31)]
Share = Annotated[float, Meta(ge=0, le=1)]
Positive = Annotated[float, Meta(gt=0)]
NotNegative = Annotated[float, Meta(ge=0)]
Distance = Annotated[float, Meta(ge=1e-30, le=1e30)]
"""A distance of which a projection can be made: neither it nor its reciprocal is 0 or infinite."""
Numbers3 = tuple[float, float, float]
Numbers4 = tuple[float, float, float, float]
Name = Annotated[str, Meta(max_length=10_000)]


class Record(Struct, frozen=True, rename="camel"):
    """The base of all records: immutable, with names in camel case in the JSON."""
