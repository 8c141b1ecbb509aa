"""Nodes of editors, and functions that people copy, which are a short expression here.

The hints for unknown functions and docs/builtins.md are made from this table, if no function of
the user's own is meant. What is a function of the library has its row in ``stdlib/synonyms.py``.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from ..synonyms import folded
from .elsewhere import Instead, same

_BLENDING = "blend modes are in `std.blending`"
_LAST = "a picture that another pass has drawn is a texture, which a frame sets by `with`"
_DEPTHS = "`view_projection` has the camera; `std.frames.shown_at` finds the point of a depth"
_BASES = "materials of `std.models` are bases: `material Mine : Principled {}`"
_LIGHTS = "lights are read in a `term … per light`: `light.to_light` and `light.diffuse`"
_CURVE = "a curve through points is `ramp` of `std.easing`"
_NEIGHBOURS = "a pass over a whole picture reads its neighbours: see `examples/frames`"
_MARCH = "`iterate` repeats a step; `examples/marching.burnish` walks along a ray"
_AROUND = (
    "a cube map is read by a direction, `sky(reflect(-to_eye, normal))`; for surfaces with a "
    "roughness, `std.image_light` has `Surrounded` and `Prefiltered`"
)
_BEHIND = (
    "what is behind a surface is drawn by blending, `pass Panes : Forward blend alpha {}`, or "
    "read from a cube map, `sky(refract(-to_eye, normal, 1 / 1.5))`"
)
_SPACES = "`std.color` has HSV, HSL, XYZ, Lab and OKLab; others are a matrix"
_TIME = "the host sets the time: `param time : float per frame`"

_ROWS = (
    # ---- numbers
    same("OneMinus", "1 - x"),
    same("Negate", "-x"),
    same("Reciprocal ReciprocalFast", "1 / x"),
    same("LinearInterpolate mixRGB mixColor lerpRGB cubicMix", "mix(x, y, z)"),
    same("Square sq pow2", "x * x"),
    same("pow3", "x * x * x"),
    same("pow4", "pow(x, 4)"),
    same("pow5", "pow(x, 5)"),
    same("SafePower mxSafePower powFast", "sign(x) * pow(abs(x), y)"),
    same("lengthSq lengthSquared distanceSquared", "dot(v, v)"),
    same("SafeNormalize", "normalize(v)", reason="nothing stays nothing"),
    same("ConstantBiasScale", "(x + y) * z"),
    same("threshold", "step(y, x)"),
    same("remapClamp", "mix(x, y, saturate((z - x) / (y - x)))"),
    same("Snap snapped", "y * floor(x / y)"),
    same("decimate", "floor(x * y) / y"),
    same("fposmod floored_modulo", "x mod y"),
    same("mod289", "x mod 289", reason="hashes of whole numbers are in `std.hashes`"),
    same("truncated_modulo", "x - y * trunc(x / y)"),
    same("wrap", "x + (z - x) mod (y - x)"),
    same("move_toward", "x + clamp(y - x, -z, z)"),
    same("to_radians", "radians(x)"),
    same("to_degrees", "degrees(x)"),
    same("ddxy", "fwidth(x)"),
    same("aastep AntialiasedTextureMask", "saturate((x - y) / fwidth(x) + 0.5)"),
    same("SawtoothWave oscSawtooth sawtooth", "fract(x)"),
    same("oscSine LinearSine sineWave", "0.5 + 0.5 * sin(2 * pi * x)"),
    same("oscSquare", "step(0.5, fract(x))"),
    same("oscTriangle", "abs(2 * fract(x) - 1)"),
    same("parabola", "pow(4 * x * (1 - x), y)"),
    same("pcurve", "pow(y + z, y + z) / (pow(y, y) * pow(z, z)) * pow(x, y) * pow(1 - x, z)"),
    same("sinc", "if x == 0 then 1.0 else sin(pi * x) / (pi * x)"),
    same("gaussian", "exp(-x * x / (2 * y * y))"),
    same("mmax maxComponent", "max(v.x, max(v.y, v.z))"),
    same("mmin minComponent", "min(v.x, min(v.y, v.z))"),
    same("ifGreater ifGreaterEq ifEqual", "if x > y then v else w"),
    same("branch", "if x > 0.5 then v else w"),
    # ---- vectors
    same("Combine CombineXYZ CombineRGB CombineColor AppendVector MakeFloat3", "vec3(x, y, z)"),
    same("Split SeparateXYZ SeparateRGB SeparateColor BreakFloat3", "v.x", "v.y", "v.z"),
    same("Swizzle ComponentMask", "v.xy"),
    same("extract", "v[n]"),
    same("Projection", "w * (dot(v, w) / dot(w, w))"),
    same("Rejection", "v - w * (dot(v, w) / dot(w, w))"),
    same("VectorMath", "dot(v, w)", "cross(v, w)", reason="each operation has a name of its own"),
    same("transformDirection", "a * v"),
    same("directionToColor packNormalToRGB", "0.5 + 0.5 * v"),
    same("colorToDirection unpackRGBToNormal", "2 * v - 1"),
    same("ChannelMixer", "a * v", reason="the rows of the matrix are the shares"),
    same("premult premultiplyAlpha", "vec4(p.xyz * p.w, p.w)"),
    same("unpremult unpremultiplyAlpha", "vec4(p.xyz / p.w, p.w)"),
    same("plus", "mix(v, v + w, x)"),
    same("minus", "mix(v, v - w, x)"),
    same("blend mixBlend", "mix(v, w, x)", reason=_BLENDING),
    same("blendAverage", "(v + w) / 2"),
    same("blendNegation", "1 - abs(1 - v - w)"),
    same("blendPhoenix", "min(v, w) - max(v, w) + 1"),
    same("colorInvert", "1 - v"),
    same("Levels histogramRange", "saturate((v - x) / (y - x))"),
    same("histogramScan", "saturate((x - y) / z + 0.5)"),
    same("RGBCurves floatCurve gradientMap", reason=_CURVE),
    same("emissionShader emission", "x * v", reason="add it to `color`"),
    # ---- places in textures
    same("TilingAndOffset TRANSFORM_TEX tiling place2d", "uv * x + y"),
    same("Panner", "uv + x * vec2(y, z)"),
    same("sqTile tileUV", "fract(uv * x)", "floor(uv * x)"),
    same("RadialShear", "uv + x * dot(uv, uv) * vec2(uv.y, -uv.x)", reason="from the centre"),
    same("spiralSDF", "abs(sin(fract(x * log(dot(uv, uv)) + atan2(uv.y, uv.x) / (2 * pi))))"),
    same("mirrorTile", "abs(2 * fract(uv * x) - 1)"),
    same("rampLR mxRampLR", "mix(v, w, saturate(uv.x))"),
    same("rampTB mxRampTB", "mix(v, w, saturate(uv.y))"),
    same("splitLR mxSplitLR", "mix(v, w, step(x, uv.x))"),
    same("splitTB mxSplitTB", "mix(v, w, step(x, uv.y))"),
    same("gradientTexture linearGradient", "saturate(uv.x)"),
    same("RadialGradientExponential radialGradient", "pow(saturate(1 - length(uv) / x), y)"),
    same("SphereMask", "1 - smoothstep(x, y, distance(v, w))"),
    same("polar2cart polarToCartesian", "x * vec2(cos(y), sin(y))"),
    same("SAMPLE_TEXTURE2D UNITY_SAMPLE_TEX2D tiledImage imageTexture sampler2d", "albedo(uv)"),
    same("SAMPLE_TEXTURE2D_LOD", "albedo.level(uv, x)"),
    # ---- what a surface knows
    same("facingRatio", "saturate(dot(normal, to_eye))"),
    same("DeriveNormalZ NormalReconstructZ", "vec3(uv, sqrt(1 - dot(uv, uv)))"),
    same("FlattenNormal", "normalize(mix(v, vec3(0, 0, 1), x))"),
    same("TransformObjectToWorld", "(object_to_world * vec4(v, 1)).xyz", reason="the slot "
          "`position` is in world space already"),
    same("UnityObjectToClipPos TransformObjectToHClip TransformWorldToHClip",
          "view_projection * vec4(v, 1)", reason="the slot `clip_position` is computed for you"),
    same("UnityObjectToWorldNormal TransformObjectToWorldNormal", "normal"),
    same("WorldSpaceViewDir UnityWorldSpaceViewDir GetWorldSpaceViewDir viewDirection", "to_eye"),
    same("PixelDepth viewDepth", "distance(position, eye)"),
    same("CameraDepthFade", "saturate((distance(position, eye) - x) / y)"),
    # ---- what is not a function
    same("GetMainLight GetAdditionalLight", reason=_LIGHTS),
    same("SceneColor SceneTexture screenTexture", reason=_LAST),
    same("SceneDepth DepthFade LinearEyeDepth Linear01Depth perspectiveDepthToViewZ "
          "viewZToPerspectiveDepth viewportLinearDepth viewportDepthTexture linearDepth",
          reason=_DEPTHS),
    same("crosshatch hatching", reason="`stripes` of `std.patterns` in two slants: "
          "`min(stripes(20 * (uv.x + uv.y), 0.5), stripes(20 * (uv.x - uv.y), 0.5))`"),
    same("MagicTexture", reason="`domain_warp` of `std.noise` bends a place, and sums of `sin` "
          "make such waves"),
    same("artistic_ior", reason="`schlick_f82` of `std.microfacets` takes the colours of a metal "
          "from the front and near its edge"),
    same("PrincipledBSDF standard_surface open_pbr_surface gltf_pbr disney_principled "
          "UsdPreviewSurface pbr generalized_schlick_bsdf", reason=_BASES),
    same("slopeBlur GaussianBlur boxBlur sharpen chromaAB edgeDetect", reason=_NEIGHBOURS),
    same("raymarch raymarchSoftShadow raymarchAO sphereTrace", reason=_MARCH),
    same("deltaTime getTime", reason=_TIME),
    same("envMap sampleEnvironment reflectionProbe", reason=_AROUND),
    same("GlassBSDF RefractionBSDF TransparentBSDF", reason=_BEHIND),
    same("lut lookup colorGrade", "albedo(uv)", reason="a table is a texture"),
    same("heatmap spectral_zucconi wavelength2rgb wavelength", reason=_CURVE),
    same("rgb2yuv rgb2ycbcr rgb2yiq rgb2lms rgb2cmyk rgb2ryb", "a * v", reason=_SPACES),
    same("intersectSphere boxIntersect raySphere rayBox", reason=_MARCH),
    same("reflection", "reflect(v, w)"),
    same("smoothstepElement", "smoothstep(x, y, z)"),
)  # fmt: skip

NODES: Mapping[str, Instead] = MappingProxyType(
    {name: instead for row in _ROWS for name, instead in row}
)
"""By a name elsewhere: what is written here."""

BY_FOLDED: Mapping[str, Instead] = MappingProxyType(
    {folded(name): instead for name, instead in NODES.items()}
)
"""The same by folded names, as unknown ones are looked up."""
