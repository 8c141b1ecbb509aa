"""The names of other systems for what the standard library has, and its names there.

An unknown name that is in this table is told with the declaration of the library that is meant, and
the import that brings it (``Module.hint`` in ``compiler/semantics/names/modules.py``).
docs/builtins.md shows the table. A name that differs from the library's own only in upper case and
in underscores, such as ``smoothUnion``, needs no row.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType

from ...support.frozen import frozen


@frozen
class InLibrary:
    """The declaration of the library that is meant by a name of another system."""

    path: str
    """The import path of the file, such as ``std.mapping``."""
    name: str
    """The name of the declaration in it."""
    advice: str = ""
    """The difference between the two, if a call needs more than the other name."""


def _is(names: str, where: str, advice: str = "") -> Iterator[tuple[str, InLibrary]]:
    """Several names that mean the same declaration, which is written with its path."""
    path, _, name = where.rpartition(".")
    for each in names.split():
        yield each, InLibrary(path, name, advice)


_FIRST = "the quaternion comes first, and then the vector"
_LESS = "the second shape is taken out of the first one"
_LIGHT = "the nine colours come first, and then the direction"

_ROWS: tuple[Iterator[tuple[str, InLibrary]], ...] = (
    # ---- signed distances, as articles and node editors call them
    _is("sdCircle circleSDF", "std.distances.circle"),
    _is("sdSphere sphereSDF", "std.distances.sphere"),
    _is("sdBox sdBox2D boxSDF rectSDF", "std.distances.box"),
    _is("sdRoundBox sdRoundedBox roundedBoxSDF", "std.distances.rounded_box"),
    _is("sdSegment sdLine lineSDF", "std.distances.segment"),
    _is("sdCapsule capsuleSDF", "std.distances.capsule"),
    _is("sdPlane", "std.distances.plane"),
    _is("sdEllipse sdEllipsoid", "std.distances.ellipsoid"),
    _is("sdRing", "std.distances.ring", "it is written by a radius and a width"),
    _is("sdTriangle triSDF", "std.distances.triangle"),
    _is("sdStar sdStar5 starSDF", "std.distances.star", "it is written by its two radii"),
    _is("sdPolygon sdNgon sdPentagon polySDF", "std.distances.regular_polygon"),
    _is("sdHexagon hexSDF", "std.distances.hexagon"),
    _is("sdCross crossSDF", "std.distances.cross_shape"),
    _is("sdPie pieSDF", "std.distances.pie", "the angle is one number, and the radius is last"),
    _is("sdArc arcSDF", "std.distances.arc", "the angle is one number, and the width is last"),
    _is("sdHeart heartSDF", "std.distances.heart"),
    _is("sdTorus torusSDF", "std.distances.torus", "the two radii are two numbers"),
    _is("sdCylinder sdCappedCylinder", "std.distances.cylinder"),
    _is("sdCone sdCappedCone", "std.distances.cone", "it is written by a radius and a height"),
    _is("sdHexPrism", "std.distances.hexagonal_prism"),
    _is("sdOctahedron octahedronSDF", "std.distances.octahedron"),
    _is("opUnion opU unionSDF", "std.distances.union"),
    _is("opIntersection opIntersect opI intersectSDF", "std.distances.intersection"),
    _is("opSubtraction opSubtract opS subtractSDF", "std.distances.difference", _LESS),
    _is("opXor opXOR", "std.distances.exclusion"),
    _is(
        "smin sMin smoothMin smooth_min sminPoly polysmin opSmoothUnion opUnionRound SmoothMin",
        "std.distances.smooth_union",
    ),
    _is("smax smoothMax sminPolyMax opSmoothIntersection", "std.distances.smooth_intersection"),
    _is("opSmoothSubtraction", "std.distances.smooth_difference", _LESS),
    _is("opRound", "std.distances.rounded"),
    _is("opOnion opAnnular", "std.distances.onion", "the width is that of both sides together"),
    _is("opRep opRepetition opLimitedRepetition pMod", "std.distances.repeated"),
    _is("pModPolar opRepPolar", "std.distances.repeated_around"),
    _is("opElongate", "std.distances.elongated"),
    _is("opTwist", "std.distances.twisted"),
    _is("opBend opCheapBend", "std.distances.bent"),
    _is("opExtrusion opExtrude", "std.distances.extruded"),
    _is("opRevolution opRevolve", "std.distances.revolved"),
    # ---- texture coordinates
    _is(
        "triplanarMapping triplanarTexture triplanarTextures triplanarSample triplanar_mapping "
        "boxmap boxMap WorldAlignedTexture",
        "std.mapping.triplanar",
    ),
    _is("WorldAlignedNormal", "std.mapping.triplanar_normal"),
    _is("biplanarMapping biplanarTexture", "std.mapping.biplanar"),
    _is(
        "parallaxMapping parallaxOcclusionMapping parallaxMap steepParallax "
        "reliefMapping POM pom BumpOffset",
        "std.mapping.parallax_occlusion",
    ),
    _is("rotateUV rotateUVs uvRotate", "std.mapping.rotated_uv"),
    _is("scaleUV", "std.mapping.scaled_uv"),
    _is("PolarCoordinates cartesianToPolar", "std.mapping.polar_uv"),
    _is("flipbook flipBook spritesheetUV SubUV", "std.mapping.flipbook_uv"),
    _is(
        "equirect equirectUv equirectUV directionToEquirect latlong sphericalUV SampleSphericalMap",
        "std.mapping.equirectangular_uv",
    ),
    _is("equirectToDirection", "std.mapping.equirectangular_direction"),
    _is("octEncode octahedralEncode packNormalOct", "std.mapping.octahedral_uv"),
    _is("octDecode octahedralDecode unpackNormalOct", "std.mapping.octahedral_direction"),
    _is("matcap", "std.mapping.matcap_uv"),
    _is("flowmap FlowMap flowMapping", "std.mapping.flowed"),
    _is("pixelArtUV uv_aa texelAA", "std.mapping.crisp_uv"),
    _is("hexTiling hex2colTex textureNoTile", "std.mapping.hex_tiled"),
    _is("tex2DStochastic ProceduralTilingAndBlending", "std.mapping.stochastic_tiled"),
    # ---- normals
    _is(
        "bump bumpMap bumpmap NormalFromHeight heightToNormal bumpNormal perturbNormalArb",
        "std.mapping.bump_from_height",
    ),
    _is("unpackNormal UnpackNormal UnpackScaleNormal UnpackNormalScale unpackNormalMap",
        "std.mapping.unpacked_normal", "the strength comes last, and is 1 if nothing is changed"),
    _is("BlendNormals BlendNormal normalBlend NormalBlend blend_normals",
        "std.mapping.whiteout_blend"),
    _is(
        "rnm RNM blend_rnm BlendNormalRNM normalBlendRNM BlendAngleCorrectedNormals "
        "reorientedNormal reorient_normals",
        "std.mapping.reoriented_blend",
    ),
    _is("blend_udn BlendNormalUDN", "std.mapping.udn_blend"),
    _is("blend_whiteout BlendNormalWhiteout", "std.mapping.whiteout_blend"),
    _is("blend_linear", "std.mapping.linear_blend"),
    _is("blend_pd partialDerivativeBlend", "std.mapping.slopes_blend"),
    _is("detailMap DetailMap", "std.mapping.detailed"),
    # ---- rotations
    _is("quatMul qmul quat_mul quatMultiply quaternionMultiply multQuat",
        "std.quaternions.multiply"),
    _is(
        "rotateVector rotate_vector quatRotate qrot quatRotateVector rotateByQuat applyQuaternion "
        "quat_rotate_vector QuatRotateVector",
        "std.quaternions.rotate", _FIRST,
    ),
    _is("quatConj quat_conj qconj quatInverse quat_inverse qinv", "std.quaternions.conjugate"),
    _is("quatFromAxisAngle axisAngle axis_angle AngleAxis angleAxis quat_from_axis_angle",
        "std.quaternions.from_axis_angle"),
    _is("fromToRotation quatFromTo setFromUnitVectors rotationTo",
        "std.quaternions.from_directions"),
    _is("quatToMat3 quatToMatrix mat3_cast mat4_cast quat_to_matrix",
        "std.quaternions.to_matrix"),
    _is("quatFromMatrix quat_cast matrix_to_quat", "std.quaternions.from_matrix"),
    _is("qslerp quatSlerp quat_slerp", "std.quaternions.slerp"),
    _is("qlerp quatLerp quat_lerp", "std.quaternions.nlerp"),
    # ---- light from all around, and sampling
    _is("sh9 SH9 shBasis sphericalHarmonics", "std.harmonics.harmonics"),
    _is("evalSH shEvaluate", "std.harmonics.radiance", _LIGHT),
    _is("ShadeSH9 shGetIrradianceAt irradianceSH evaluateSH SampleSH9",
        "std.harmonics.irradiance", _LIGHT),
    _is("ign IGN gradientNoiseDither", "std.sampling.interleaved_gradient_noise"),
    _is("vogelDisk vogelDiskSample", "std.sampling.vogel_disc"),
    _is("concentricSampleDisk sampleUniformDiskConcentric", "std.sampling.concentric_disc"),
    _is("cosineSampleHemisphere sampleCosineHemisphere", "std.sampling.cosine_direction"),
    _is("uniformSampleSphere sampleUniformSphere", "std.sampling.sphere_direction"),
    _is("uniformSampleHemisphere sampleUniformHemisphere", "std.sampling.hemisphere_direction"),
)  # fmt: skip

IN_LIBRARY: Mapping[str, InLibrary] = MappingProxyType(
    {name: meant for group in _ROWS for name, meant in group}
)
"""What the library has, by its names in other systems as they are written there."""


def folded(name: str) -> str:
    """A name without what its spelling differs by: ``sdBox``, ``sd_box`` and ``SDBox`` are one."""
    return name.casefold().replace("_", "")


_FOLDED: Mapping[str, InLibrary] = MappingProxyType(
    {folded(name): meant for name, meant in IN_LIBRARY.items()}
)


def in_library(name: str) -> InLibrary | None:
    """The declaration of the library that a name of another system means, however it is spelt."""
    return _FOLDED.get(folded(name))
