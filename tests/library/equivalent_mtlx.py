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
    "The least divisor is far below those that there are, and only promises something.": (
        (
            "std.mtlx.fresnel.film_orders: ed(passed) * share / [max(1 - mirrored * share, 1e-8) "
            "-> (1 - mirrored * share)] } /// The mean of bo"
        ),
        "std.mtlx.fresnel.film_orders: - mirrored * share, [1e-8 -> 1.25e-08] ) } /// The mean of",
        (
            "std.mtlx.fresnel.film_orders: - mirrored * share, [1e-8 -> 7.500000000000001e-09] ) } "
            "/// The mean of"
        ),
        (
            "std.mtlx.sheen.zeltner_density: i * squared(narrow / [max(stretched, 1e-12) -> "
            "(stretched)] ) where { narrow = ("
        ),
        (
            "std.mtlx.sheen.zeltner_density: row / max(stretched, [1e-12 -> 1.25e-12] )) where { "
            "narrow ="
        ),
        (
            "std.mtlx.sheen.zeltner_density: row / max(stretched, [1e-12 -> 7.5e-13] )) where { "
            "narrow ="
        ),
        (
            "std.mtlx.sheen.zeltner_density: y - 1) * y * y * y / [max(0.0000254053 + (…34174 * y "
            "* y, 1e-4) -> (0.0000254053 + (1.7…v + 1.34174 * y * y)] // The square of the"
        ),
        (
            "std.mtlx.sheen.zeltner_density: v + 1.34174 * y * y, [1e-4 -> 0.000125] ) // The "
            "square of t"
        ),
        (
            "std.mtlx.sheen.zeltner_density: v + 1.34174 * y * y, [1e-4 -> 7.500000000000001e-05] "
            ") // The square of t"
        ),
    ),
    "Both ways to swing are added up, in whatever order.": (
        (
            "std.mtlx.fresnel.film_on_clear: ) -> rgb = film_rgb( [film_orders(film.alo…ed(across) "
            "* second) -> film_orders(film.acr…red(along) * second)] ) where { first = fi"
        ),
    ),
    "A factor of -1 or 1 is its own reciprocal.": (
        ("std.mtlx.fresnel.film_on_schlick: ) inner = sqrt(half) [* -> /] choose(vec3(max(f0,"),
    ),
    "It counts only where cloth is so smooth that its light hardly leans.": (
        (
            "std.mtlx.sheen.zeltner_density: ) * y * y * y / max( [0.0000254053 -> 1.9053975e-05] "
            "+ (1.71228 - 1.71506"
        ),
        (
            "std.mtlx.sheen.zeltner_density: ) * y * y * y / max( [0.0000254053 -> "
            "3.1756624999999995e-05] + (1.71228 - 1.71506"
        ),
    ),
}
