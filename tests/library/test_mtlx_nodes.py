"""The nodes of ``std.mtlx`` that are no noises, against what MaterialX's own GLSL draws."""

from __future__ import annotations

import pytest

from .materialx import MATH, RESULTS, Node, Nodes, assert_alike, inlined
from .truth import truth

IMPORTS = "\n".join(
    f"import std.mtlx.{name}"
    for name in (
        "adjustments",
        "compositing",
        "geometry",
        "patterns",
        "surfaces",
        "textures",
    )
)
LANES = {1: ".x", 2: ".xy", 3: ".xyz", 4: ""}
KINDS = {1: "float", 2: "vector2", 3: "vector3", 4: "vector4"}
COLORS = {1: "float", 3: "color3", 4: "color4"}
LIBRARY = "stdlib/genglsl/"
PBR = "pbrlib/genglsl/"
HAIR = PBR + "mx_chiang_hair_bsdf.glsl:"

ADJUSTMENTS: Nodes = {
    "rgbtohsv of 3": Node("mx_rgbtohsv_color3(r.xyz, three)", "rgbtohsv(r.xyz)", 3),
    "rgbtohsv of 4": Node("mx_rgbtohsv_color4(r, four)", "rgbtohsv(r)", 4),
    "rgbtohsv, grey": Node("mx_rgbtohsv_color3(r.xxx, three)", "rgbtohsv(r.xxx)", 3),
    "hsvtorgb of 3": Node("mx_hsvtorgb_color3(r.xyz, three)", "hsvtorgb(r.xyz)", 3),
    "hsvtorgb of 4": Node("mx_hsvtorgb_color4(r, four)", "hsvtorgb(r)", 4),
    "luminance of 3": Node(
        "mx_luminance_color3(r.xyz, q.xyz, three)", "luminance(r.xyz, q.xyz)", 3
    ),
    "luminance of 4": Node("mx_luminance_color4(r, q.xyz, four)", "luminance(r, q.xyz)", 4),
    "smoothstep": Node(
        "mx_smoothstep_float(r.x, r.y, r.z, one)", "smoothstep(r.x, r.y, r.z)", near=1e-4
    ),
    "smoothstep of 3": Node(
        "three = r.xyz; mx_smoothstep_float(r.x, q.x, r.w, three.x); "
        "mx_smoothstep_float(r.y, q.y, r.w, three.y); mx_smoothstep_float(r.z, q.z, r.w, three.z)",
        "smoothstep(r.xyz, q.xyz, r.w)",
        3,
        near=1e-4,
        files=(LIBRARY + "mx_smoothstep_float.glsl",),
    ),
}


def _over(name: str, lanes: int) -> Node:
    """Two colours, one of which is a whole number at some points."""
    two = f"round(r{LANES[lanes]}), q{LANES[lanes]}, q.w"
    return Node(f"mx_{name}_{COLORS[lanes]}({two}, {RESULTS[lanes]})", f"{name}({two})", lanes)


COMPOSITING: Nodes = {
    **{f"{name} of {n}": _over(name, n) for name in ("burn", "dodge") for n in COLORS},
    "burn": Node("mx_burn_float(r.x, r.y, q.z, one)", "burn(r.x, r.y, q.z)", near=1e-4),
    "dodge": Node("mx_dodge_float(r.x, r.y, q.z, one)", "dodge(r.x, r.y, q.z)", near=1e-4),
    **{
        f"burn by {number}": Node(
            f"mx_burn_float({number}, r.y, 1.0, one)", f"burn({number}, r.y, 1)"
        )
        for number in ("1.1e-8", "0.9e-8")
    },
    "disjointover": Node("mx_disjointover_color4(q, r, q.x, four)", "disjointover(q, r, q.x)", 4),
    "disjointover nothing": Node(
        "mx_disjointover_color4(p, vec4(r.xyz, 0), q.x, four)",
        "disjointover(p, vec4(r.xyz, 0), q.x)",
        4,
    ),
    "matte": Node(
        f"four = {inlined('matte_color4', fg='r', bg='q', mix='q.x')}",
        "matte(r, q, q.x)",
        4,
        files=MATH,
    ),
    "premult": Node("mx_premult_color4(r, four)", "premult(r)", 4),
    "unpremult": Node(
        "mx_unpremult_color4(vec4(r.xyz, q.w + 0.1), four)", "unpremult(vec4(r.xyz, q.w + 0.1))", 4
    ),
}


def _pattern(name: str, place: str, lanes: int, rest: str = "") -> Node:
    two = f"r{LANES[lanes]}, q{LANES[lanes]}{rest}"
    return Node(
        f"mx_{name}_{KINDS[lanes]}({two}, {place}, {RESULTS[lanes]})",
        f"{name}({place}, {two})",
        lanes,
        near=1e-3,
    )


SPLITS = {
    "splitlr": ("vec2(0.02 * s.x, s.y)", ", 0.02 * s.x + 0.0005 * r.x"),
    "splittb": ("s.xy", ", s.y + 0.02 * r.y"),
}
"""Places and centres that are about a pixel apart."""
PATTERNS: Nodes = {
    **{f"{name} of {n}": _pattern(name, "r.zw", n) for name in ("ramplr", "ramptb") for n in KINDS},
    **{
        f"{name} of {n}": _pattern(name, place, n, center)
        for name, (place, center) in SPLITS.items()
        for n in KINDS
    },
}

MATRIX3 = "mat3(p.xyz, q.xyz, r.xyz)"
MATRIX4 = "mat4(p, q, r, p.wzyx)"
GEOMETRY: Nodes = {
    "rotate2d": Node("mx_rotate_vector2(r.xy, p.z * 90.0, two)", "rotate2d(r.xy, p.z * 90)", 2),
    "rotate3d": Node(
        "mx_rotate_vector3(r.xyz, p.w * 90.0, p.xyz, three)",
        "rotate3d(r.xyz, p.w * 90, p.xyz)",
        3,
    ),
    "transformmatrix, a place of 2": Node(
        f"mx_transformmatrix_vector2M3(r.xy, {MATRIX3}, two)",
        f"transformmatrix(r.xy, {MATRIX3})",
        2,
    ),
    "transformmatrix, a place of 3": Node(
        f"mx_transformmatrix_vector3M4(r.xyz, {MATRIX4}, three)",
        f"transformmatrix(r.xyz, {MATRIX4})",
        3,
    ),
    "transformmatrix of 3": Node(
        f"three = mx_matrix_mul({MATRIX3}, r.xyz)", f"transformmatrix(r.xyz, {MATRIX3})", 3,
        files=MATH,
    ),
    "transformmatrix of 4": Node(
        f"four = mx_matrix_mul({MATRIX4}, r)", f"transformmatrix(r, {MATRIX4})", 4,
        files=MATH,
    ),
    "normalmap": Node(
        "mx_normalmap_float(q.xyz, r.w, r.xyz, p.xyz, p.yzw, three)",
        "normalmap(q.xyz, r.w, r.xyz, p.xyz, p.yzw)", 3, files=(LIBRARY + "mx_normalmap.glsl",),
    ),
    "normalmap of two scales": Node(
        "mx_normalmap_vector2(round(q.xyz), r.yw, r.xyz, p.xyz, p.yzw, three)",
        "normalmap(round(q.xyz), r.yw, r.xyz, p.xyz, p.yzw)", 3,
        files=(LIBRARY + "mx_normalmap.glsl",),
    ),
    "heighttonormal": Node(
        "mx_heighttonormal_vector3(16.0 * s.x, q.x, s.yz, three)",
        "heighttonormal(16 * s.x, q.x, s.yz)", 3, near=1e-4,
    ),
    "heighttonormal, nothing": Node(
        "mx_heighttonormal_vector3(s.x, q.x, s.yy, three)", "heighttonormal(s.x, q.x, s.yy)", 3,
        near=1e-3,
    ),
}  # fmt: skip


def _hair_roughness(results: str, member: str) -> Node:
    inputs = "0.6 * r.x, 0.6 * r.y, q.x, 2.0 * q.y"
    return Node(
        f"mx_chiang_hair_roughness({inputs}, {results})",
        f"chiang_hair_roughness({inputs.replace('2.0', '2')}).{member}",
        2,
        files=(HAIR + "mx_chiang_hair_roughness",),
    )


SURFACES: Nodes = {
    "artistic_ior: ior": Node(
        "vec3 k; mx_artistic_ior(r.xyz, q.xyz, three, k)", "artistic_ior(r.xyz, q.xyz).ior", 3,
        near=1e-4, files=(PBR + "mx_artistic_ior.glsl",),
    ),
    "artistic_ior: extinction": Node(
        "vec3 n; mx_artistic_ior(q.xyz, q.yzw, n, three)", "artistic_ior(q.xyz, q.yzw).extinction",
        3, near=5e-3, files=(PBR + "mx_artistic_ior.glsl",),
    ),
    "roughness_anisotropy": Node(
        "mx_roughness_anisotropy(0.6 * r.x, r.y, two)", "roughness_anisotropy(0.6 * r.x, r.y)", 2,
        files=(PBR + "mx_roughness_anisotropy.glsl",),
    ),
    "roughness_dual": Node(
        "mx_roughness_dual(r.xy, two)", "roughness_dual(r.xy)", 2,
        files=(PBR + "mx_roughness_dual.glsl",),
    ),
    "blackbody": Node(
        "mx_blackbody(16000.0 * r.x * q.x, three)", "blackbody(16000 * r.x * q.x)", 3,
        files=(PBR + "mx_blackbody.glsl",),
    ),
    "deon_hair_absorption_from_melanin": Node(
        "mx_deon_hair_absorption_from_melanin(r.x, q.y, q.xyz + 0.1, q.yzw + 0.1, three)",
        "deon_hair_absorption_from_melanin(r.x, q.y, q.xyz + 0.1, q.yzw + 0.1)", 3,
        files=(HAIR + "mx_deon_hair_absorption_from_melanin",),
    ),
    "chiang_hair_absorption_from_color": Node(
        "mx_chiang_hair_absorption_from_color(r.xyz, q.x, three)",
        "chiang_hair_absorption_from_color(r.xyz, q.x)", 3,
        files=(HAIR + "mx_chiang_hair_absorption_from_color",),
    ),
    "chiang_hair_roughness: r": _hair_roughness("two, four.xy, four.zw", "roughness_r"),
    "chiang_hair_roughness: tt": _hair_roughness("four.xy, two, four.zw", "roughness_tt"),
    "chiang_hair_roughness: trt": _hair_roughness("four.xy, four.zw, two", "roughness_trt"),
}  # fmt: skip

PLACED = "0.06 * s.xy, 1 + q.xy"
VARIED = "q.x, 45 * r.xy, q.z, 0.5 + q.zw, q.w, r.zw"


def _hextiled(lanes: int, falloff: str) -> Node:
    rest = f"{PLACED}, {VARIED}, {falloff}, q.y, q.xyz"
    return Node(
        f"mx_hextiledimage_color{lanes}(p_given, {RESULTS[lanes]}, {rest}, {RESULTS[lanes]})",
        f"hextiledimage(picture, {rest})" + (".xyz" if lanes == 3 else ""),
        lanes, near=0.007, files=(LIBRARY + "mx_hextiledimage.glsl",),
    )  # fmt: skip


def _hextiled_normal(falloff: str, flip: str) -> Node:
    rest = f"{PLACED}, {VARIED}, {falloff}, r.w, {flip}, normalize(r.xyz), p.xyz, p.yzw"
    return Node(
        f"mx_hextilednormalmap_vector3(p_given, three, {rest}, three)",
        f"hextilednormalmap(picture, {rest})",
        3, near=0.015, rare=0.02, files=(LIBRARY + "mx_hextilednormalmap.glsl",),
    )  # fmt: skip


TEXTURES: Nodes = {
    "hextiledimage of 3": _hextiled(3, "0.5"),
    "hextiledimage of 4": _hextiled(4, "q.x"),
    "hextilednormalmap": _hextiled_normal("0.5", "false"),
    "hextilednormalmap, flipped": _hextiled_normal("q.x", "true"),
}
NODES: Nodes = {**ADJUSTMENTS, **COMPOSITING, **PATTERNS, **GEOMETRY, **SURFACES, **TEXTURES}


def of(module: str, names: str) -> list[str]:
    """The full names of declarations of a file."""
    return [f"std.mtlx.{module}.{name}" for name in names.split()]


@truth(*of("adjustments", "rgbtohsv hsvtorgb luminance smoothstep"))
@pytest.mark.parametrize("name", ADJUSTMENTS)
def test_adjustments(name: str) -> None:
    assert_alike(NODES, name, IMPORTS)


@truth(*of("compositing", "burn dodge disjointover matte premult unpremult nearest_to_zero"))
@pytest.mark.parametrize("name", COMPOSITING)
def test_compositing(name: str) -> None:
    assert_alike(NODES, name, IMPORTS)


@truth(*of("patterns", "ramplr ramptb splitlr splittb filtered_step"))
@pytest.mark.parametrize("name", PATTERNS)
def test_patterns(name: str) -> None:
    assert_alike(NODES, name, IMPORTS)


@truth(*of("geometry", "rotate2d rotate3d transformmatrix normalmap heighttonormal"))
@pytest.mark.parametrize("name", GEOMETRY)
def test_geometry(name: str) -> None:
    assert_alike(NODES, name, IMPORTS)


@truth(*of("surfaces", "ArtisticIor artistic_ior roughness_anisotropy roughness_dual"))
@truth(*of("surfaces", "blackbody rgb_of_xyz deon_hair_absorption_from_melanin"))
@truth(*of("surfaces", "chiang_hair_absorption_from_color ChiangHairRoughness"))
@truth(*of("surfaces", "chiang_hair_roughness"))
@pytest.mark.parametrize("name", SURFACES)
def test_surfaces(name: str) -> None:
    assert_alike(NODES, name, IMPORTS)


@truth(*of("textures", "HexVariety HexPlace hex_chance turned_and_scaled tiled hex_place gain"))
@truth(*of("textures", "shares_of hex_shares blended hextiledimage slope_of hex_normal"))
@truth(*of("textures", "hextilednormalmap"))
@pytest.mark.parametrize("name", TEXTURES)
def test_textures(name: str) -> None:
    assert_alike(NODES, name, IMPORTS)
