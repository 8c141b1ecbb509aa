"""Changes of shapes, mapping, rotations and sampling that change no value, with the reasons."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

BY_REASON: Mapping[str, Sequence[str]] = {
    "A vector's product with itself is not negative.": (
        (
            "std.distances.segment: (dot(p - a, b - a) / [dot(b - a, b - a) -> abs(dot(b - a, b "
            "- a))] ) * (b - a)) /// All"
        ),
        (
            "std.mapping.unpacked_normal: gth * lean, sqrt(1 - [dot(lean, lean) -> abs(dot(lean, "
            "lean))] ))) where { lean = 2"
        ),
    ),
    "`clamp` finds the middle one of three numbers.": (
        (
            "std.distances.repeated: p - spacing * clamp( [round(p / spacing), -cells -> -cells, "
            "round(p / spacing)] , cells) /// `n` sha"
        ),
        (
            "std.distances.elongated: T) -> T = p - clamp( [p, -extent -> -extent, p] , extent) "
            "/// Turns"
        ),
        (
            "std.mapping.crisp_uv: ec2 = (seam + clamp( [(uv * size - seam) / max(width, 1e-6), "
            "-0.5 -> -0.5, (uv * size - seam) / max(width, 1e-6)] , 0.5)) / size where"
        ),
        (
            "std.distances.hexagon: folded - vec2(clamp( [folded.x, -corner -> -corner, "
            "folded.x] , corner), radius) }"
        ),
        (
            "std.distances.pie: olded - end * clamp( [dot(folded, end), 0 -> 0, dot(folded, "
            "end)] , radius)) } /// A p"
        ),
    ),
    "Half of a circle of numbers, added or taken away, is the same place on it.": (
        "std.sampling.r2: int(i) * 3242174889u [+ -> -] 0x80000000u), share(",
        "std.sampling.r2: int(i) * 2447445414u [+ -> -] 0x80000000u)) /// Th",
    ),
    "Nearly opposite directions are turned alike by a little more or less than the limit.": (
        "std.quaternions.from_directions: 3) -> vec4 = if both [< -> <=] 1e-6 then vec4(norma",
        (
            "std.quaternions.from_directions: -> vec4 = if both < [1e-6 -> 7.5e-07] then "
            "vec4(normalize("
        ),
        (
            "std.quaternions.from_directions: -> vec4 = if both < [1e-6 -> "
            "1.2499999999999999e-06] then vec4(normalize("
        ),
    ),
    "The formula for each lane is exact as long as this lane is not near 0.": (
        "std.quaternions.from_matrix: + m[1].y + m[2].z > [0 -> 1] then vec4(m[1].z - m",
        "std.quaternions.from_matrix: [2].z) else if m[0]. [x -> y] > m[1].y and m[0].x",
        "std.quaternions.from_matrix: else if m[0].x > m[ [1 -> 0] ].y and m[0].x > m[2",
        "std.quaternions.from_matrix: se if m[0].x > m[1]. [y -> x] and m[0].x > m[2].z",
        "std.quaternions.from_matrix: 0].x > m[1].y and m[ [0 -> 1] ].x > m[2].z then ve",
        "std.quaternions.from_matrix: x > m[1].y and m[0]. [x -> y] > m[2].z then vec4(1",
        "std.quaternions.from_matrix: > m[1].y and m[0].x [> -> >=] m[2].z then vec4(1 +",
        "std.quaternions.from_matrix: 2].y) else if m[1].y [> -> >=] m[2].z then vec4(m[0",
        "std.quaternions.from_matrix: .x + m[1].y + m[2].z [> -> >=] 0 then vec4(m[1].z -",
        "std.quaternions.from_matrix: else if m[0].x > m[ [1 -> 2] ].y and m[0].x > m[2",
        "std.quaternions.from_matrix: y and m[0].x > m[2]. [z -> x] then vec4(1 + m[0].x",
        "std.quaternions.from_matrix: 2].z) else if m[0].x [> -> >=] m[1].y and m[0].x >",
        "std.quaternions.from_matrix: + m[2].z) else if m[ [0 -> 1] ].x > m[1].y and m[0",
        "std.quaternions.from_matrix: 1].y and m[0].x > m[ [2 -> 1] ].z then vec4(1 + m[",
    ),
    "Its magnitude counts alone, whichever sign it has.": (
        (
            "std.quaternions.slerp: here { cosine = abs( [dot(a, b) -> abs(dot(a, b))] ) between "
            "= acos(cos"
        ),
        "std.quaternions.slerp: here { cosine = abs( [dot -> -dot] (a, b)) between = ac",
    ),
    "Two axes of which either is at an angle to the direction: each may be left out.": (
        "std.quaternions.from_directions: aside = if abs(a.x) [> -> >=] abs(a.z) then vec3(-",
    ),
    "At the limit both ways from one rotation to another are the same.": (
        "std.quaternions.slerp: -> vec4 = if cosine [> -> >=] 0.9999 then nlerp(a,",
    ),
    "A lane before the first one is the first one, and one behind the last one is the last one.": (
        "std.distances.box: 0)) + min(max i in 0 [ -> - 1] ..N : beyond[i], 0)",
        "std.distances.box: + min(max i in 0..N [ -> + 1] : beyond[i], 0) wher",
        "std.distances.ellipsoid: pe else -(min i in 0 [ -> - 1] ..N : radii[i]) wher",
        "std.distances.ellipsoid: else -(min i in 0..N [ -> + 1] : radii[i]) where {",
    ),
    "A segment is the same from both of its ends.": (
        "std.distances.triangle: , b), min(segment(p, [b, c -> c, b] ), segment(p, c, a))",
        "std.distances.triangle: p, b, c), segment(p, [c, a -> a, c] ))) turn = doubled_a",
        "std.distances.capsule: > float = segment(p, [a, b -> b, a] ) - radius /// All t",
        "std.distances.triangle: dge = min(segment(p, [a, b -> b, a] ), min(segment(p, b,",
        (
            "std.distances.beside: > float = segment(p, [vec3(0, radius, 0), vec3(0, 0, radius) "
            "-> vec3(0, 0, radius), vec3(0, radius, 0)] ) /// A point of spa"
        ),
        "std.distances.cone: ), foot), segment(q, [foot, tip -> tip, foot] )) } /// A hexagon,",
        (
            "std.distances.cone: dge = min(segment(q, [vec2(0), foot -> foot, vec2(0)] ), "
            "segment(q, foot,"
        ),
        "std.distances.star: ge = segment(folded, [tip, notch -> notch, tip] ) } /// A polygon wi",
    ),
    "Only in the middle itself both lengths are 0.": (
        "std.distances.ellipsoid: t, N>) -> float = if [slope -> scaled] > 0 then scaled * (s",
    ),
    "On the edge itself the distance is 0, on whichever side it counts.": (
        "std.distances.triangle: oubled_area(c, a, p) [> -> >=] 0 } /// Twice the ar",
    ),
    "Half a turn forwards and half a turn backwards end at the same place.": (
        "std.mapping.equirectangular_direction: und = 2 * pi * (uv.x [- -> +] 0.5) } /// Wraps a p",
    ),
    "Along the edge on which an octahedron is folded, both halves have the same points.": (
        "std.mapping.octahedral_uv: 0.5 + 0.5 * (if d.z [< -> <=] 0 then outside_in(fl",
        "std.mapping.octahedral_direction: alize(vec3(if height [< -> <=] 0 then outside_in(fl",
    ),
    "A factor of 1 or -1 is its own reciprocal.": (
        "std.mapping.reoriented_blend: , 1) turned = detail [* -> /] vec3(-1, -1, 1) } //",
        "std.mapping.outside_in: = (1 - abs(flat.yx)) [* -> /] choose(flat < 0, vec",
        "std.quaternions.blended: where { w = weights [* -> /] vec4(1, side_of(moti",
        "std.distances.hexagon: oat = length(beyond) [* -> /] sign(beyond.y) where",
    ),
    "A period is the same a whole period later, and its time and phase are added.": (
        "std.mapping.flowed: t(flow_uv(uv, flow, [time, 0.5 -> 0.5, time] ) + 0.5), flow_share",
        "std.mapping.flowed: (t(flow_uv(uv, flow, [time, 0 -> 0, time] )), t(flow_uv(uv, fl",
        "std.mapping.flowed: w_uv(uv, flow, time, [0 -> 1] )), t(flow_uv(uv, fl",
    ),
    "On the diagonal of a cell the triangles of both sides have the same corners that count.": (
        "std.mapping.hex_tiles: > HexTiles = if rest [< -> <=] 0 then HexTiles(base",
    ),
    "Without a step the surface itself is met.": (
        "std.mapping.parallax_occlusion: tep(0, depths(uv).r, [0 -> 1] ) up to 64 while s.d",
    ),
    "Each number but 0 and 1 is the third axis.": (
        "std.mapping.triplanar_normal: 1, 2 * t(plane_uv(p, [2 -> 3] )).xyz - 1, normal,",
        "std.mapping.triplanar: ts.z * t(plane_uv(p, [2 -> 3] )) /// The same by t",
    ),
    "Of two axes that are as near, either may be the farthest.": (
        "std.mapping.biplanar: if n.x > n.y and n.x [> -> >=] n.z then 0 else if n",
        "std.mapping.biplanar: z then 0 else if n.y [> -> >=] n.z then 1 else 2 le",
        "std.mapping.biplanar: lse 2 least = if n.x [<= -> <] n.y and n.x <= n.z t",
        "std.mapping.biplanar: z then 0 else if n.y [<= -> <] n.z then 1 else 2 ne",
        "std.mapping.biplanar: f n.x <= n.y and n.x [<= -> <] n.z then 0 else if n",
        "std.mapping.biplanar: ddy(p) most = if n.x [> -> >=] n.y and n.x > n.z th",
    ),
    "Opposite directions lie along the same axis.": (
        "std.quaternions.from_directions: = if abs(a.x) > abs( [a -> b] .z) then vec3(-a.y,",
        "std.quaternions.from_directions: , b) aside = if abs( [a -> b] .x) > abs(a.z) then",
    ),
    "Two motions are on the same side of each other.": (
        (
            "std.quaternions.blended: otions[1]), side_of( [motions[0], motions[2] -> "
            "motions[2], motions[0]] ), side_of(motions[0"
        ),
        (
            "std.quaternions.blended: otions[2]), side_of( [motions[0], motions[3] -> "
            "motions[3], motions[0]] )) } /// -1 for a mo"
        ),
        (
            "std.quaternions.blended: s * vec4(1, side_of( [motions[0], motions[1] -> "
            "motions[1], motions[0]] ), side_of(motions[0"
        ),
    ),
    "On a diagonal of the square both sides give the same point.": (
        "std.sampling.concentric_disc: vec2 = if abs(at.x) [> -> >=] abs(at.y) then at.x",
    ),
    "The step is even, so that the last bit, which is left out, does not carry.": (
        "std.sampling.r2: t(i) * 2447445414u + [0x80000000 -> 2147483649] u)) /// The first 24",
    ),
    "Three turns have one sign, whichever of them the others are compared with.": (
        "std.distances.triangle: = doubled_area(a, b, [c -> p] ) inside = turn * do",
        "std.distances.triangle: , b, p) > 0 and turn [* -> /] doubled_area(b, c, p",
        "std.distances.triangle: b, c) inside = turn [* -> /] doubled_area(a, b, p",
    ),
    "Neither lengths nor intersections depend on an order.": (
        (
            "std.distances.extruded: ere { beyond = vec2( [flat_distance, abs(z) - half_height "
            "-> abs(z) - half_height, flat_distance] ) } // ---- of dista"
        ),
        "std.distances.revolved: ec2 = vec2(length(p. [xz -> zx] ), p.y) /// What ext",
        (
            "std.distances.coverage: e(away, length(vec2( [ddx(away), ddy(away) -> ddy(away), "
            "ddx(away)] ))) /// The same by"
        ),
        (
            "std.distances.smooth_difference: smooth_intersection( [a, -b -> -b, a] , k) /// The "
            "depth o"
        ),
        (
            "std.distances.cross_shape: nd.y) within = vec2( [extent.y - folded.x, -out -> -out, "
            "extent.y - folded.x] ) } /// A slice of a"
        ),
    ),
    "On a limit itself both sides have the same distance.": (
        "std.distances.arc: if end.y * folded.x [> -> >=] end.x * folded.y the",
        "std.distances.cone: d_area(foot, tip, q) [> -> >=] 0 then -edge else ed",
        "std.distances.cone: t) -> float = if q.y [> -> >=] 0 and doubled_area(f",
        "std.distances.cross_shape: 2) -> float = if out [> -> >=] 0 then length(max(be",
        "std.distances.heart: 738 else if folded.x [> -> >=] folded.y then side e",
        "std.distances.heart: folded.x + folded.y [> -> >=] 1 then distance(fold",
        "std.distances.octahedron: > float = if 3 * q.x [< -> <=] out then beside(q, r",
        "std.distances.octahedron: ius) else if 3 * q.y [< -> <=] out then beside(q.yz",
        "std.distances.octahedron: ius) else if 3 * q.z [< -> <=] out then beside(q.zx",
        "std.distances.pie: if end.y * folded.x [> -> >=] end.x * folded.y the",
        "std.distances.star: (tip, notch, folded) [< -> <=] 0 then -edge else ed",
        "std.distances.triangle: oubled_area(a, b, p) [> -> >=] 0 and turn * doubled",
        "std.distances.triangle: oubled_area(b, c, p) [> -> >=] 0 and turn * doubled",
    ),
}
"""The reasons, each with the changes as ``Change.told`` says them."""
