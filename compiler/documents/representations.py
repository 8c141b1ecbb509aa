"""What the names of types say in a reflection: ``ivec3`` has three lanes of ``int``."""

from __future__ import annotations

import re
from typing import Literal

Kind = Literal["float", "int", "uint", "bool"]

_VECTOR = re.compile(r"([iub]?)vec([234])")
_PREFIXES: dict[str, Kind] = {"": "float", "i": "int", "u": "uint", "b": "bool"}
_SCALARS: dict[str, Kind] = {"float": "float", "int": "int", "uint": "uint", "bool": "bool"}


def kind_of(representation: str) -> Kind:
    """The type of the lanes of a number, vector or matrix; ``float`` for all other types."""
    vector = _VECTOR.fullmatch(representation)
    return _PREFIXES[vector[1]] if vector else _SCALARS.get(representation, "float")


def lanes_of(representation: str) -> int:
    """The number of lanes of a vector; 1 for a number."""
    vector = _VECTOR.fullmatch(representation)
    return int(vector[2]) if vector else 1
