"""Names that other systems have for what the library declares.

Systems are shading languages, engines, node editors and collections of functions that people copy.
The hints for unknown functions and docs/builtins.md are made from this table. Names are compared as
``folded`` writes them, and what differs from a name of the library in no more than that needs no
row: ``softLight`` is ``soft_light`` anyway.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType

from ..support.frozen import frozen


@frozen
class Meant:
    """The functions of one file of the library of which each may be meant by a name elsewhere."""

    path: str
    """The import path of the file, such as ``std.color``."""
    names: tuple[str, ...]
    advice: str = ""
    """The difference between the two, behind a ``where``, if a call needs more than a new name."""


def folded(name: str) -> str:
    """A name without upper case and underscores, in which the styles of systems differ."""
    return name.casefold().replace("_", "")


def _called(path: str, meant: str, names: str, advice: str = "") -> Iterator[tuple[str, Meant]]:
    """Several names for one function of the library, or for a choice of them in one file."""
    for name in names.split():
        yield name, Meant(path, tuple(meant.split()), advice)


_FIRST = "the quaternion comes first, and then the vector"
_LESS = "the second shape is taken out of the first one"
_LIGHT = "the nine colours come first, and then the direction"


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
_ROWS: tuple[Iterator[tuple[str, Meant]], ...] = (
    # ---- std.terms
    _called("std.terms", "lambert", "diffuse diffuseBRDF diffuseBSDF lambertian lambertDiffuse"),
    _called("std.terms", "phong blinn_phong", "specular specularBRDF glossy highlight"),
    _called("std.terms", "phong", "phongSpecular"),
    _called("std.terms", "blinn_phong", "blinnPhongSpecular"),
    _called("std.terms", "ambient", "ambientLight"),
    # ---- std.color
    _called(
        "std.color",
        "srgb_to_linear",
        "srgb2linear gammaToLinear GammaToLinearSpace fromSRGB decodeSRGB",
    ),
    _called(
        "std.color",
        "linear_to_srgb",
        "linear2srgb linearToGamma LinearToGammaSpace toSRGB encodeSRGB gammaCorrect "
        "gammaCorrection",
    ),
    _called("std.color", "rgb_to_hsv", "rgb2hsv"),
    _called("std.color", "hsv_to_rgb", "hsv2rgb hsv hsb hsb2rgb"),
    _called("std.color", "rgb_to_hsl", "rgb2hsl"),
    _called("std.color", "hsl_to_rgb", "hsl2rgb hsl"),
    _called("std.color", "rgb_to_xyz", "rgb2xyz"),
    _called("std.color", "xyz_to_rgb", "xyz2rgb"),
    _called("std.color", "rgb_to_lab", "rgb2lab"),
    _called("std.color", "lab_to_rgb", "lab2rgb"),
    _called("std.color", "rgb_to_oklab", "rgb2oklab linear_srgb_to_oklab"),
    _called("std.color", "oklab_to_rgb", "oklab2rgb oklab_to_linear_srgb oklab"),
    _called("std.color", "rgb_to_oklch", "rgb2oklch"),
    _called("std.color", "oklch_to_rgb", "oklch2rgb oklch"),
    _called("std.color", "hue_rotate", "hue hueShift rotateHue adjustHue"),
    _called("std.color", "hsv_adjust", "hueSaturation hueSaturationValue hsvAdjustment"),
    _called(
        "std.color",
        "luminance",
        "luma getLuminance relativeLuminance rgb2luma LinearRgbToLuminance",
    ),
    _called(
        "std.color", "grayscale", "greyscale desaturate monochrome rgb2gray rgb2grey rgb_to_bw"
    ),
    _called("std.color", "saturation", "adjustSaturation colorSaturation"),
    _called("std.color", "contrast", "adjustContrast brightnessContrast"),
    _called("std.color", "exposure", "adjustExposure"),
    _called("std.color", "luminance exposure", "brightness"),
    _called("std.color", "invert", "invertColor invertColors complement"),
    _called("std.color", "cosine_palette", "palette iqPalette"),
    _called("std.color", "blackbody", "kelvinToRGB kelvin2rgb temperatureToRGB colorTemperature"),
    _called("std.color", "color_difference", "deltaE"),
    _called("std.color", "cdl", "ascCDL liftGammaGain"),
    # ---- std.tone_mapping
    _called("std.tone_mapping", "aces agx khronos_neutral reinhard", "toneMapping toneMap"),
    _called(
        "std.tone_mapping",
        "aces",
        "ACESFitted ACESFilmic ACESFilmicToneMapping RRTAndODTFit tonemapACES",
    ),
    _called("std.tone_mapping", "aces_narkowicz", "ACESFilm ACESApprox"),
    _called("std.tone_mapping", "agx", "AgXToneMapping tonemapAgX"),
    _called(
        "std.tone_mapping",
        "hable",
        "filmic filmicToneMapping uncharted2 uncharted2Tonemap tonemapFilmic",
    ),
    _called(
        "std.tone_mapping",
        "khronos_neutral",
        "pbrNeutral PBRNeutralToneMapping NeutralToneMapping commerceToneMapping",
    ),
    _called("std.tone_mapping", "reinhard", "ReinhardToneMapping tonemapReinhard"),
    # ---- std.blending
    *(_called("std.blending", mode, f"blend_{mode}") for mode in _MODES),
    _called("std.blending", "linear_dodge", "blendAdd additive"),
    _called("std.blending", "color_dodge", "dodge"),
    _called("std.blending", "color_burn", "burn"),
    # ---- std.easing
    _called("std.easing", "remap", "mapRange mapLinear remapRange rangeMap fit"),
    _called("std.easing", "inverse_lerp", "invLerp unlerp unmix"),
    _called("std.easing", "linear_step", "linStep boxStep"),
    _called("std.easing", "smootherstep", "quinticStep perlinFade"),
    _called("std.easing", "ramp", "colorRamp sampleGradient gradientRamp"),
    _called("std.easing", "ramp_constant", "constantRamp stepRamp"),
    _called("std.easing", "triangle_wave", "zigzag"),
    *(
        _called("std.easing", f"ease_{way}_{ours}", f"{curve}_{way}")
        for curve, ours in _CURVES.items()
        for way in ("in", "out", "in_out")
    ),
    *(
        _called("std.easing", f"ease_{way}_sine ease_{way}_cubic ease_{way}_quint", f"ease_{way}")
        for way in ("in", "out", "in_out")
    ),
    # ---- std.hashes and std.noise
    _called("std.hashes", "pcg", "pcghash hashpcg wanghash"),
    _called("std.hashes", "xxhash32", "xxhash"),
    _called(
        "std.noise",
        "white_noise",
        "hash hash1 hash11 hash12 hash13 hash14 hash21 rand random random1d noise1d "
        "whitenoise2d whitenoise3d randomrange",
    ),
    _called("std.hashes", "random2", "hash2 hash22"),
    _called("std.hashes", "random3", "hash3 hash33"),
    _called("std.hashes", "random4", "hash4 hash44"),
    _called("std.noise", "cell_noise", "cellnoise1 cellnoise2d cellnoise3d"),
    _called("std.noise", "value_noise", "vnoise valuenoise2d valuenoise3d simplenoise"),
    _called(
        "std.noise",
        "gradient_noise",
        "noise noise1 noise2 noise3 noise4 noise2d noise3d perlin perlin2d perlin3d "
        "perlinnoise perlinnoise2d perlinnoise3d cnoise gnoise classicnoise inoise mxnoise "
        "mxnoisefloat unoise",
    ),
    _called("std.noise", "gradient_noise_derivatives", "noised"),
    _called("std.noise", "tiling_gradient_noise", "pnoise periodicnoise tilingnoise"),
    _called(
        "std.noise",
        "simplex_noise",
        "snoise simplex simplex2d simplex3d simplexnoise2d simplexnoise3d opensimplex opensimplex2",
    ),
    _called("std.noise", "simplex_noise_derivatives", "srnoise psrnoise srdnoise psrdnoise"),
    _called(
        "std.noise",
        "fbm",
        "fbm2 fbm3 fbm2d fbm3d fbmnoise fractal fractal2d fractal3d fractalnoise fractalsum "
        "octavenoise fractalbrownianmotion musgrave mxfractalnoise mxfractalnoisefloat",
    ),
    _called("std.noise", "turbulence", "turbulencenoise turb billow"),
    _called(
        "std.noise", "ridged", "ridgednoise ridgednoise2d ridgedfbm ridgedmf ridgedmultifractal"
    ),
    _called("std.noise", "domain_warp", "warp domainwarping warpnoise warpeddomain"),
    _called("std.noise", "curl_noise", "curl curl2d curl3d curlnoise2d curlnoise3d"),
    # ---- std.cellular
    _called("std.cellular", "voronoi", "voronoi2d voronoi3d voronoinoise voronoitexture"),
    _called(
        "std.cellular",
        "worley_noise",
        "worley worley2d worley3d worleynoise2d worleynoise3d cellular cellular2d "
        "cellular3d cellularnoise",
    ),
    _called("std.cellular", "smooth_worley_noise", "smoothvoronoi smoothworley voronoise"),
    _called(
        "std.cellular", "voronoi_edge", "voronoiedges voronoiborder voronoiborders voronoidistance"
    ),
    # ---- std.patterns
    _called(
        "std.patterns",
        "checker",
        "checkers checkerboard chequer chequerboard checkertexture checkerpattern",
    ),
    _called("std.patterns", "stripes", "stripe"),
    _called("std.patterns", "grid", "gridlines gridpattern filteredgrid"),
    _called("std.patterns", "bricks", "brick brickpattern bricktexture"),
    _called("std.patterns", "hexagons", "hex hexgrid hextile hexagongrid honeycomb"),
    _called("std.patterns", "dots", "polkadot polkadots"),
    _called("std.patterns", "truchet_lines", "truchettile truchettiles truchetpattern"),
    _called("std.patterns", "footprint", "filterwidth"),
    _called("std.patterns", "pulse_train", "filteredpulsetrain"),
    _called("std.patterns", "twirled", "twirl swirl"),
    # ---- std.masks
    _called("std.masks", "height_blend", "heightlerp heightmix"),
    _called("std.masks", "slope_angle", "steepness"),
    _called("std.masks", "mean_curvature", "curvature"),
    _called("std.masks", "cavity_mask", "cavity"),
    _called("std.masks", "edge_mask", "edgewear"),
    # ---- std.distances
    _called("std.distances", "circle", "sdCircle circleSDF"),
    _called("std.distances", "sphere", "sdSphere sphereSDF"),
    _called("std.distances", "box", "sdBox sdBox2D boxSDF rectSDF"),
    _called("std.distances", "rounded_box", "sdRoundBox sdRoundedBox roundedBoxSDF"),
    _called("std.distances", "segment", "sdSegment sdLine lineSDF"),
    _called("std.distances", "capsule", "sdCapsule capsuleSDF"),
    _called("std.distances", "plane", "sdPlane"),
    _called("std.distances", "ellipsoid", "sdEllipse sdEllipsoid"),
    _called("std.distances", "ring", "sdRing", "a ring has a radius and a width"),
    _called("std.distances", "triangle", "sdTriangle triSDF"),
    _called("std.distances", "star", "sdStar sdStar5 starSDF", "a star has two radii"),
    _called("std.distances", "regular_polygon", "sdPolygon sdNgon sdPentagon polySDF"),
    _called("std.distances", "hexagon", "sdHexagon hexSDF"),
    _called("std.distances", "cross_shape", "sdCross crossSDF"),
    _called(
        "std.distances",
        "pie",
        "sdPie pieSDF",
        "the angle is one number, and the radius is last",
    ),
    _called(
        "std.distances",
        "arc",
        "sdArc arcSDF",
        "the angle is one number, and the width is last",
    ),
    _called("std.distances", "heart", "sdHeart heartSDF"),
    _called("std.distances", "torus", "sdTorus torusSDF", "the two radii are two numbers"),
    _called("std.distances", "cylinder", "sdCylinder sdCappedCylinder"),
    _called("std.distances", "cone", "sdCone sdCappedCone", "a cone has a radius and a height"),
    _called("std.distances", "hexagonal_prism", "sdHexPrism"),
    _called("std.distances", "octahedron", "sdOctahedron octahedronSDF"),
    _called("std.distances", "union", "opUnion opU unionSDF"),
    _called("std.distances", "intersection", "opIntersection opIntersect opI intersectSDF"),
    _called("std.distances", "difference", "opSubtraction opSubtract opS subtractSDF", _LESS),
    _called("std.distances", "exclusion", "opXor"),
    _called(
        "std.distances",
        "smooth_union",
        "smin smoothMin sminPoly polysmin opSmoothUnion opUnionRound",
    ),
    _called(
        "std.distances",
        "smooth_intersection",
        "smax smoothMax sminPolyMax opSmoothIntersection",
    ),
    _called("std.distances", "smooth_difference", "opSmoothSubtraction", _LESS),
    _called("std.distances", "rounded", "opRound"),
    _called(
        "std.distances",
        "onion",
        "opOnion opAnnular",
        "the width is that of both sides together",
    ),
    _called("std.distances", "repeated", "opRep opRepetition opLimitedRepetition pMod"),
    _called("std.distances", "repeated_around", "pModPolar opRepPolar"),
    _called("std.distances", "elongated", "opElongate"),
    _called("std.distances", "twisted", "opTwist"),
    _called("std.distances", "bent", "opBend opCheapBend"),
    _called("std.distances", "extruded", "opExtrusion opExtrude"),
    _called("std.distances", "revolved", "opRevolution opRevolve"),
    # ---- std.harmonics
    _called("std.harmonics", "harmonics", "sh9 shBasis sphericalHarmonics"),
    _called("std.harmonics", "radiance", "evalSH shEvaluate", _LIGHT),
    _called(
        "std.harmonics",
        "irradiance",
        "ShadeSH9 shGetIrradianceAt irradianceSH evaluateSH SampleSH9",
        _LIGHT,
    ),
    # ---- std.mapping
    _called(
        "std.mapping",
        "triplanar",
        "triplanarMapping triplanarTexture triplanarTextures triplanarSample "
        "boxmap WorldAlignedTexture",
    ),
    _called("std.mapping", "triplanar_normal", "WorldAlignedNormal"),
    _called("std.mapping", "biplanar", "biplanarMapping biplanarTexture"),
    _called(
        "std.mapping",
        "parallax_occlusion",
        "parallaxMapping parallaxOcclusionMapping parallaxMap steepParallax reliefMapping POM "
        "BumpOffset",
    ),
    _called("std.mapping", "rotated_uv", "rotateUV rotateUVs uvRotate"),
    _called("std.mapping", "scaled_uv", "scaleUV"),
    _called("std.mapping", "polar_uv", "PolarCoordinates cartesianToPolar"),
    _called("std.mapping", "flipbook_uv", "flipbook spritesheetUV SubUV"),
    _called(
        "std.mapping",
        "equirectangular_uv",
        "equirect equirectUv directionToEquirect latlong sphericalUV SampleSphericalMap",
    ),
    _called("std.mapping", "equirectangular_direction", "equirectToDirection"),
    _called("std.mapping", "octahedral_uv", "octEncode octahedralEncode packNormalOct"),
    _called("std.mapping", "octahedral_direction", "octDecode octahedralDecode unpackNormalOct"),
    _called("std.mapping", "matcap_uv", "matcap"),
    _called("std.mapping", "flowed", "flowmap flowMapping"),
    _called("std.mapping", "crisp_uv", "pixelArtUV uv_aa texelAA"),
    _called("std.mapping", "hex_tiled", "hexTiling hex2colTex textureNoTile"),
    _called("std.mapping", "stochastic_tiled", "tex2DStochastic ProceduralTilingAndBlending"),
    _called(
        "std.mapping",
        "bump_from_height",
        "bump bumpMap NormalFromHeight heightToNormal bumpNormal perturbNormalArb",
    ),
    _called(
        "std.mapping",
        "unpacked_normal",
        "unpackNormal UnpackScaleNormal UnpackNormalScale unpackNormalMap",
        "the strength comes last, and is 1 if nothing is changed",
    ),
    _called(
        "std.mapping",
        "whiteout_blend",
        "BlendNormals BlendNormal normalBlend blend_whiteout BlendNormalWhiteout",
    ),
    _called(
        "std.mapping",
        "reoriented_blend",
        "rnm blend_rnm BlendNormalRNM normalBlendRNM BlendAngleCorrectedNormals "
        "reorientedNormal reorient_normals",
    ),
    _called("std.mapping", "udn_blend", "blend_udn BlendNormalUDN"),
    _called("std.mapping", "linear_blend", "blend_linear"),
    _called("std.mapping", "slopes_blend", "blend_pd partialDerivativeBlend"),
    _called("std.mapping", "detailed", "detailMap"),
    # ---- std.quaternions
    _called(
        "std.quaternions",
        "multiply",
        "quatMul qmul quatMultiply quaternionMultiply multQuat",
    ),
    _called(
        "std.quaternions",
        "rotate",
        "rotateVector quatRotate qrot quatRotateVector rotateByQuat applyQuaternion",
        _FIRST,
    ),
    _called(
        "std.quaternions",
        "conjugate",
        "quatConj qconj quatInverse qinv",
    ),
    _called(
        "std.quaternions",
        "from_axis_angle",
        "quatFromAxisAngle axisAngle AngleAxis",
    ),
    _called(
        "std.quaternions",
        "from_directions",
        "fromToRotation quatFromTo setFromUnitVectors rotationTo",
    ),
    _called(
        "std.quaternions",
        "to_matrix",
        "quatToMat3 quatToMatrix quaternionToMatrix toMat3 toMat4 mat3_cast mat4_cast",
    ),
    _called("std.quaternions", "from_matrix", "quatFromMatrix quat_cast matrix_to_quat"),
    _called("std.quaternions", "slerp", "qslerp quatSlerp"),
    _called("std.quaternions", "nlerp", "qlerp quatLerp"),
    # ---- std.sampling
    _called("std.sampling", "interleaved_gradient_noise", "ign gradientNoiseDither"),
    _called("std.sampling", "vogel_disc", "vogelDisk vogelDiskSample"),
    _called("std.sampling", "concentric_disc", "concentricSampleDisk sampleUniformDiskConcentric"),
    _called("std.sampling", "cosine_direction", "cosineSampleHemisphere sampleCosineHemisphere"),
    _called("std.sampling", "sphere_direction", "uniformSampleSphere sampleUniformSphere"),
    _called(
        "std.sampling",
        "hemisphere_direction",
        "uniformSampleHemisphere sampleUniformHemisphere",
    ),
    # ---- std.microfacets, std.reflectances, std.hair and std.iridescence
    _called(
        "std.microfacets",
        "schlick",
        "fresnel fresnelSchlick F_Schlick schlickFresnel",
        "the share at a right angle comes first, and then the cosine",
    ),
    _called(
        "std.microfacets",
        "dielectric",
        "fresnelDielectric F_Dielectric FrDielectric fresnelExact",
        "the index comes first, and then the cosine",
    ),
    _called(
        "std.microfacets",
        "conductor",
        "fresnelConductor F_Conductor FrConductor",
    ),
    _called(
        "std.microfacets",
        "ggx",
        "D_GGX distributionGGX NDF_GGX D_TrowbridgeReitz "
        "normalDistributionGGX D_GGX_Anisotropic GGXAniso",
        "its last argument is a width, which is the square of a roughness",
    ),
    _called(
        "std.microfacets",
        "beckmann",
        "D_Beckmann beckmannDistribution",
        "its last argument is a width, which is the square of a roughness",
    ),
    _called(
        "std.microfacets",
        "charlie",
        "D_Charlie",
    ),
    _called(
        "std.microfacets",
        "blinn",
        "D_BlinnPhong D_Blinn",
    ),
    _called(
        "std.microfacets",
        "ggx_visibility",
        "V_SmithGGXCorrelated V_SmithGGX V_SmithGGXCorrelatedFast geometrySmith G_Smith "
        "G_SmithGGX geometrySchlickGGX G_SchlickGGX smithG_GGX",
        "its last argument is a width, which is the square of a roughness",
    ),
    _called(
        "std.microfacets",
        "neubelt_visibility",
        "V_Neubelt V_Ashikhmin",
    ),
    _called(
        "std.microfacets",
        "kelemen_visibility",
        "V_Kelemen",
    ),
    _called(
        "std.microfacets",
        "f0_of_ior",
        "iorToF0 iorToFresnel0",
    ),
    _called(
        "std.microfacets",
        "ior_of_f0",
        "f0ToIor fresnel0ToIor",
    ),
    _called(
        "std.microfacets",
        "ggx_share",
        "EnvBRDFApprox DFGApprox",
    ),
    _called(
        "std.microfacets",
        "visible_normal",
        "sampleGGXVNDF sampleVNDF SampleVndf_GGX importanceSampleVisibleGGX",
    ),
    _called(
        "std.sampling",
        "facet_normal",
        "importanceSampleGGX",
        "its last argument is a width, which is the square of a roughness",
    ),
    _called(
        "std.reflectances",
        "cook_torrance",
        "cookTorranceBRDF specularGGX GGXBRDF specularBRDF",
    ),
    _called(
        "std.reflectances",
        "oren_nayar",
        "orenNayarDiffuse qualitativeOrenNayar improvedOrenNayar",
    ),
    _called(
        "std.reflectances",
        "burley",
        "disneyDiffuse Fd_Burley burleyDiffuse diffuseBurley Fr_DisneyDiffuse disney",
    ),
    _called(
        "std.terms",
        "lambert",
        "Fd_Lambert lambertian diffuseLambert BRDF_Lambert",
    ),
    _called(
        "std.reflectances",
        "ward",
        "wardAnisotropic wardDuer wardSpecular",
    ),
    _called(
        "std.reflectances",
        "brushed",
        "anisotropicGGX",
    ),
    _called(
        "std.reflectances",
        "cloth_sheen",
        "sheen sheenBRDF charlieSheen",
    ),
    _called(
        "std.reflectances",
        "clear_coat",
        "coat clearcoatBRDF varnish",
    ),
    _called(
        "std.reflectances",
        "hair",
        "kajiyaKay hairKajiya",
    ),
    _called(
        "std.hair",
        "marschner",
        "marschnerHair hairBSDF hairBxDF principledHair",
    ),
    _called(
        "std.reflectances",
        "toon",
        "cel celShading celShade toonShading toonShade cellShading stepToon",
    ),
    _called(
        "std.reflectances",
        "gooch",
        "goochShading",
    ),
    _called(
        "std.reflectances",
        "wrapped_lambert",
        "wrapLambert wrapDiffuse wrappedDiffuse wrapLighting",
    ),
    _called(
        "std.reflectances",
        "subsurface_matt",
        "subsurface subsurfaceScattering sss hanrahanKrueger",
    ),
    _called(
        "std.reflectances",
        "diffusion_profile",
        "burleyProfile normalizedDiffusion",
    ),
    _called(
        "std.iridescence",
        "iridescent_fresnel",
        "evalIridescence iridescence iridescentSchlick thinFilmInterference thinFilmFresnel",
        "`std.microfacets.thin_film` is exact for single wavelengths",
    ),
    # ---- nodes of editors, and functions of MaterialX and LYGIA
    _called("std.color", "hue_to_rgb", "hue2rgb"),
    _called("std.color", "contrast", "brightContrast"),
    _called("std.color", "saturation", "Desaturation"),
    _called("std.color", "cdl", "colorCorrect"),
    _called(
        "std.color",
        "srgb_to_linear",
        "sRGBTransferEOTF mxSrgbTextureToLinRec709 srgbTextureToLinRec709 gamma2linear",
    ),
    _called("std.color", "linear_to_srgb", "sRGBTransferOETF linear2gamma"),
    _called("std.color", "cube_root", "cbrt"),
    _called("std.color", "hsv_to_rgb", "CombineHSV"),
    _called("std.color", "rgb_to_hsv", "SeparateHSV"),
    _called(
        "std.color", "rgb_to_hsv rgb_to_oklab rgb_to_xyz srgb_to_linear", "ColorspaceConversion"
    ),
    _called("std.color", "color_difference", "ReplaceColor ColorMask colorDistance"),
    _called("std.blending", "color_burn", "blendBurn"),
    _called("std.blending", "color_dodge", "blendDodge"),
    _called(
        "std.noise",
        "gradient_noise",
        "NoiseTexture vectorNoise mxNoiseVec3 unifiedNoise3d unifiedNoise2d triNoise3D",
    ),
    _called("std.noise", "fbm", "MusgraveTexture mxFractalNoiseVec3"),
    _called("std.noise", "cell_noise", "mxCellNoiseFloat"),
    _called("std.noise", "white_noise", "srandom randomFloat rand_from_seed"),
    _called("std.hashes", "random3", "randomColor"),
    _called("std.cellular", "worley_noise", "mxWorleyNoiseFloat"),
    _called("std.patterns", "bricks", "brickTile"),
    _called("std.patterns", "stripes", "WaveTexture"),
    _called("std.patterns", "dots", "tileSampler"),
    _called("std.noise", "domain_warp", "directionalWarp"),
    _called(
        "std.sampling",
        "interleaved_gradient_noise",
        "Dither DitherTemporalAA",
        "it takes `frag_coord.xy`",
    ),
    _called("std.distances", "ellipsoid", "Ellipse"),
    _called("std.distances", "regular_polygon", "Polygon"),
    _called("std.distances", "rounded_box", "RoundedRectangle"),
    _called("std.distances", "segment", "line"),
    _called("std.distances", "coverage", "fill"),
    _called("std.distances", "onion", "stroke"),
    _called("std.distances", "repeated_around", "kaleidoscope"),
    _called("std.easing", "ping_pong", "mirror"),
    _called("std.easing", "linear_step", "FadeTransition"),
    _called("std.masks", "cavity_mask", "ambientOcclusion"),
    _called("std.mapping", "rotated_uv", "Rotator rotate2d"),
    _called("std.mapping", "polar_uv", "cart2polar"),
    _called("std.mapping", "parallax_offset", "parallaxUV"),
    _called("std.mapping", "hex_tiled", "hexTiledImage"),
    _called("std.mapping", "triplanar", "triplanarProjection"),
    _called(
        "std.mapping",
        "unpacked_normal",
        "normalMap NormalStrength NormalUnpack",
        "the texel comes first, and then the strength",
    ),
    _called("std.mapping", "whiteout_blend", "normalCombine"),
    _called(
        "std.transforms",
        "turned",
        "RotateAboutAxis VectorRotate rotate3d",
        "the axis comes first, then the angle, and the vector last",
    ),
    _called(
        "std.transforms",
        "rotation",
        "rotate3dX rotate3dY rotate3dZ rotate4d rotate4dX rotate4dY rotate4dZ",
        "the axis comes first, and then the angle",
    ),
    _called("std.quaternions", "to_matrix", "quat2mat3 quat2mat4"),
    _called(
        "std.microfacets",
        "schlick",
        "FresnelEffect LayerWeight",
        "the share at a right angle comes first, and then the cosine",
    ),
    _called(
        "std.microfacets",
        "ggx_visibility",
        "V_GGX_SmithCorrelated",
        "its last argument is a width, which is the square of a roughness",
    ),
    _called(
        "std.reflectances",
        "cook_torrance",
        "GlossyBSDF conductor_bsdf dielectric_bsdf pbrComputeSpecular",
    ),
    _called("std.reflectances", "brushed", "AnisotropicBSDF"),
    _called("std.reflectances", "cloth_sheen", "SheenBSDF VelvetBSDF"),
    _called("std.reflectances", "toon", "ToonBSDF"),
    _called("std.reflectances", "oren_nayar", "oren_nayar_diffuse_bsdf"),
    _called("std.reflectances", "burley", "burley_diffuse_bsdf"),
    _called("std.reflectances", "wrapped_lambert", "TranslucentBSDF"),
)
SYNONYMS: Mapping[str, Meant] = MappingProxyType(
    {name: meant for row in _ROWS for name, meant in row}
)
"""By a name elsewhere: the function of the library, or several of one file to choose from."""

BY_FOLDED: Mapping[str, Meant] = MappingProxyType(
    {folded(name): meant for name, meant in SYNONYMS.items()}
)
"""The same by folded names, as unknown ones are looked up."""
