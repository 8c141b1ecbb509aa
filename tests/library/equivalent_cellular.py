"""Changes of cells around points that no value can show, each with the reason.

``equivalent.py`` says more.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

BY_REASON: Mapping[str, Sequence[str]] = {
    "Metrics have numbers only to be told apart.": (
        "std.cellular.chebyshev: an axis. chebyshev = [2 -> 3] /// The length of a",
    ),
    "The nearest point adds 1 to the total; `max` promises so to the compiler.": (
        "std.cellular.smooth_distance: known.least - log2( [max(known.total, 1) -> (known.total)] "
        ") / sharpness /// `w",
        "std.cellular.smooth_distance: og2(max(known.total, [1 -> 0] )) / sharpness /// `",
    ),
    "Half of a cell to either side is the same place in a cell.": (
        "std.cellular.to_corner: 2)) - 1.5 - fract(p [- -> +] 0.5) /// The same in",
        "std.cellular.to_corner: 4)) - 1.5 - fract(p [- -> +] 0.5) /// The way fro",
    ),
    "The first point that is looked at replaces what there is at first.": (
        "std.cellular.smooth_worley_noise: from SmoothMinimum( [8 -> 7] , 0) for i in 0..16",
        "std.cellular.smooth_worley_noise: from SmoothMinimum( [8 -> 9] , 0) for i in 0..16",
        "std.cellular.smooth_worley_noise: from SmoothMinimum( [8 -> 7] , 0) for i in 0..64",
        "std.cellular.smooth_worley_noise: from SmoothMinimum( [8 -> 9] , 0) for i in 0..64",
        "std.cellular.voronoi: known from Voronoi2( [8 -> 7] , 8, ivec2(0), vec2(",
        "std.cellular.voronoi: known from Voronoi2( [8 -> 9] , 8, ivec2(0), vec2(",
        "std.cellular.voronoi: own from Voronoi2(8, [8 -> 7] , ivec2(0), vec2(0))",
        "std.cellular.voronoi: own from Voronoi2(8, [8 -> 9] , ivec2(0), vec2(0))",
        "std.cellular.voronoi: oronoi2(8, 8, ivec2( [0 -> 1] ), vec2(0)) for i in",
        "std.cellular.voronoi: , 8, ivec2(0), vec2( [0 -> 1] )) for i in 0..16 :",
        "std.cellular.voronoi: known from Voronoi3( [8 -> 7] , 8, ivec3(0), vec3(",
        "std.cellular.voronoi: known from Voronoi3( [8 -> 9] , 8, ivec3(0), vec3(",
        "std.cellular.voronoi: own from Voronoi3(8, [8 -> 7] , ivec3(0), vec3(0))",
        "std.cellular.voronoi: own from Voronoi3(8, [8 -> 9] , ivec3(0), vec3(0))",
        "std.cellular.voronoi: oronoi3(8, 8, ivec3( [0 -> 1] ), vec3(0)) for i in",
        "std.cellular.voronoi: , 8, ivec3(0), vec3( [0 -> 1] )) for i in 0..64 :",
    ),
    "Beyond the cells that are looked at, no point is among the nearest.": (
        "std.cellular.voronoi: vec2(0)) for i in 0 [ -> - 1] ..16 : nearer_featur",
        "std.cellular.voronoi: ec2(0)) for i in 0.. [16 -> 17] : nearer_feature(kno",
        "std.cellular.voronoi: 2(0)) for i in 0..16 [ -> + 1] : nearer_feature(kno",
        "std.cellular.voronoi: vec3(0)) for i in 0 [ -> - 1] ..64 : nearer_featur",
        "std.cellular.voronoi: ec3(0)) for i in 0.. [64 -> 65] : nearer_feature(kno",
        "std.cellular.voronoi: 3(0)) for i in 0..64 [ -> + 1] : nearer_feature(kno",
        "std.cellular.worley_noise: > float = min i in 0 [ -> - 1] ..16 : measured_in(t",
        "std.cellular.worley_noise: float = min i in 0.. [16 -> 17] : measured_in(to_fea",
        "std.cellular.worley_noise: oat = min i in 0..16 [ -> + 1] : measured_in(to_fea",
        "std.cellular.worley_noise: > float = min i in 0 [ -> - 1] ..64 : measured_in(t",
        "std.cellular.worley_noise: float = min i in 0.. [64 -> 65] : measured_in(to_fea",
        "std.cellular.worley_noise: oat = min i in 0..64 [ -> + 1] : measured_in(to_fea",
        "std.cellular.tiling_worley_noise: > float = min i in 0 [ -> - 1] ..16 : length(to_cor",
        "std.cellular.tiling_worley_noise: float = min i in 0.. [16 -> 17] : length(to_corner(p",
        "std.cellular.tiling_worley_noise: oat = min i in 0..16 [ -> + 1] : length(to_corner(p",
        "std.cellular.tiling_worley_noise: > float = min i in 0 [ -> - 1] ..64 : length(to_cor",
        "std.cellular.tiling_worley_noise: float = min i in 0.. [64 -> 65] : length(to_corner(p",
        "std.cellular.tiling_worley_noise: oat = min i in 0..64 [ -> + 1] : length(to_corner(p",
    ),
    "No point of a cell at the corner is the nearest: one of the place's own cell is as near.": (
        "std.cellular.worley_noise: -> float = min i in [0 -> 1] ..16 : measured_in(t",
        "std.cellular.worley_noise: > float = min i in 0 [ -> + 1] ..16 : measured_in(t",
        "std.cellular.worley_noise: float = min i in 0.. [16 -> 15] : measured_in(to_fea",
        "std.cellular.worley_noise: oat = min i in 0..16 [ -> - 1] : measured_in(to_fea",
        "std.cellular.worley_noise: -> float = min i in [0 -> 1] ..64 : measured_in(t",
        "std.cellular.worley_noise: > float = min i in 0 [ -> + 1] ..64 : measured_in(t",
        "std.cellular.worley_noise: float = min i in 0.. [64 -> 63] : measured_in(to_fea",
        "std.cellular.worley_noise: oat = min i in 0..64 [ -> - 1] : measured_in(to_fea",
        "std.cellular.tiling_worley_noise: -> float = min i in [0 -> 1] ..16 : length(to_cor",
        "std.cellular.tiling_worley_noise: > float = min i in 0 [ -> + 1] ..16 : length(to_cor",
        "std.cellular.tiling_worley_noise: float = min i in 0.. [16 -> 15] : length(to_corner(p",
        "std.cellular.tiling_worley_noise: oat = min i in 0..16 [ -> - 1] : length(to_corner(p",
        "std.cellular.tiling_worley_noise: -> float = min i in [0 -> 1] ..64 : length(to_cor",
        "std.cellular.tiling_worley_noise: > float = min i in 0 [ -> + 1] ..64 : length(to_cor",
        "std.cellular.tiling_worley_noise: float = min i in 0.. [64 -> 63] : length(to_corner(p",
        "std.cellular.tiling_worley_noise: oat = min i in 0..64 [ -> - 1] : length(to_corner(p",
    ),
    "Cells at the corners of 5 × 5 have no border that is the nearest one.": (
        "std.cellular.voronoi_edge: -> float = min i in [0 -> 1] ..24 : to_border(kno",
        "std.cellular.voronoi_edge: > float = min i in 0 [ -> + 1] ..24 : to_border(kno",
        "std.cellular.voronoi_edge: > float = min i in 0 [ -> - 1] ..24 : to_border(kno",
        "std.cellular.voronoi_edge: float = min i in 0.. [24 -> 23] : to_border(known.aw",
        "std.cellular.voronoi_edge: float = min i in 0.. [24 -> 25] : to_border(known.aw",
        "std.cellular.voronoi_edge: oat = min i in 0..24 [ -> + 1] : to_border(known.aw",
        "std.cellular.voronoi_edge: oat = min i in 0..24 [ -> - 1] : to_border(known.aw",
    ),
    "The neighbours are the same in another order.": (
        "std.cellular.neighbour: t) -> ivec2 = ivec2( [number mod 5, number / 5 -> number / 5, "
        "number mod 5] ) - 2 where { number",
    ),
    "No border lies behind, as no point is nearer than the nearest one.": (
        "std.cellular.to_border: ar: vec2) -> float = [dot(0.5 * (near + far), "
        "normalize(far - near)) -> abs(dot(0.5 * (near + far), normalize(far - near)))] ",
    ),
}
