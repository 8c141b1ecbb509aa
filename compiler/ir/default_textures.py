"""The textures that stand in until a host binds one: of one texel for each layer or face.

Semantics looks up what a ``map`` names, the reflection hands the texels on to hosts, and the
runner makes textures of them.
"""

from __future__ import annotations

from collections.abc import Mapping

from .types import Sample

Texel = tuple[float, ...]
"""The numbers that a shader reads: four lanes, or of depths a single one."""

_MIDDLE = 128 / 255
"""The number of eight bits for which a normal map has no slope."""

COLORS: Mapping[str, Texel] = {
    "white": (1.0, 1.0, 1.0, 1.0),
    "black": (0.0, 0.0, 0.0, 1.0),
    "gray": (_MIDDLE, _MIDDLE, _MIDDLE, 1.0),
    "transparent": (0.0, 0.0, 0.0, 0.0),
    "flat_normal": (_MIDDLE, _MIDDLE, 1.0, 1.0),
}
DEPTHS: Mapping[str, Texel] = {"far": (1.0,), "near": (0.0,)}
INTEGERS: Mapping[str, Texel] = {"zero": (0, 0, 0, 0)}

OF_SAMPLES: Mapping[Sample, Mapping[str, Texel]] = {
    "float": COLORS, "depth": DEPTHS, "int": INTEGERS, "uint": INTEGERS,
}  # fmt: skip
"""The default textures by their names in the language, for each content of textures.

The first one of each is the default where a program names none.
"""
