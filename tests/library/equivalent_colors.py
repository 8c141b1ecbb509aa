"""Changes of colours, blend modes and curves that no value can show, each with the reason.

``equivalent.py`` says more.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence

BY_REASON: Mapping[str, Sequence[str]] = {
    "At the limit both sides of the choice are the same.": (
        "std.color.lab_to_rgb: share = choose(root [> -> >=] 6.0 / 29, root * roo",
        "std.color.lab_root: ) -> vec3 = choose(t [> -> >=] 216.0 / 24389, cube_",
        "std.easing.gain: oat) -> float = if t [< -> <=] 0.5 then 0.5 * bias(",
        "std.easing.ease_out_bounce: rate(t) place = if x [< -> <=] 1 / 2.75 then 0 else",
        "std.easing.ease_out_bounce: 1.5 / 2.75 else if x [< -> <=] 2.5 / 2.75 then 2.25",
        "std.easing.ease_out_bounce: .75 then 0 else if x [< -> <=] 2 / 2.75 then 0.75 e",
        "std.easing.ease_out_bounce: / 2.75 height = if x [< -> <=] 1 / 2.75 then 0 else",
        "std.easing.ease_out_bounce: then 0.75 else if x [< -> <=] 2.5 / 2.75 then 0.93",
        "std.easing.both_halves: oat) -> float = if t [< -> <=] 0.5 then 0.5 * half",
        "std.easing.ease_out_bounce: .75 then 0 else if x [< -> <=] 2 / 2.75 then 1.5 /",
        "std.tone_mapping.khronos_neutral: gb) -> rgb = if peak [< -> <=] start then shown els",
        "std.tone_mapping.khronos_neutral: = light - (if least [< -> <=] 0.08 then least - 6.",
        "std.blending.hard_light: > rgb = choose(blend [<= -> <] 0.5, multiply(base,",
        "std.blending.soft_light: rgb = choose( blend [<= -> <] 0.5, base - (1 - 2 *",
        "std.blending.soft_light: lifted = choose(base [<= -> <] 0.25, ((16 * base -",
        "std.blending.vivid_light: > rgb = choose(blend [<= -> <] 0.5, color_burn(base",
        "std.blending.pin_light: > rgb = choose(blend [<= -> <] 0.5, min(base, 2 * b",
        "std.blending.with_luminosity: t) -> rgb = if least [< -> <=] 0 then wanted + (lif",
        "std.blending.with_luminosity: least)) else if most [> -> >=] 1 then wanted + (lif",
    ),
    "Both colours count alike in `multiply` and `screen`.": (
        (
            "std.blending.hard_light: nd <= 0.5, multiply( [base, 2 * blend -> 2 * blend, "
            "base] ), screen(base, 2 *"
        ),
        (
            "std.blending.hard_light: 2 * blend), screen( [base, 2 * blend - 1 -> 2 * blend -"
            " 1, base] )) /// The same more"
        ),
    ),
    "What the lower colour shows of the upper one is the same from either side.": (
        (
            "std.blending.over: -> rgba = composite( [backdrop, source -> source, backdrop] ,"
            " source.rgb) /// A"
        ),
    ),
    "A colour and the slope that multiplies it count alike.": (
        (
            "std.tone_mapping.agx_look: b = agx_decoded(cdl( [agx_encoded(c), slope -> slope,"
            " agx_encoded(c)] , vec3(0), vec3(powe"
        ),
    ),
    "What is not bounded is black or white anyway.": (
        (
            "std.tone_mapping.reinhard_extended: n(reinhard(c) * (1 + [bounded(c) -> (c)] / "
            "(white * white)),"
        ),
    ),
    "The larger of two numbers is the same in either order.": (
        "std.tone_mapping.bounded: rgb) -> rgb = clamp( [c, 0 -> 0, c] , 65504) /// Never q",
        (
            "std.color.blackbody_xyz: ) where { t = clamp( [kelvin, 1667 -> 1667, kelvin] , "
            "25000) x = cubic("
        ),
    ),
    "Where a bounce lies says which bounce it is, too.": (
        "std.easing.ease_out_bounce: 75 then 0.75 else if [x -> place] < 2.5 / 2.75 then 0.",
        "std.easing.ease_out_bounce: 2.75 then 0 else if [x -> place] < 2 / 2.75 then 0.75",
        "std.easing.ease_out_bounce: 5 / 2.75 height = if [x -> place] < 1 / 2.75 then 0 el",
    ),
    "A length is the same whatever the order of the lanes.": (
        "std.color.rgb_to_oklch: 3(lab.x, length(lab. [yz -> zy] ), atan2(lab.z, lab.",
    ),
    "Both sides of the choice touch at the limit, and differ by less than 1e-10 next to it.": (
        "std.color.lab_root: = choose(t > 216.0 / [24389 -> 24388] , cube_root(t), (243",
        "std.color.lab_root: = choose(t > 216.0 / [24389 -> 24390] , cube_root(t), (243",
    ),
    "Hues go around in whole numbers.": (
        "std.color.hue_to_rgb: * fract(hue + vec3( [0 -> 1] , 2.0 / 3, 1.0 / 3))",
    ),
    "Before an array lies its first element again, and behind it the last one.": (
        "std.easing.ramp: oat) -> T = sum i in [1 -> 0] ..N from stops[0] :",
        "std.easing.ramp: t) -> T = sum i in 1 [ -> - 1] ..N from stops[0] :",
        "std.easing.ramp: -> T = sum i in 1..N [ -> + 1] from stops[0] : (sto",
        "std.easing.ramp_constant: > T = stops[min(int( [saturate(t) -> (t)] * float(N)), N - 1)]",
    ),
}
