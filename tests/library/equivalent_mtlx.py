"""Changes of ``std.mtlx`` that no value can show, each with the reason; for ``equivalent.py``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

BY_REASON: Mapping[str, Sequence[str]] = {
    "Corners are added up, in whatever order.": (
        (
            "std.mtlx.noise.corner2: t) -> ivec2 = ivec2( [i & 1, i >> 1 -> i >> 1, i & 1] ) "
            "/// One of the eig"
        ),
        (
            "std.mtlx.noise.corner3: t) -> ivec3 = ivec3( [i & 1, i >> 1 & 1 -> i >> 1 & 1, "
            "i & 1] , i >> 2) /// How mu"
        ),
        (
            "std.mtlx.noise.corner3: ivec3 = ivec3(i & 1, [i >> 1 & 1, i >> 2 -> i >> 2, "
            "i >> 1 & 1] ) /// How much a cor"
        ),
    ),
}
