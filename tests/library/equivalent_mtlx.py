"""Changes of ``std.mtlx`` that no value can show, each with the reason; for ``equivalent.py``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

BY_REASON: Mapping[str, Sequence[str]] = {
    "At most one square has the number; all others give 0, and so does a step before them.": (
        "std.mtlx.textures.udim_layer: : int[N]) -> int = ( [sum -> max] i in 0..N : (if is_i",
        "std.mtlx.textures.udim_layer: -> int = (sum i in 0 [ -> - 1] ..N : (if is_in_row",
    ),
    "Where the two parts of a curve meet, they have the same value.": (
        "std.mtlx.color.from_acescc: scg_to_rgb( choose(c [<= -> <] (9.72 - 15) / 17.52,",
        "std.mtlx.color.from_acescct: scg_to_rgb( choose(c [<= -> <] 0.155251141552511, (",
    ),
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
    "A cell that is looked at twice is as near and as high as before.": (
        "std.mtlx.noise.nearest_feature: vec2(1e3) for i in 0 [ -> - 1] ..9 : shorter(known,",
        "std.mtlx.noise.nearest_feature: vec3(1e3) for i in 0 [ -> - 1] ..27 : shorter(known",
        "std.mtlx.noise.worleynoise2d: else sqrt(min i in 0 [ -> - 1] ..9 : square_to_feat",
        "std.mtlx.noise.worleynoise3d: else sqrt(min i in 0 [ -> - 1] ..27 : square_to_fea",
        "std.mtlx.noise.uppermost: ivec3(0)) for i in 0 [ -> - 1] ..27 : upper(known,",
    ),
    "The value and the lower limit of a clamp may change places.": (
        (
            "std.mtlx.surfaces.artistic_ior: ) where { r = clamp( [reflectivity, 0 -> 0, "
            "reflectivity] , 0.99) n = mix((1 +"
        ),
        (
            "std.mtlx.surfaces.roughness_anisotropy: ere { width = clamp( [roughness * "
            "roughness, 1e-8 -> 1e-8, roughness * roughness] , 1) aspect = sqrt(1"
        ),
        (
            "std.mtlx.surfaces.roughness_anisotropy: ct = sqrt(1 - clamp( [anisotropy, 0 -> "
            "0, anisotropy] , 0.98)) } /// The s"
        ),
        (
            "std.mtlx.surfaces.roughness_dual: 0)) -> vec2 = clamp( [felt * felt, 1e-8 -> "
            "1e-8, felt * felt] , 1) where { felt ="
        ),
        (
            "std.mtlx.surfaces.blackbody: ) where { t = clamp( [temperature, 800 -> 800, "
            "temperature] , 25000) x = cubic("
        ),
        (
            "std.mtlx.surfaces.chiang_hair_absorption_from_color: ss root = log(clamp( "
            "[color, 0.001 -> 0.001, color] , 1)) / (5.969 + b *"
        ),
        (
            "std.mtlx.surfaces.chiang_hair_roughness: ere { along = clamp( [longitudinal, "
            "0.001 -> 0.001, longitudinal] , 1) around = clamp("
        ),
        (
            "std.mtlx.surfaces.chiang_hair_roughness: , 1) around = clamp( [azimuthal, 0.001 "
            "-> 0.001, azimuthal] , 1) width = 0.726 *"
        ),
        (
            "std.mtlx.textures.gain: { bend = (1 / clamp( [amount, 0.001 -> 0.001, amount] , "
            "0.999) - 2) * (1 -"
        ),
    ),
    "Factors, and the lanes of which a length is taken, may change places.": (
        (
            "std.mtlx.textures.hextiledimage: ere { coord = tiled( [texcoord, tiling -> "
            "tiling, texcoord] ) tiles = hex_tiles("
        ),
        (
            "std.mtlx.textures.hextilednormalmap: ere { coord = tiled( [texcoord, tiling -> "
            "tiling, texcoord] ) tiles = hex_tiles("
        ),
        (
            "std.mtlx.patterns.filtered_step: 54757 * length(vec2( [ddx(value), ddy(value) "
            "-> ddy(value), ddx(value)] )) } /// One value o"
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
        "std.mtlx.surface.third_axis: normalize(tangent)) [* -> /] handedness /// Textu",
    ),
    "A direction in another space has length one.": (
        (
            "std.mtlx.surface.MaterialXSurface: view_object : vec3 = "
            "[normalize(vec3(-to_eye in object)) -> (vec3(-to_eye in object))] } /// The third axis"
        ),
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
