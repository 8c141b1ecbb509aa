"""Changes of the library that no value can show, each with the reason.

Before one is written down here, look for a value that could: most survivors are missing truths.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from . import equivalent_cellular, equivalent_colors, equivalent_mtlx, equivalent_shapes
from .equivalent_lights import OF_LIGHTS
from .equivalent_reflectances import OF_REFLECTANCES

_BY_REASON: Mapping[str, Sequence[str]] = {
    **OF_LIGHTS,
    **OF_REFLECTANCES,
    "`nonzero` promises something to the compiler, and changes no value.": (
        (
            "std.lights.Point: ce : vector<world> = [nonzero(place - position) -> (place - "
            "position)] to_light = normalize"
        ),
        (
            "std.environments.FaceOfCube: <world> = normalize( [nonzero(face_ray(face, uv)) -> "
            "(face_ray(face, uv))] ) } /// The light th"
        ),
        (
            "std.tessellation.PNTriangles: normal = normalize( [nonzero( at.x * "
            "at.x…corner[0].normal ) ) -> (at.x * at.x * corne… corner[0].normal ))] ) } } /// The "
            "distan"
        ),
        (
            "std.tessellation.between: <world> = normalize( [nonzero(both - 2 * share * edge) -> "
            "(both - 2 * share * edge)] ) where { edge = las"
        ),
        (
            "std.tessellation.QuadraticSplines: normal = normalize( [nonzero(cross( sum "
            "j…er[4].position) ) )) -> (cross( sum j in 0..…er[4].position) ) ))] ) } } /// The "
            "weight"
        ),
        (
            "std.tessellation.BezierPatches: normal = normalize( [nonzero(cross( sum "
            "j…er[0].position) ) )) -> (cross( sum j in 0..…er[0].position) ) ))] ) } } /// "
            "Uniform bi"
        ),
        (
            "std.tessellation.SplinePatches: normal = normalize( [nonzero(cross( sum "
            "j…er[5].position) ) )) -> (cross( sum j in 0..…er[5].position) ) ))] ) } }"
        ),
        (
            "std.prelude.Surface: <world> = normalize( [nonzero(eye - position) -> (eye - "
            "position)] ) /// The position o"
        ),
    ),
    "`pow` of a negative number is 0 anyway, and a cosine is 1 at most.": (
        (
            "std.lights.FocusedSpot: alloff = peak * pow( [max(0, dot(axis, -to_light)) -> "
            "(dot(axis, -to_light))] , focus) / dot(to_pl"
        ),
        (
            "std.terms.mirrored: = 0 then 0 else pow( [saturate(dot(reflect(-to_light, normal), "
            "to_eye)) -> (dot(reflect(-to_light, normal), to_eye))] , power) /// Diffuse"
        ),
    ),
    "A vector's product with itself is not negative.": (
        (
            "std.masks.curvature_of_changes: ec3) -> float = (l * [dot(down, down) -> "
            "abs(dot(down, down))] - m * dot(across, do"
        ),
        (
            "std.masks.curvature_of_changes: (across, down) + n * [dot(across, across) -> "
            "abs(dot(across, across))] ) / (2 * dot(area, a"
        ),
        (
            "std.masks.curvature_of_changes: oss, across)) / (2 * [dot(area, area) -> "
            "abs(dot(area, area))] ) where { area = cro"
        ),
        (
            "std.patterns.hexagons: ond) * half is_one = [dot(one, one) -> abs(dot(one, one))] < "
            "dot(two, two) cell"
        ),
        (
            "std.patterns.hexagons: ne = dot(one, one) < [dot(two, two) -> abs(dot(two, two))] "
            "cell = if is_one the"
        ),
        (
            "std.gltf.PunctualPoint: hen 1 - squared(min( [dot(to_place, to_place) -> "
            "abs(dot(to_place, to_place))] / max(squared(reach)"
        ),
        (
            "std.gltf.PunctualPoint: 1 falloff = fading / [dot(to_place, to_place) -> "
            "abs(dot(to_place, to_place))] } /// The same withi"
        ),
        (
            "std.lights.FocusedSpot: to_light)), focus) / [dot(to_place, to_place) -> "
            "abs(dot(to_place, to_place))] } /// The sky above"
        ),
        (
            "std.tessellation.between: t(edge, both) / max( [dot(edge, edge) -> abs(dot(edge, "
            "edge))] , 1e-12) } // ---- p"
        ),
    ),
    "The order of two vectors does not count for an angle, nor for the length of their product.": (
        (
            "std.masks.slope_mask: , high, slope_angle( [normal, up -> up, normal] )) /// How bent "
            "a su"
        ),
        (
            "std.masks.curvature_of_changes: here { area = cross( [across, down -> down, across] ) "
            "l = dot(bent_acros"
        ),
    ),
    "The order of lanes does not count for a length.": (
        "std.billboards.Billboard: billboard_origin[0]. [xyz -> zyx] ), length(billboard_",
        "std.billboards.Billboard: billboard_origin[1]. [xyz -> zyx] ), length(billboard_",
        "std.billboards.Billboard: billboard_origin[2]. [xyz -> zyx] ) ) object_drawn = o",
    ),
    "The sign of the third axis is 1 or -1.": (
        "std.tangents.Tangents: ted.normal, tangent) [* -> /] tangent_handedness t",
        "std.gltf.MetallicRoughness: (tangent_handedness [* -> /] object_handedness) >",
        "std.gltf.MetallicRoughness: * object_handedness) [> -> >=] 0) /// As the map be",
    ),
    (
        "The half vector is between the light and the eye, so that its cosine to either is not "
        "negative."
    ): (
        "std.gltf.metallic_rough: + (1 - f0) * pow(1 - [saturate -> abs] (dot(to_eye, half)),",
        (
            "std.gltf.metallic_rough: + (1 - f0) * pow(1 - [saturate(dot(to_eye, half)) -> "
            "(dot(to_eye, half))] , 5) scattered = (1"
        ),
        (
            "std.gltf.metallic_rough: * pow(1 - saturate( [dot(to_eye, half) -> abs(dot(to_eye, "
            "half))] ), 5) scattered = (1"
        ),
    ),
    "`clamp` finds the middle one of three numbers.": (
        (
            "std.shadows.ShadowedSpot: (place, axis, clamp( [outer, 1deg -> 1deg, outer] , 80deg), "
            "nearest, m"
        ),
    ),
    "The nine places are the same if all of them change sides.": (
        "std.shadows.share_lit: 0..9 : shadow(at.xy [+ -> -] spread * neighbour(i",
        "std.shadows.share_lit: 0..9 : shadow(at.xy [+ -> -] spread * neighbour(i (2)",
    ),
    "The steps are -1, 0 and 1, and what is divided by 0 is 0.": (
        "std.shadows.share_lit: hadow(at.xy + spread [* -> /] neighbour(i) / vec2(",
        "std.shadows.share_lit: hadow(at.xy + spread [* -> /] neighbour(i) / vec2( (2)",
    ),
    "The farthest corner is one of the four far ones, as these are those before, further away.": (
        "std.shadows.cascade: 8 radius = max i in [0 -> 1] ..8 : distance(corne",
        "std.shadows.cascade: radius = max i in 0 [ -> + 1] ..8 : distance(corne",
    ),
    "Corner -1 is corner 1.": (
        "std.shadows.cascade: radius = max i in 0 [ -> - 1] ..8 : distance(corne",
    ),
    "No number less 1 is exactly 0.001.": (
        "std.shadows.slice_end: = if abs(ratio - 1) [< -> <=] 0.001 then even else",
    ),
    "`look_at` takes only the direction of what is up.": (
        "std.shadows.seen_by_sun: 0.9 then vec3(0, 0, [1 -> 2] ) else vec3(0, 1, 0)",
        "std.shadows.seen_by_sun: , 0, 1) else vec3(0, [1 -> 2] , 0) } /// The numbe",
        "std.frames.seen_from: xis) then vec3(0, 0, [1 -> 2] ) else vec3(0, 1, 0)",
        "std.frames.seen_from: , 0, 1) else vec3(0, [1 -> 2] , 0) } /// The view",
    ),
    "The last camera is the result anyway, if no other one shows the point.": (
        "std.shadows.first_to_show: int = min i in 0..N [ -> + 1] : if shows(cameras[i",
        "std.shadows.first_to_show: int = min i in 0..N [ -> - 1] : if shows(cameras[i",
    ),
    "What is read behind the end of a buffer is its last element, which counts already.": (
        "std.reductions.Least: in(min i in 0..count [ -> + 1] up to 64 from before",
        "std.reductions.Greatest: ax(max i in 0..count [ -> + 1] up to 64 from before",
    ),
    "A block has 64 elements, by one of two bounds.": (
        (
            "std.reductions.BlockCounts: = index * 64 last = [min(first + 64, counts.count) -> "
            "(counts.count)] /// The sum of the c"
        ),
        "std.reductions.BlockCounts: 4 last = min(first + [64 -> 65] , counts.count) ///",
        "std.reductions.BlockCounts: in first..last up to [64 -> 65] : counts[i] } /// Th",
    ),
    "64 is the size of work groups without it.": (
        (
            "std.reductions.PrefixSums: has to leave it so. [work_group of 64 -> ] /// As for "
            "`BlockCou"
        ),
    ),
    "A texture without levels has only the first one: `mip = none`.": (
        "std.environments.MattLight: ersley(i, samples)), [0 -> 1] ).rgb) / float(sampl",
        "std.environments.GlossyLight: samples, roughness), [0 -> 1] ).rgb) / heights, 1",
    ),
    "Sample -1 is at the rim of what facets can face, and mirrors to behind the surface.": (
        "std.environments.GlossyLight: heights = sum i in 0 [ -> - 1] ..samples : weight(m",
        "std.environments.GlossyLight: = vec4( (sum i in 0 [ -> - 1] ..samples : weight(m",
    ),
    "`up to` says that there are no more facets.": (
        "std.environments.mirrored_share: (sum i in 0..n up to [1024 -> 1025] : share_of(facet_nor",
    ),
    "Light along the surface has no share, and what is divided by 0 is 0.": (
        "std.environments.share_of: -> vec2 = if along.z [> -> >=] 0 and facet.z > 0 th",
        "std.environments.share_of: ng.z > 0 and facet.z [> -> >=] 0 then seen * vec2(1",
    ),
    "No face of a cube has x downwards.": (
        "std.frames.through_face: mat4( vec4(right.x, [- -> ] down.x, depth * ahea",
    ),
    "Of an edge's levels from one end to the other and back, the larger one counts anyway.": (
        (
            "std.tessellation.Displaced: ssellate triangle by [max(end[0].fineness, "
            "end[1].fineness) -> (end[0].fineness)] { position = inherit"
        ),
        (
            "std.tessellation.Displaced: ssellate triangle by [max(end[0].fineness, "
            "end[1].fineness) -> (end[1].fineness)] { position = inherit"
        ),
        (
            "std.tessellation.DisplacedQuads: d tessellate quad by [max(end[0].fineness, "
            "end[1].fineness) -> (end[0].fineness)] { position = inherit"
        ),
        (
            "std.tessellation.DisplacedQuads: d tessellate quad by [max(end[0].fineness, "
            "end[1].fineness) -> (end[1].fineness)] { position = inherit"
        ),
        (
            "std.tessellation.PhongTessellation: ssellate triangle by [max(end[0].fineness, "
            "end[1].fineness) -> (end[0].fineness)] as at { position = i"
        ),
        (
            "std.tessellation.PhongTessellation: ssellate triangle by [max(end[0].fineness, "
            "end[1].fineness) -> (end[1].fineness)] as at { position = i"
        ),
        (
            "std.tessellation.PNTriangles: ssellate triangle by [max(end[0].fineness, "
            "end[1].fineness) -> (end[0].fineness)] as at { position = i"
        ),
        (
            "std.tessellation.PNTriangles: ssellate triangle by [max(end[0].fineness, "
            "end[1].fineness) -> (end[1].fineness)] as at { position = i"
        ),
        (
            "std.tessellation.QuadraticSplines: ends [0, 1, 4, 3] by [max(end[0].fineness, "
            "end[1].fineness) -> (end[0].fineness)] as at { position = c"
        ),
        (
            "std.tessellation.QuadraticSplines: ends [0, 1, 4, 3] by [max(end[0].fineness, "
            "end[1].fineness) -> (end[1].fineness)] as at { position = c"
        ),
        (
            "std.tessellation.BezierPatches: ds [0, 3, 15, 12] by [max(end[0].fineness, "
            "end[1].fineness) -> (end[0].fineness)] as at { position = c"
        ),
        (
            "std.tessellation.BezierPatches: ds [0, 3, 15, 12] by [max(end[0].fineness, "
            "end[1].fineness) -> (end[1].fineness)] as at { position = c"
        ),
        (
            "std.tessellation.SplinePatches: nds [5, 6, 10, 9] by [max(end[0].fineness, "
            "end[1].fineness) -> (end[0].fineness)] as at { position = c"
        ),
        (
            "std.tessellation.SplinePatches: nds [5, 6, 10, 9] by [max(end[0].fineness, "
            "end[1].fineness) -> (end[1].fineness)] as at { position = c"
        ),
        "std.tessellation.Displaced: triangle by max(end[ [0 -> 1] ].fineness, end[1].f",
        "std.tessellation.DisplacedQuads: ate quad by max(end[ [0 -> 1] ].fineness, end[1].f",
        "std.tessellation.PhongTessellation: triangle by max(end[ [0 -> 1] ].fineness, end[1].f",
        "std.tessellation.PNTriangles: triangle by max(end[ [0 -> 1] ].fineness, end[1].f",
        "std.tessellation.QuadraticSplines: 1, 4, 3] by max(end[ [0 -> 1] ].fineness, end[1].f",
        "std.tessellation.BezierPatches: 15, 12] by max(end[ [0 -> 1] ].fineness, end[1].f",
        "std.tessellation.SplinePatches: , 10, 9] by max(end[ [0 -> 1] ].fineness, end[1].f",
        "std.tessellation.Displaced: nd[0].fineness, end[ [1 -> 0] ].fineness) { positi",
        "std.tessellation.DisplacedQuads: nd[0].fineness, end[ [1 -> 0] ].fineness) { positi",
        "std.tessellation.PhongTessellation: nd[0].fineness, end[ [1 -> 0] ].fineness) as at {",
        "std.tessellation.PNTriangles: nd[0].fineness, end[ [1 -> 0] ].fineness) as at {",
        "std.tessellation.QuadraticSplines: nd[0].fineness, end[ [1 -> 0] ].fineness) as at {",
        "std.tessellation.BezierPatches: nd[0].fineness, end[ [1 -> 0] ].fineness) as at {",
        "std.tessellation.SplinePatches: nd[0].fineness, end[ [1 -> 0] ].fineness) as at {",
    ),
    "The normal in the middle of an edge is the same from either end.": (
        (
            "std.tessellation.PNTriangles: .x * at.y * between( [corner[0].position, "
            "corner[1].position -> corner[1].position, corner[0].position] , corner[0].normal,"
        ),
        (
            "std.tessellation.PNTriangles: .y * at.z * between( [corner[1].position, "
            "corner[2].position -> corner[2].position, corner[1].position] , corner[1].normal,"
        ),
        (
            "std.tessellation.PNTriangles: .z * at.x * between( [corner[2].position, "
            "corner[0].position -> corner[0].position, corner[2].position] , corner[2].normal,"
        ),
        (
            "std.tessellation.PNTriangles: corner[1].position, [corner[0].normal, corner[1].normal "
            "-> corner[1].normal, corner[0].normal] ) + at.y * at.z * be"
        ),
        (
            "std.tessellation.PNTriangles: corner[2].position, [corner[1].normal, corner[2].normal "
            "-> corner[2].normal, corner[1].normal] ) + at.z * at.x * be"
        ),
        (
            "std.tessellation.PNTriangles: corner[0].position, [corner[2].normal, corner[0].normal "
            "-> corner[0].normal, corner[2].normal] ) )) } } /// The dis"
        ),
    ),
    "Both lanes have the same bound.": (
        "std.frames.is_in_picture: > 0 and all(abs(at. [xy -> yx] ) <= vec2((1 - margi",
    ),
    "The weights of slopes add up to 0, so that it does not matter what they count from.": (
        (
            "std.tessellation.QuadraticSplines: c_slope(at.x)[i] * ( [corner[3 * j + i].position - "
            "corner[4].position -> corner[3 * j + i].position] ) ), sum j in 0..3 :"
        ),
        (
            "std.tessellation.BezierPatches: n_slope(at.x)[i] * ( [corner[4 * j + i].position - "
            "corner[0].position -> corner[4 * j + i].position] ) ), sum j in 0..4 :"
        ),
        (
            "std.tessellation.SplinePatches: e_slope(at.x)[i] * ( [corner[4 * j + i].position - "
            "corner[5].position -> corner[4 * j + i].position] ) ), sum j in 0..4 :"
        ),
        (
            "std.tessellation.QuadraticSplines: _spline(at.x)[i] * ( [corner[3 * j + i].position - "
            "corner[4].position -> corner[3 * j + i].position] ) ) ))) } } /// The"
        ),
        (
            "std.tessellation.BezierPatches: rnstein(at.x)[i] * ( [corner[4 * j + i].position - "
            "corner[0].position -> corner[4 * j + i].position] ) ) ))) } } /// Unif"
        ),
        (
            "std.tessellation.SplinePatches: spline(at.x)[i] * ( [corner[4 * j + i].position - "
            "corner[5].position -> corner[4 * j + i].position] ) ) ))) } }"
        ),
        "std.tessellation.QuadraticSplines: ].position - corner[ [4 -> 3] ].position) ), sum j",
        "std.tessellation.QuadraticSplines: ].position - corner[ [4 -> 5] ].position) ), sum j",
        "std.tessellation.QuadraticSplines: ].position - corner[ [4 -> 3] ].position) ) ))) }",
        "std.tessellation.QuadraticSplines: ].position - corner[ [4 -> 5] ].position) ) ))) }",
        "std.tessellation.BezierPatches: ].position - corner[ [0 -> 1] ].position) ), sum j",
        "std.tessellation.BezierPatches: ].position - corner[ [0 -> 1] ].position) ) ))) }",
        "std.tessellation.SplinePatches: ].position - corner[ [5 -> 4] ].position) ), sum j",
        "std.tessellation.SplinePatches: ].position - corner[ [5 -> 6] ].position) ), sum j",
        "std.tessellation.SplinePatches: ].position - corner[ [5 -> 4] ].position) ) ))) }",
        "std.tessellation.SplinePatches: ].position - corner[ [5 -> 6] ].position) ) ))) }",
    ),
    "The weights of slopes add up to 0, and beyond a net all points are one.": (
        "std.tessellation.QuadraticSplines: ro(cross( sum j in 0 [ -> - 1] ..3 : quadratic_spli",
        "std.tessellation.BezierPatches: ro(cross( sum j in 0 [ -> - 1] ..4 : bernstein(at.y",
        "std.tessellation.SplinePatches: ro(cross( sum j in 0 [ -> - 1] ..4 : spline(at.y)[j",
        "std.tessellation.QuadraticSplines: (cross( sum j in 0.. [3 -> 4] : quadratic_spline(a",
        "std.tessellation.BezierPatches: (cross( sum j in 0.. [4 -> 5] : bernstein(at.y)[j]",
        "std.tessellation.SplinePatches: (cross( sum j in 0.. [4 -> 5] : spline(at.y)[j] *",
        "std.tessellation.QuadraticSplines: cross( sum j in 0..3 [ -> + 1] : quadratic_spline(a",
        "std.tessellation.BezierPatches: cross( sum j in 0..4 [ -> + 1] : bernstein(at.y)[j]",
        "std.tessellation.SplinePatches: cross( sum j in 0..4 [ -> + 1] : spline(at.y)[j] *",
    ),
    "Before the first row all points are the first one, from which distances count.": (
        "std.tessellation.BezierPatches: ition + ( sum j in 0 [ -> - 1] ..4 : bernstein(at.y",
        "std.tessellation.BezierPatches: ition) ), sum j in 0 [ -> - 1] ..4 : bernstein_slop",
    ),
    "A train of pulses has the period 1.": (
        "std.patterns.bricks: .y - 0.25 * mortar.y [- -> +] 0.5, duty, 0.5 * wid",
    ),
    "The factor is 0 or 1, and what is divided by 0 is 0.": (
        "std.patterns.bricks: = vec2(p.x - offset [* -> /] float(row & 1), p.y)",
    ),
    "A vector is as long as one with the same lanes in another order, also seen from (1, 1).": (
        (
            "std.patterns.truchet: if turned then vec2( [1 - fract(p.x), fract(p.y) -> "
            "fract(p.y), 1 - fract(p.x)] ) else fract(p) } //"
        ),
    ),
    "Of 2^24 numbers only one is exactly a half.": (
        "std.patterns.truchet: te_noise(cell_of(p)) [< -> <=] 0.5 at = if turned t",
    ),
    "What is straight ahead of the eye is neither beside nor above it.": (
        "std.transforms.look_at: c4(-dot(right, vec3( [eye -> target] )), -dot(above, vec3",
        "std.transforms.look_at: ), -dot(above, vec3( [eye -> target] )), -dot(back, vec3(",
    ),
}
"""The reasons, each with the changes as ``Change.told`` says them."""

EQUIVALENT = {
    told: reason
    for by_reason in (
        _BY_REASON,
        equivalent_cellular.BY_REASON,
        equivalent_colors.BY_REASON,
        equivalent_mtlx.BY_REASON,
        equivalent_shapes.BY_REASON,
    )
    for reason, all_told in by_reason.items()
    for told in all_told
}
"""The changes, each with the reason."""
