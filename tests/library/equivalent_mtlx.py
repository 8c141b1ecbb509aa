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
    "A polynomial without negative terms is 1 or more.": (
        (
            "std.mtlx.sheen.conty_kulla_even: t = saturate(fit.x / [max(fit.y, 0.001) -> (fit.y)] "
            ") where { fit = vec2"
        ),
        (
            "std.mtlx.sheen.conty_kulla_even: e(fit.x / max(fit.y, [0.001 -> 0.00075] )) where { "
            "fit = vec"
        ),
        (
            "std.mtlx.sheen.conty_kulla_even: e(fit.x / max(fit.y, [0.001 -> 0.00125] )) where { "
            "fit = vec"
        ),
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
            "std.mtlx.asking.cosine_of: 3) -> float = clamp( [dot(a, b), mtlx_least -> "
            "mtlx_least, dot(a, b)] , 1)"
        ),
        (
            "std.mtlx.facets.facets_of: is_even then clamp( [roughness.x, mtlx_least -> "
            "mtlx_least, roughness.x] , 1) else sqrt(width"
        ),
        (
            "std.mtlx.textures.share_within: c2) -> vec2 = clamp( [min(at, 1 - at) * size + 0.5, "
            "0 -> 0, min(at, 1 - at) * size + 0.5] , 1) /// The same of"
        ),
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
    "A square is never below 0, nor are shares of light.": (
        (
            "std.mtlx.closures.generalized_schlick_bsdf: factor, even, grey( "
            "[dot(vec3(facet_share…tor), vec3(1.0 / 3)) -> abs(dot(vec3(facet_s…or), vec3(1.0 / "
            "3)))] ), scatter_mode) whe"
        ),
        (
            "std.mtlx.geometry.heighttonormal: ight))) upright = if [dot(n, n) -> abs(dot(n, "
            "n))] < 1e-16 then vec3(0,"
        ),
        (
            "std.mtlx.textures.bordered: (0.5 * log2(max(max( [dot(dx, dx) -> abs(dot(dx, dx))] , "
            "dot(dy, dy)), 1)),"
        ),
        (
            "std.mtlx.textures.bordered: max(max(dot(dx, dx), [dot(dy, dy) -> abs(dot(dy, dy))] "
            "), 1)), 0) // Logari"
        ),
    ),
    "The cosine between two directions is the same from both.": (
        (
            "std.mtlx.closures.oren_nayar_diffuse_bsdf: eye) nv = cosine_of( [facing, "
            "asked.to_eye -> asked.to_eye, facing] ) nl = cosine_of(fac"
        ),
        (
            "std.mtlx.closures.oren_nayar_diffuse_bsdf: eye) nl = cosine_of( [facing, "
            "asked.to_light -> asked.to_light, facing] ) lv = cosine_of(ask"
        ),
        (
            "std.mtlx.closures.oren_nayar_diffuse_bsdf: ght) lv = cosine_of( [asked.to_light, "
            "asked.to_eye -> asked.to_eye, asked.to_light] ) response = if aske"
        ),
        (
            "std.mtlx.closures.burley_diffuse_bsdf: eye) nv = cosine_of( [facing, asked.to_eye "
            "-> asked.to_eye, facing] ) nl = cosine_of(fac"
        ),
        (
            "std.mtlx.closures.burley_diffuse_bsdf: eye) nl = cosine_of( [facing, asked.to_light "
            "-> asked.to_light, facing] ) lh = cosine_of(ask"
        ),
        (
            "std.mtlx.closures.burley_diffuse_bsdf: ght) lh = cosine_of( [asked.to_light, "
            "normalize(asked.to_light + asked.to_eye) -> normalize(asked.to_light + "
            "asked.to_eye), asked.to_light] ) response = if aske"
        ),
        (
            "std.mtlx.closures.chiang_hair_bsdf: eye) nv = cosine_of( [facing, asked.to_eye -> "
            "asked.to_eye, facing] ) widths = clamp((ro"
        ),
        (
            "std.mtlx.closures.generalized_schlick_edf: , pow(1 - cosine_of( "
            "[facing_normal(normal, to_eye), to_eye -> to_eye, facing_normal(normal, to_eye)] ), "
            "exponent))"
        ),
    ),
    "Shares of matt surfaces are the same if light and eye change places.": (
        (
            "std.mtlx.closures.oren_nayar_diffuse_bsdf: n compensated_share( [nv, nl -> nl, nv] "
            ", lv, roughness, col"
        ),
        (
            "std.mtlx.closures.oren_nayar_diffuse_bsdf: * oren_nayar_share( [nv, nl -> nl, nv] , "
            "lv, roughness)) el"
        ),
        (
            "std.mtlx.closures.burley_diffuse_bsdf: / pi * burley_share( [nv, nl -> nl, nv] , "
            "lh, roughness)) el"
        ),
    ),
    "Nothing passes through a metal, so what it takes and how it scatters does not count.": (
        "std.mtlx.closures.conductor_bsdf: , factor, even, rgb( [1 -> 0] , 1, 1), ScatterMode",
        "std.mtlx.closures.conductor_bsdf: , factor, even, rgb( [1 -> 2] , 1, 1), ScatterMode",
        "std.mtlx.closures.conductor_bsdf: factor, even, rgb(1, [1 -> 0] , 1), ScatterMode.R)",
        "std.mtlx.closures.conductor_bsdf: factor, even, rgb(1, [1 -> 2] , 1), ScatterMode.R)",
        "std.mtlx.closures.conductor_bsdf: tor, even, rgb(1, 1, [1 -> 0] ), ScatterMode.R).re",
        "std.mtlx.closures.conductor_bsdf: tor, even, rgb(1, 1, [1 -> 2] ), ScatterMode.R).re",
    ),
    "A weight that is exactly the least one gives what rounds to nothing.": (
        ("std.mtlx.closures.dielectric_bsdf: -> Bsdf = if weight [< -> <=] mtlx_least or scatte"),
        (
            "std.mtlx.closures.generalized_schlick_bsdf: -> Bsdf = if weight [< -> <=] "
            "mtlx_least or scatte"
        ),
    ),
    "Facets that are as wide along both axes may be asked as those that are not.": (
        (
            "std.mtlx.facets.facets_of: roughness.y width = [if is_even then clam…widths.x * "
            "widths.y) -> (sqrt(widths.x * widths.y))] } /// What facets se"
        ),
        (
            "std.mtlx.facets.facet_density: : Facets) -> float = [if facets.is_even th…al)), "
            "facets.widths) -> (ggx(vec3(dot(half, …l)), facets.widths))] where { along = norm"
        ),
    ),
    "The density of facets is the same for the opposite direction.": (
        ("std.mtlx.facets.facet_density: ets.normal, along)), [dot -> -dot] (half, facets.normal"),
    ),
    "The least number is far below those that there are, and only keeps divisors from 0.": (
        (
            "std.mtlx.facets.even_density: h + cosine2 * width, [1e-9 -> 1.25e-09] ))) /// The "
            "share of"
        ),
        (
            "std.mtlx.facets.even_density: h + cosine2 * width, [1e-9 -> 7.500000000000001e-10] "
            "))) /// The share of"
        ),
        (
            "std.mtlx.asking.mtlx_least: count. mtlx_least = [1e-8 -> 7.500000000000001e-09] /// "
            "The normal on th"
        ),
        (
            "std.mtlx.geometry.heighttonormal: ght = if dot(n, n) < [1e-16 -> 7.5e-17] then "
            "vec3(0, 0, 1) e"
        ),
        (
            "std.mtlx.hair.strand_light: pi) * dyed * share / [max(1 - dyed * share, mtlx_least) "
            "-> (1 - dyed * share)] ) * once * dyed * sh"
        ),
        (
            "std.mtlx.hair.strand_light: other(inner_sine) / [max(other(eye_sine / ior), "
            "mtlx_least) -> (other(eye_sine / ior))] ))) once = squared(1"
        ),
        (
            "std.mtlx.facets.facet_shares: = saturate(fits.xy / [max(fits.zw, 0.9) -> (fits.zw)] "
            ") where { widths = v"
        ),
    ),
    "A direction is made as long as one.": (
        "std.mtlx.geometry.normalmap: = 0) then vec3(0, 0, [1 -> 2] ) else 2 * value - 1",
    ),
    "Both sides of the limit give the same, but for 3e-5.": (
        "std.mtlx.hair.strand_cones: ces is_large = round [> -> >=] 12 large = max(round",
        (
            "std.mtlx.hair.strand_cones: = choose(variances < [0.1 -> 0.07500000000000001] , "
            "vec4(0.5 * exp(0.6"
        ),
        "std.mtlx.hair.strand_cones: = choose(variances < [0.1 -> 0.125] , vec4(0.5 * exp(0.6",
    ),
    "Bells are the same to both sides, and angles without whole turns.": (
        "std.mtlx.hair.strand_bells: widths bells = exp(- [abs -> -] (angles) / spreads)",
        (
            "std.mtlx.hair.strand_light: 2 * inner_turn + pi, [4 * inner_turn + 2 * pi -> 4 * "
            "inner_turn] ) // What is left of"
        ),
    ),
    "The normal of a strand is on the side of the eye.": (
        (
            "std.mtlx.hair.strand_light: ot(to_eye, across) - [dot(to_eye, normal) -> "
            "abs(dot(to_eye, normal))] * dot(to_light, acro"
        ),
        (
            "std.mtlx.hair.strand_light: (to_light, normal) * [dot(to_eye, normal) -> "
            "abs(dot(to_eye, normal))] ) flat = normalize(t"
        ),
    ),
    "Light is never turned more inside a strand than outside.": (
        "std.mtlx.hair.strand_light: bend, mtlx_least), - [1 -> 2] , 1) eye_turn = asin",
    ),
}
