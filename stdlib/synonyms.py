"""Names that other systems have for what the library declares.

Systems are shading languages, engines, node editors and collections of functions that people copy.
The hints for unknown functions and docs/builtins.md are made from this table. Names are compared as
``folded`` writes them, and what differs from a name of the library in no more than that needs no
row: ``softLight`` is ``soft_light`` anyway.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType


def folded(name: str) -> str:
    """A name without upper case and underscores, in which the styles of systems differ."""
    return name.casefold().replace("_", "")


def _called(meant: str, names: str) -> Iterator[tuple[str, tuple[str, ...]]]:
    """Several names for one function of the library, or for a choice of them in one file."""
    for name in names.split():
        yield name, tuple(meant.split())


_MODES = (
    "multiply", "darken", "color_burn", "linear_burn", "subtract", "screen", "lighten",
    "color_dodge", "linear_dodge", "divide", "overlay", "hard_light", "soft_light", "vivid_light",
    "linear_light", "pin_light", "hard_mix", "difference", "exclusion",
)  # fmt: skip
_CURVES = {
    "quadratic": "quad", "cubic": "cubic", "quartic": "quart", "quintic": "quint", "sine": "sine",
    "exponential": "expo", "circular": "circ", "back": "back", "elastic": "elastic",
    "bounce": "bounce",
}  # fmt: skip
_ROWS: tuple[Iterator[tuple[str, tuple[str, ...]]], ...] = (
    # ---- std.color
    _called("srgb_to_linear", "srgb2linear gammaToLinear GammaToLinearSpace fromSRGB decodeSRGB"),
    _called(
        "linear_to_srgb",
        "linear2srgb linearToGamma LinearToGammaSpace toSRGB encodeSRGB gammaCorrect "
        "gammaCorrection",
    ),
    _called("rgb_to_hsv", "rgb2hsv"),
    _called("hsv_to_rgb", "hsv2rgb hsv hsb hsb2rgb"),
    _called("rgb_to_hsl", "rgb2hsl"),
    _called("hsl_to_rgb", "hsl2rgb hsl"),
    _called("rgb_to_xyz", "rgb2xyz"),
    _called("xyz_to_rgb", "xyz2rgb"),
    _called("rgb_to_lab", "rgb2lab"),
    _called("lab_to_rgb", "lab2rgb"),
    _called("rgb_to_oklab", "rgb2oklab linear_srgb_to_oklab"),
    _called("oklab_to_rgb", "oklab2rgb oklab_to_linear_srgb oklab"),
    _called("rgb_to_oklch", "rgb2oklch"),
    _called("oklch_to_rgb", "oklch2rgb oklch"),
    _called("hue_rotate", "hue hueShift rotateHue adjustHue"),
    _called("hsv_adjust", "hueSaturation hueSaturationValue hsvAdjustment"),
    _called("luminance", "luma getLuminance relativeLuminance rgb2luma LinearRgbToLuminance"),
    _called("grayscale", "greyscale desaturate monochrome rgb2gray rgb2grey rgb_to_bw"),
    _called("saturation", "adjustSaturation colorSaturation"),
    _called("contrast", "adjustContrast brightnessContrast"),
    _called("exposure", "adjustExposure"),
    _called("luminance exposure", "brightness"),
    _called("invert", "invertColor invertColors complement"),
    _called("cosine_palette", "palette iqPalette"),
    _called("blackbody", "kelvinToRGB kelvin2rgb temperatureToRGB colorTemperature"),
    _called("color_difference", "deltaE"),
    _called("cdl", "ascCDL liftGammaGain"),
    # ---- std.tone_mapping
    _called("aces agx khronos_neutral reinhard", "toneMapping toneMap"),
    _called("aces", "ACESFitted ACESFilmic ACESFilmicToneMapping RRTAndODTFit tonemapACES"),
    _called("aces_narkowicz", "ACESFilm ACESApprox"),
    _called("agx", "AgXToneMapping tonemapAgX"),
    _called("hable", "filmic filmicToneMapping uncharted2 uncharted2Tonemap tonemapFilmic"),
    _called(
        "khronos_neutral", "pbrNeutral PBRNeutralToneMapping NeutralToneMapping commerceToneMapping"
    ),
    _called("reinhard", "ReinhardToneMapping tonemapReinhard"),
    # ---- std.blending
    *(_called(mode, f"blend_{mode}") for mode in _MODES),
    _called("linear_dodge", "blendAdd additive"),
    _called("color_dodge", "dodge"),
    _called("color_burn", "burn"),
    # ---- std.easing
    _called("remap", "mapRange mapLinear remapRange rangeMap fit"),
    _called("inverse_lerp", "invLerp unlerp unmix"),
    _called("linear_step", "linStep boxStep"),
    _called("smootherstep", "quinticStep perlinFade"),
    _called("ramp", "colorRamp sampleGradient gradientRamp"),
    _called("ramp_constant", "constantRamp stepRamp"),
    _called("triangle_wave", "triangle zigzag"),
    *(
        _called(f"ease_{way}_{ours}", f"{curve}_{way}")
        for curve, ours in _CURVES.items()
        for way in ("in", "out", "in_out")
    ),
    *(
        _called(f"ease_{way}_sine ease_{way}_cubic ease_{way}_quint", f"ease_{way}")
        for way in ("in", "out", "in_out")
    ),
    # ---- std.hashes and std.noise
    _called("pcg", "pcghash hashpcg wanghash"),
    _called("xxhash32", "xxhash"),
    _called(
        "white_noise",
        "hash hash1 hash11 hash12 hash13 hash14 hash21 rand random random1d noise1d "
        "whitenoise2d whitenoise3d randomrange",
    ),
    _called("random2", "hash2 hash22"),
    _called("random3", "hash3 hash33"),
    _called("random4", "hash4 hash44"),
    _called("cell_noise", "cellnoise1 cellnoise2d cellnoise3d"),
    _called("value_noise", "vnoise valuenoise2d valuenoise3d simplenoise"),
    _called(
        "gradient_noise",
        "noise noise1 noise2 noise3 noise4 noise2d noise3d perlin perlin2d perlin3d "
        "perlinnoise perlinnoise2d perlinnoise3d cnoise gnoise classicnoise inoise mxnoise "
        "mxnoisefloat unoise",
    ),
    _called("gradient_noise_derivatives", "noised"),
    _called("tiling_gradient_noise", "pnoise periodicnoise tilingnoise"),
    _called(
        "simplex_noise",
        "snoise simplex simplex2d simplex3d simplexnoise2d simplexnoise3d opensimplex opensimplex2",
    ),
    _called("simplex_noise_derivatives", "srnoise psrnoise srdnoise psrdnoise"),
    _called(
        "fbm",
        "fbm2 fbm3 fbm2d fbm3d fbmnoise fractal fractal2d fractal3d fractalnoise fractalsum "
        "octavenoise fractalbrownianmotion musgrave mxfractalnoise mxfractalnoisefloat",
    ),
    _called("turbulence", "turbulencenoise turb billow"),
    _called("ridged", "ridgednoise ridgednoise2d ridgedfbm ridgedmf ridgedmultifractal"),
    _called("domain_warp", "warp domainwarping warpnoise warpeddomain"),
    _called("curl_noise", "curl curl2d curl3d curlnoise2d curlnoise3d"),
    # ---- std.cellular
    _called("voronoi", "voronoi2d voronoi3d voronoinoise voronoitexture"),
    _called(
        "worley_noise",
        "worley worley2d worley3d worleynoise2d worleynoise3d cellular cellular2d "
        "cellular3d cellularnoise",
    ),
    _called("smooth_worley_noise", "smoothvoronoi smoothworley voronoise"),
    _called("voronoi_edge", "voronoiedges voronoiborder voronoiborders voronoidistance"),
    # ---- std.patterns
    _called(
        "checker",
        "checkers checkerboard chequer chequerboard checkertexture checkerpattern",
    ),
    _called("stripes", "stripe"),
    _called("grid", "gridlines gridpattern filteredgrid"),
    _called("bricks", "brick brickpattern bricktexture"),
    _called("hexagons", "hex hexgrid hextile hextiles hexagongrid honeycomb"),
    _called("dots", "polkadot polkadots"),
    _called("truchet_lines", "truchettile truchettiles truchetpattern"),
    _called("footprint", "filterwidth"),
    _called("pulse_train", "filteredpulsetrain"),
    _called("twirled", "twirl swirl"),
    # ---- std.masks
    _called("height_blend", "heightlerp heightmix"),
    _called("slope_angle", "steepness"),
    _called("mean_curvature", "curvature"),
    _called("cavity_mask", "cavity"),
    _called("edge_mask", "edgewear"),
)
SYNONYMS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {name: meant for row in _ROWS for name, meant in row}
)
"""By a name elsewhere: the function of the library, or several of one file to choose from."""

BY_FOLDED: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {folded(name): meant for name, meant in SYNONYMS.items()}
)
"""The same by folded names, as unknown ones are looked up."""
