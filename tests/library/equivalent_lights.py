"""Changes of the lights that no value can show, each with the reason; for ``equivalent.py``."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

OF_LIGHTS: Mapping[str, Sequence[str]] = {
    "A rim leaves the horizon and comes back, or two equal arrows have no arc.": (
        ("std.area_lights.polygon_light: Edges(vec3(0), vec3( [0 -> 1] ), vec3(0)) for i in"),
        ("std.area_lights.polygon_light: 3(0), vec3(0), vec3( [0 -> 1] )) for i in 0..N : w"),
    ),
    "An edge from a corner to itself has no arc.": (
        ("std.area_lights.polygon_light: vec3(0)) for i in 0 [ -> - 1] ..N : with_edge(edge"),
    ),
    "An edge of which nothing is above the horizon has no length where it crosses it.": (
        (
            "std.area_lights.with_edge: dges( edges.arcs + ( [if is_down and ends_… "
            "crossing else last) -> (arc(if is_down then…crossing else last))] ), if "
            "ends_down and"
        ),
    ),
    "Both sides of the choice are the same at its border, but for a millionth.": (
        ("std.area_lights.angle_over_sine: -> float = if cosine [>= -> >] 0 then sharp_over_si"),
    ),
    "What is made positive has no sign.": (
        ("std.area_lights.with_edge: < 0 crossing = abs( [dot -> -dot] (up, first)) * last"),
        ("std.area_lights.with_edge: irst)) * last + abs( [dot -> -dot] (up, last)) * first"),
        (
            "std.area_lights.with_edge: < 0 crossing = abs( [dot(up, first) -> abs(dot(up, "
            "first))] ) * last + abs(dot(u"
        ),
        (
            "std.area_lights.with_edge: irst)) * last + abs( [dot(up, last) -> abs(dot(up, "
            "last))] ) * first } /// The"
        ),
    ),
    "The axes are at right angles and as long as one: the inverse is the transpose.": (
        (
            "std.area_lights.axes_to_eye: eye: vec3) -> mat3 = [transpose -> inverse] "
            "(mat3(along, cross(n"
        ),
    ),
    "Where the eye is straight above, all directions along the surface are alike.": (
        ("std.area_lights.axes_to_eye: = if dot(flat, flat) [> -> >=] 1e-10 then normalize"),
        (
            "std.area_lights.axes_to_eye: if dot(flat, flat) > [1e-10 -> 1.25e-10] then "
            "normalize(flat)"
        ),
        (
            "std.area_lights.axes_to_eye: if dot(flat, flat) > [1e-10 -> 7.5e-11] then "
            "normalize(flat)"
        ),
        (
            "std.area_lights.axes_to_eye: at) else axes_along( [normal -> to_eye] )[0] } "
            "/// The light"
        ),
        "std.area_lights.axes_to_eye: axes_along(normal)[ [0 -> 1] ] } /// The light of",
    ),
    "A squared length is not negative.": (
        (
            "std.area_lights.axes_to_eye: * normal along = if [dot(flat, flat) -> "
            "abs(dot(flat, flat))] > 1e-10 then normali"
        ),
        (
            "std.photometry.Fading: it square_distance = [dot(to_place, to_place) -> "
            "abs(dot(to_place, to_place))] falloff = inherited."
        ),
    ),
    "Only the direction of `up` counts.": (
        ("std.area_lights.mirrored_panel: l.above), vec3(0, 0, [1 -> 2] )).z where { turn ="),
    ),
    "What a surface sends from the light to the eye, it sends back as well.": (
        (
            "std.area_lights.area_cook_torrance: (roughness), normal, [light.to_light, "
            "to_eye -> to_eye, light.to_light] ) else if not light."
        ),
    ),
    "Nothing reads the panel of a light without a size.": (
        ("std.area_lights.Sizeless: nel : Panel = Panel( [false -> true] , vec3(0), vec3(0),"),
        "std.area_lights.Sizeless: = Panel(false, vec3( [0 -> 1] ), vec3(0), vec3(0))",
        "std.area_lights.Sizeless: alse, vec3(0), vec3( [0 -> 1] ), vec3(0)) strength",
        "std.area_lights.Sizeless: 3(0), vec3(0), vec3( [0 -> 1] )) strength : float",
        ("std.area_lights.Sizeless: = 1 shines : bool = [true -> false] has_size = false } /"),
    ),
    "A panel that is turned around by half a turn is the same.": (
        (
            "std.area_lights.FlatLight: s = normalize(cross( [along, axis -> axis, along] "
            ")) sideways = cross("
        ),
    ),
    "Nothing arrives of a panel that is seen from its side.": (
        "std.area_lights.FlatLight: dot(axis, to_place) [< -> <=] 0 } /// A window, or",
    ),
    "The cosine between two directions is the same either way.": (
        (
            "std.image_light.Prefiltered: share_of_facets(f0, [normal, to_eye -> to_eye, "
            "normal] , roughness) * mirro"
        ),
        (
            "std.image_light.Surrounded: share_of_facets(f0, [normal, to_eye -> to_eye, "
            "normal] , roughness) * gloss"
        ),
    ),
    "The height of a facet follows from the second number of its point alone.": (
        ("std.image_light.facets_beside: normal(hammersley(i, [16 -> 15] ), width).z, width)"),
        ("std.image_light.facets_beside: normal(hammersley(i, [16 -> 17] ), width).z, width)"),
    ),
    "The faces of a cube are square.": (
        "std.image_light.coarseness: float(around.size(). [x -> y] )) }",
    ),
}
"""The reasons, each with the changes as ``Change.told`` says them."""
