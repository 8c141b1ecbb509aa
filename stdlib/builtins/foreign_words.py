"""What hints say with names of the library, of which the compiler itself knows none.

They are told to who writes a slot, an operator or a value of the host as other systems have it.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

OF_PASSES = "such as `pass Drawn : Forward {{ {} }}`"
"""The way to write a member that belongs in a pass, for who has put it elsewhere."""

HIDDEN = "is_hidden"
"""The slot of surfaces that says where nothing is drawn, as ``discard`` does in a pass."""

OF_GLTF = (
    "only a base that has it makes something of it, such as `: MetallicRoughness` of "
    "`import std.gltf.{MetallicRoughness}`"
)
_CULLED = "which sides are drawn is `raster { cull = back }` of a pass"
_BLENDED = "how a pass blends stands in its head: `pass Drawn : Forward blend alpha { }`"
_TESTED = "how depths are tested and written is `depth { write = false }` of a pass"
_BY_ITSELF = "nothing is made of it by itself: the slot `color` would have to read it"
_TO_EYE = "what a surface sends to the eye is its slot `color`"
_COVERS = "how much a surface covers is its slot `alpha`"
_OWN_DEPTH = "a pass gives fragments a depth of their own by `depth { value = … }`"
_NO_CLIP = "a surface is cut at the sides of clip space, or by `discard when` in a pass"
_NO_POINTS = "points have no size of their own: `expand point` makes a square of each"
_IN_CLIP = "where a vertex is drawn is the slot `clip_position`"
_DISCARD = "a pass leaves out pixels by `discard when condition`"
_SIDES = "both sides are drawn, but where `is_hidden` is true: glTF has `is_two_sided` for it"
_SENT = "what a light sends is its slots `diffuse` and `specular`"
_FADES = "how a light fades is its slot `falloff`"
_STANDS = "where a lamp stands is the slot `place` of those that have a place"
_OPENS = "a cone is the slots `inner` and `outer` of those lights that have one"
_THROWS = "lights of `std.shadows` throw shadows"

OF_SURFACES: Mapping[str, str] = {
    **dict.fromkeys(("albedo", "basecolor", "diffusecolor", "fragcolor", "outcolor", "surfacecolor",
                     "glfragcolor", "svtarget", "finalcolor"), _TO_EYE),
    **dict.fromkeys(("opacity", "transparency", "coverage", "alfa"), _COVERS),
    **dict.fromkeys(("discard", "clip", "kill", "alphatest", "alphacutoff"), _DISCARD),
    **dict.fromkeys(("depth", "fragdepth", "glfragdepth", "svdepth", "pixeldepth"), _OWN_DEPTH),
    **dict.fromkeys(("clipdistance", "glclipdistance", "svclipdistance", "culldistance",
                     "svculldistance", "glculldistance"), _NO_CLIP),
    **dict.fromkeys(("pointsize", "glpointsize", "psize"), _NO_POINTS),
    **dict.fromkeys(("glposition", "svposition"), _IN_CLIP),
    **dict.fromkeys(("roughness", "metallic", "metalness", "ao", "occlusion", "emissive",
                     "emission"), OF_GLTF),
    **dict.fromkeys(("shininess", "clearcoat", "sheen", "ior", "transmission", "subsurface",
                     "anisotropy"), _BY_ITSELF),
    **dict.fromkeys(("doublesided", "twosided"), _SIDES),
    **dict.fromkeys(("cull", "cullmode", "backfaceculling"), _CULLED),
    **dict.fromkeys(("blend", "blending", "blendmode", "transparent"), _BLENDED),
    **dict.fromkeys(("depthwrite", "depthtest", "zwrite", "ztest"), _TESTED),
}  # fmt: skip
"""Words of other systems for what a shader writes, in small letters and without underscores, and
what there is here instead."""

OF_LIGHTS: Mapping[str, str] = {
    **dict.fromkeys(("color", "colour", "intensity", "brightness", "strength", "power", "energy",
                     "radiance", "emission", "multiplier"), _SENT),
    **dict.fromkeys(("attenuation", "range", "radius", "distance", "decay", "linear", "quadratic",
                     "constant"), _FADES),
    **dict.fromkeys(("position", "pos", "location"), _STANDS),
    **dict.fromkeys(("angle", "coneangle", "spotangle", "spotsize", "cutoff", "penumbra",
                     "innerconeangle", "outerconeangle", "innerangle", "outerangle"), _OPENS),
    **dict.fromkeys(("castshadow", "castshadows", "shadow", "shadows"), _THROWS),
}  # fmt: skip
"""The same for what a light sends."""

SLOTS: Mapping[str, Mapping[str, str]] = MappingProxyType(
    {"material": OF_SURFACES, "pass": OF_SURFACES, "light": OF_LIGHTS}
)
"""The words of other systems for each kind of record; a pass may have any slot of the surface."""

_COLORS = ("diffuse_color", "peak")
OF_LAMPS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        **dict.fromkeys(("position", "pos", "location", "origin", "translation"), ("place",)),
        **dict.fromkeys(("direction", "dir", "target", "forward", "aim"), ("direction", "axis")),
        **dict.fromkeys(("color", "colour", "intensity", "brightness", "power", "strength"),
                        _COLORS),
        **dict.fromkeys(("angle", "cone", "coneangle", "spotangle", "cutoff", "outerangle"),
                        ("outer",)),
        **dict.fromkeys(("innerangle", "penumbra", "innercone"), ("inner",)),
        **dict.fromkeys(("range", "radius", "distance"), ("reach", "farthest")),
    }
)  # fmt: skip
"""Words of other systems for the parameters of a light, folded likewise, and the names here, of
which the first that a light has is meant."""

_TIME = "time : float per frame = 0"
_RESOLUTION = "resolution : vec2 per view = vec2(512, 512)"
_MOUSE = "mouse : vec2 per frame = vec2(0, 0)"

HOSTED: Mapping[str, str] = MappingProxyType(
    {
        **dict.fromkeys(
            ("time", "iTime", "TIME", "_Time", "u_time", "uTime", "Time", "iGlobalTime",
             "elapsedTime", "seconds"), _TIME,
        ),
        **dict.fromkeys(
            ("iResolution", "u_resolution", "uResolution", "resolution", "_ScreenParams",
             "VIEWPORT_SIZE", "screenSize", "viewportSize"), _RESOLUTION,
        ),
        **dict.fromkeys(("iMouse", "u_mouse", "uMouse"), _MOUSE),
    }
)  # fmt: skip
"""Values that hosts of other languages set by themselves, and the parameter for such a value."""

CHAINED: Mapping[str, str] = MappingProxyType(
    {
        "add": "{0} + {1}", "sub": "{0} - {1}", "mul": "{0} * {1}", "div": "{0} / {1}",
        "mod": "{0} mod {1}", "negate": "-{0}", "oneMinus": "1 - {0}", "reciprocal": "1 / {0}",
        "lessThan": "{0} < {1}", "greaterThan": "{0} > {1}", "equal": "{0} == {1}",
        "toVar": "{0}", "toConst": "{0}", "toFloat": "float({0})", "toInt": "int({0})",
        "toVec3": "vec3({0})", "lerp": "mix({0}, {1})",
    }
)  # fmt: skip
"""Methods of values in other languages, by which operators are written there, and how they are
written here: `{0}` is the value, and `{1}` what the method gets."""
