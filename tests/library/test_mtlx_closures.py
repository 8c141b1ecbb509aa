"""The closures of ``std.mtlx`` against what MaterialX's own GLSL draws.

Each is asked in three ways. Highlights are met by half of the points, as the light is mirrored on
facets near the normal.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

from .calls import Quad, called
from .kit import close
from .materialx import Node, Nodes, assert_alike
from .truth import truth

SHARES = "vec3(0.5, 0.3, 0.2)"
"""How much each colour of the throughput counts in the one number that is compared."""
IMPORTS = f"""import std.mtlx.asking
import std.mtlx.closures
import std.mtlx.facets
import std.mtlx.fresnel
import std.mtlx.matt
fn lanes_of(b: Bsdf) -> vec4 = vec4(vec3(b.response), dot(vec3(b.throughput), {SHARES}))
"""
PBR = "pbrlib/genglsl"
AROUND = f"{PBR}/lib/mx_environment_prefilter.glsl", f"{PBR}/lib/mx_transmission_refract.glsl"
NORMAL, TO_EYE, TANGENT = "normalize(p.xyz)", "normalize(r.xyz)", "normalize(p.zyw)"
TO_LIGHT = f"reflect(-{TO_EYE}, normalize({NORMAL} + 0.2 * r.yzw))"
EVEN = "q.yzw"
KIND = "int(3.0 * fract(p.x))"
"""How a closure is asked. MaterialX has other numbers for the same kinds."""
ASKED = f"Asked(({KIND} as Asking), {TO_LIGHT}, {TO_EYE}, rgb({EVEN}))"
DATA = (
    f"makeClosureData({KIND} == 0 ? 1 : 4 - {KIND}, {TO_LIGHT}, {TO_EYE}, {NORMAL}, vec3(0.0), 1.0)"
)
ROUNDED = 1e-5
"""What float32 rounds in closures of cosines."""
NARROW = 3e-4
"""Highlights, films and angles, which magnify what float32 rounds."""
NEEDLES = 0.1
"""Highlights that are a thousandth of a turn wide, where float32 of GLSL is off by a twentieth."""

WEIGHT = "min(r.w + 1.0, 1.0)"
WIDTHS, EVEN_WIDTHS = "vec2(0.05 + q.w, 0.1 + abs(r.x))", "vec2(0.05 + q.w)"
NO_FILM, FILM = ("0.0", "1.5"), ("max(p.w * 100.0, 0.5)", "1.05 + q.x")
MODE, BACK = "int(q.y * 2.99)", "q.z > 0.8"
ROUGHNESS = "clamp(0.7 * r.y + 0.5, 0.0, 1.0)"
INDEX = "1.1 + abs(r.z)"
COLOR, SECOND, THIRD = (f"rgb(1.2 * q.{lanes} - 0.1)" for lanes in ("xyz", "zwx", "wyz"))
SHEEN = "int(q.y * 1.99)"
SMOOTHLY = "1 + 0"
DISTRIBUTION = "0 + 0"
OURS = {
    MODE: f"({MODE} as ScatterMode)",
    SHEEN: f"({SHEEN} as SheenMode)",
    SMOOTHLY: "SheenMode.zeltner",
}
"""Arguments that are written in another way in Burnish."""


def closure(function: str, near: float, *given: str) -> Node:
    """A closure: its response, and its mean throughput.

    Its arguments mean the same in both languages; colours are ``rgb`` in Burnish only.
    """
    theirs = ", ".join(each.removeprefix("rgb") for each in given)
    ours = ", ".join(OURS.get(each, each) for each in given if each != DISTRIBUTION)
    return Node(
        f"even_light = {EVEN}; BSDF b = BSDF(vec3(0.0), vec3(1.0)); "
        f"mx_{function}({DATA}, {theirs}, b); "
        f"four = vec4(b.response, dot(b.throughput, {SHARES}))",
        f"lanes_of({function}({ASKED}, {ours}))",
        4,
        near,
        (*AROUND, f"{PBR}/mx_{function}.glsl"),
    )


def facets(function: str, *given: str, last: tuple[str, ...] = (MODE,)) -> Nodes:
    """A gloss with facets as wide along both axes or not, with a film or without."""
    return {
        f"{function} with {name}": closure(
            function, NARROW, WEIGHT, *given, widths, BACK, *film, NORMAL, TANGENT, DISTRIBUTION,
            *last,
        )
        for name, widths, film in (
            ("two widths", WIDTHS, NO_FILM), ("one width", EVEN_WIDTHS, NO_FILM),
            ("a film", EVEN_WIDTHS, FILM),
        )
    }  # fmt: skip


A, B = "BSDF(q.xyz, q.wzy)", "BSDF(q.zxw, q.yyx)"
OURS_A, OURS_B = "Bsdf(rgb(q.xyz), rgb(q.wzy))", "Bsdf(rgb(q.zxw), rgb(q.yyx))"


def joined(function: str, theirs: str, ours: str) -> Node:
    """Closures that are put together."""
    return Node(
        f"BSDF b = BSDF(vec3(0.0), vec3(1.0)); mx_{function}({DATA}, {theirs}, b); "
        f"four = vec4(b.response, dot(b.throughput, {SHARES}))",
        f"lanes_of({ours})",
        4,
        1e-6,
        (*AROUND, f"{PBR}/mx_{function}.glsl"),
    )


GLOSS: Nodes = {
    **facets("dielectric_bsdf", COLOR, INDEX),
    **facets("conductor_bsdf", "rgb(0.1 + 2.0 * q.zwx)", "rgb(3.0 * q.wyz)", last=()),
    **facets("generalized_schlick_bsdf", COLOR, SECOND, THIRD, "1.0 + 5.0 * q.y"),
}
MATT: Nodes = {
    "oren_nayar": closure(
        "oren_nayar_diffuse_bsdf", ROUNDED, WEIGHT, COLOR, ROUGHNESS, NORMAL, "q.x > 0.5"
    ),
    "burley": closure("burley_diffuse_bsdf", ROUNDED, WEIGHT, COLOR, ROUGHNESS, NORMAL),
    "translucent": closure("translucent_bsdf", ROUNDED, WEIGHT, COLOR, NORMAL),
}
CLOTH: Nodes = {
    "sheen": closure(
        "sheen_bsdf", ROUNDED, WEIGHT, COLOR, ROUGHNESS, NORMAL, SHEEN,
    ),
    "hair": closure(
        "chiang_hair_bsdf", NARROW, COLOR, SECOND, THIRD, "1.2 + q.w",
        "vec2(0.08 + q.x, 0.3 + q.y)", "vec2(0.05 + q.z, 0.4 + q.w)",
        "vec2(0.2 + q.y, 0.5 + q.x)", "q.y", "q.xyz", NORMAL, TANGENT,
    ),
    "hair with narrow highlights": closure(
        "chiang_hair_bsdf", NEEDLES, COLOR, SECOND, THIRD, "1.2 + q.w",
        "vec2(0.04 * q.x, 0.05 * q.y)", "vec2(0.2 * q.z, 0.02 * q.w)",
        "vec2(0.004 * q.y, 0.004 * q.x)", "0.5 + 0.05 * q.y", "q.xyz", NORMAL, TANGENT,
    ),
    "smooth cloth": closure(
        "sheen_bsdf", 1e-7, "1.0", "rgb(vec3(100.0))", "0.02 * q.w", NORMAL, SMOOTHLY
    ),
}  # fmt: skip
JOINED: Nodes = {
    "layer": joined("layer_bsdf", f"{A}, {B}", f"layer({OURS_A}, {OURS_B})"),
    "layer on a volume": joined("layer_vdf", f"{A}, {B}", f"layer_on_volume({OURS_A}, {OURS_B})"),
    "mix": joined("mix_bsdf", f"{A}, {B}, p.w", f"mixed({OURS_B}, {OURS_A}, p.w)"),
    "add": joined("add_bsdf", f"{A}, {B}", f"added({OURS_A}, {OURS_B})"),
    "times a number": joined("multiply_bsdf_float", f"{A}, r.x", f"scaled({OURS_A}, r.x)"),
    "times a colour": joined(
        "multiply_bsdf_color3", f"{A}, r.xyz", f"scaled({OURS_A}, rgb(r.xyz))"
    ),
    "volume": joined("anisotropic_vdf", "q.xyz, q.yzw, q.x", f"absorbing_volume({ASKED}, q.xyz)"),
}
SENT: Nodes = {
    "generalized_schlick_edf": Node(
        f"mx_generalized_schlick_edf(makeClosureData(4, vec3(0.0), {TO_EYE}, {NORMAL}, vec3(0.0), "
        "1.0), q.xyz, q.zwx, 1.0 + 5.0 * q.y, q.wyz, three)",
        f"vec3(generalized_schlick_edf({TO_EYE}, {NORMAL}, rgb(q.xyz), rgb(q.zwx), 1 + 5 * q.y, "
        "rgb(q.wyz)))",
        3,
        ROUNDED,
        (*AROUND, f"{PBR}/mx_generalized_schlick_edf.glsl"),
    ),
    "uniform_edf": Node(
        f"mx_uniform_edf(makeClosureData(4, vec3(0.0), {TO_EYE}, {NORMAL}, vec3(0.0), 1.0), q.xyz, "
        "three)",
        "vec3(uniform_edf(rgb(q.xyz)))",
        3,
        1e-7,
        (*AROUND, f"{PBR}/mx_uniform_edf.glsl"),
    ),
}
NOT_LIT = "int(2.0 * fract(p.x))"
BELOW: Nodes = {
    "subsurface without a light": Node(
        f"even_light = {EVEN}; BSDF b = BSDF(vec3(0.0), vec3(1.0)); mx_subsurface_bsdf("
        f"makeClosureData(3 - {NOT_LIT}, {TO_LIGHT}, {TO_EYE}, {NORMAL}, vec3(0.0), 1.0), "
        f"{WEIGHT}, q.xyz, q.zxy, 0.5, {NORMAL}, b); "
        f"four = vec4(b.response, dot(b.throughput, {SHARES}))",
        f"lanes_of(subsurface_bsdf(Asked((1 + {NOT_LIT} as Asking), {TO_LIGHT}, {TO_EYE}, "
        f"rgb({EVEN})), {WEIGHT}, rgb(q.xyz), rgb(q.zxy), 0.5, {NORMAL}, p.xyz))",
        4,
        ROUNDED,
        (*AROUND, f"{PBR}/mx_subsurface_bsdf.glsl"),
    ),
    "light around a ball": Node(
        f"three = mx_integrate_burley_diffusion({NORMAL}, {TO_EYE}, 0.1 + 3.0 * q.w, q.xyz)",
        f"vec3(lit_around(acos(dot({NORMAL}, {TO_EYE})), 0.1 + 3.0 * q.w, rgb(q.xyz)))",
        3,
        NARROW,
        (*AROUND, f"{PBR}/lib/mx_microfacet_diffuse.glsl"),
    ),
}
FRESNEL: Nodes = {
    f"{model} {name}": Node(
        f"FresnelData data = mx_init_fresnel_{model}({theirs}, {', '.join(film)}); "
        f"three = mx_compute_fresnel(0.001 + 0.999 * q.w, data)",
        f"vec3({model}_fresnel({ours}, {', '.join(film)}, 0.001 + 0.999 * q.w))",
        3,
        NARROW,
        (f"{PBR}/lib/mx_microfacet_specular.glsl",),
    )
    for name, film in (("alone", NO_FILM), ("below a film", ("p.w * 100.0", "0.9 + 1.5 * q.x")))
    for model, theirs, ours in (
        ("dielectric", INDEX, INDEX),
        ("conductor", "0.1 + 2.0 * q.zyx, abs(r.xyz)", "rgb(0.1 + 2.0 * q.zyx), rgb(abs(r.xyz))"),
        (
            "schlick",
            "max(1.2 * q.xyz - 0.1, 0.0), q.zyx, r.xyz, 1.0 + 5.0 * q.y",
            "max(rgb(1.2 * q.xyz - 0.1), 0.0), rgb(q.zyx), rgb(r.xyz), 1.0 + 5.0 * q.y",
        ),
    )
}
SHARED: Nodes = {
    "share": Node(
        "three = mx_ggx_dir_albedo(q.x, q.y, r.xyz, r.yzw)",
        "vec3(facet_share(facet_shares(q.x, q.y), rgb(r.xyz), rgb(r.yzw)))",
        3,
        ROUNDED,
        (f"{PBR}/lib/mx_microfacet_specular.glsl",),
    ),
    "compensation": Node(
        "three = mx_ggx_energy_compensation(q.x, q.y, r.xyz)",
        "vec3(facet_compensation(rgb(r.xyz), facet_shares(q.x, q.y)))",
        3,
        ROUNDED,
        (f"{PBR}/lib/mx_microfacet_specular.glsl",),
    ),
}
ANGLES = "0.01 + 0.99 * q.x, 0.01 + 0.99 * q.y, q.z"
"""Any cosines of the eye, of the light, and between both, whether these can be together or not."""
SPREAD: Nodes = {
    name: Node(
        f"three = vec3(1.0) * {theirs}",
        f"vec3({ours}) * vec3(1)",
        3,
        near,
        (f"{PBR}/lib/mx_microfacet_diffuse.glsl",),
    )
    for name, near, theirs, ours in (
        (
            "cosines on oren_nayar",
            ROUNDED,
            f"mx_oren_nayar_diffuse({ANGLES}, q.w)",
            f"oren_nayar_share({ANGLES}, q.w)",
        ),
        (
            "cosines on compensated",
            NARROW,
            f"mx_oren_nayar_compensated_diffuse({ANGLES}, q.w, q.zxy)",
            f"compensated_share({ANGLES}, q.w, rgb(q.zxy))",
        ),
        (
            "cosines on burley",
            ROUNDED,
            f"mx_burley_diffuse({ANGLES}, q.w)",
            f"burley_share({ANGLES}, q.w)",
        ),
    )
}
KINDS = (GLOSS, MATT, CLOTH, JOINED, SENT, BELOW, FRESNEL, SHARED, SPREAD)
NODES: Nodes = {name: node for nodes in KINDS for name, node in nodes.items()}
assert len(NODES) == sum(map(len, KINDS)), "two nodes have the same name"


def of(module: str, names: str) -> list[str]:
    """The full names of declarations of a file."""
    return [f"std.mtlx.{module}.{name}" for name in names.split()]


COMMON = of("asking", "Asked Asking Bsdf mtlx_least")
SIDES = of("asking", "facing_normal cosine_of")


@truth(*of("closures", "dielectric_bsdf conductor_bsdf generalized_schlick_bsdf"), *COMMON, *SIDES)
@truth(*of("asking", "clear_bsdf"), *of("closures", "opaque opaque_bsdf"))
@truth(*of("facets", "Facets facets_of facets_lit facet_density even_density film_share"))
@truth(*of("facets", "facets_answer ScatterMode"))
@pytest.mark.parametrize("name", GLOSS)
def test_gloss(name: str) -> None:
    assert_alike(NODES, name, IMPORTS)


@truth(*of("fresnel", "hoffman_fresnel Film film_of film_on film_orders film_rgb grey"))
@truth(*of("fresnel", "even_rgb_of_xyz film_on_clear film_on_dielectric film_on_schlick"))
@truth(*of("fresnel", "film_on_conductor metal_orders dielectric_fresnel conductor_fresnel"))
@truth(*of("fresnel", "schlick_fresnel"), "std.iridescence.film_xyz")
@pytest.mark.parametrize("name", FRESNEL)
def test_fresnel(name: str) -> None:
    assert_alike(NODES, name, IMPORTS)


@truth(*of("facets", "facet_shares fit_at_0 fit_at_1 fit_at_2 facet_compensation facet_share"))
@pytest.mark.parametrize("name", SHARED)
def test_even_light_on_facets(name: str) -> None:
    assert_alike(NODES, name, IMPORTS)


@truth(*of("closures", "oren_nayar_diffuse_bsdf burley_diffuse_bsdf translucent_bsdf opaque"))
@truth(*of("matt", "oren_nayar_share oren_nayar_even compensated_share compensated_even"))
@truth(*of("matt", "scattered fujii_even fujii_mean burley_share burley_even"), *SIDES, *COMMON)
@pytest.mark.parametrize("name", MATT)
def test_matt_surfaces(name: str) -> None:
    assert_alike(NODES, name, IMPORTS)


@truth(*of("matt", "oren_nayar_share compensated_share scattered fujii_even fujii_mean"))
@truth(*of("matt", "burley_share"))
@pytest.mark.parametrize("name", SPREAD)
def test_cosines_on_matt_surfaces(name: str) -> None:
    assert_alike(NODES, name, IMPORTS)


@truth(*of("closures", "sheen_bsdf SheenMode chiang_hair_bsdf"))
@truth(*of("sheen", "conty_kulla_share conty_kulla_even zeltner_even zeltner_density"))
@truth(*of("hair", "other bessel_i0 strand_cones strand_bells within_turn strand_light"))
@pytest.mark.parametrize("name", CLOTH)
def test_cloth_and_hair(name: str) -> None:
    assert_alike(NODES, name, IMPORTS)


@truth(*of("hair", "bessel_i0"))
def test_bessel_by_its_series() -> None:
    x = np.linspace(0, 12, 40).reshape(10, 4)
    terms = [(0.25 * x * x) ** k / math.factorial(k) ** 2 for k in range(10)]
    found = called("import std.mtlx.hair", "bessel_i0(x)", 4, x=x)
    assert found == pytest.approx(sum(terms), rel=1e-12)


@truth(*of("asking", "layer layer_on_volume mixed added scaled absorbing_volume"))
@pytest.mark.parametrize("name", JOINED)
def test_closures_that_are_put_together(name: str) -> None:
    assert_alike(NODES, name, IMPORTS)


@truth(*of("asking", "mixed SurfaceLook"))
def test_looks_that_are_mixed() -> None:
    """Coverage is mixed as colours are, which are times their coverage already."""
    looks = "SurfaceLook(rgb(0.2, 0.4, 0.8), 1), SurfaceLook(rgb(1, 0, 0.4), 0.2)"
    found = called(IMPORTS, f"mixed({looks}, x).color", 3, x=np.array([0.0, 0.25, 1.0]))
    assert found == close([(0.2, 0.4, 0.8), (0.4, 0.3, 0.7), (1.0, 0.0, 0.4)])
    found = called(IMPORTS, f"mixed({looks}, x).alpha", 1, x=np.array([0.0, 0.25, 1.0]))
    assert found == close([1.0, 0.8, 0.2])


@truth(*of("closures", "uniform_edf generalized_schlick_edf"))
@pytest.mark.parametrize("name", SENT)
def test_light_that_surfaces_send(name: str) -> None:
    assert_alike(NODES, name, IMPORTS)


@truth(*of("closures", "subsurface_bsdf"))
@truth(*of("matt", "lit_around Around part_of_turn way_to profile"))
@pytest.mark.parametrize("name", BELOW)
def test_light_below_skin(name: str) -> None:
    assert_alike(NODES, name, IMPORTS)


@truth(*of("closures", "subsurface_bsdf"))
@pytest.mark.parametrize(
    ("size", "height", "side"),
    [(0.2, 0.8, 1), (5.0, 0.8, 1), (1000.0, 0.8, 1), (5.0, -0.8, 1), (5.0, 0.8, -1)],
)
def test_round_bodies_are_known_by_their_normals(size: float, height: float, side: int) -> None:
    # The normals of a ball at places that are as far apart as neighbouring pixels.
    x, y = np.meshgrid([0.3, 0.31], [0.2, 0.215])
    normals = np.stack([x, y, np.sqrt(1 - x * x - y * y)], axis=-1)
    color, path, to_light = "rgb(0.8, 0.5, 0.3)", "rgb(0.4, 0.3, 0.2)", f"vec3(0.6, 0, {height})"
    found = called(
        IMPORTS,
        f"vec3(subsurface_bsdf(by_light({to_light}, vec3(0, 0, {side})), 0.5, {color}, {path}, 0, "
        f"n, {size} * n).response)",
        3,
        n=Quad(normals),
    )
    angle = np.arccos(side * normals[0, 0] @ [0.6, 0, height])
    around = called(IMPORTS, f"vec3(lit_around(a, {min(size, 100.0)}, {path}))", 3, a=[angle])
    assert found[0, 0] == pytest.approx(0.5 * np.array([0.8, 0.5, 0.3]) * around[0] / np.pi)


@truth(*of("asking", "by_light from_everywhere passing"), *COMMON)
def test_questions() -> None:
    eye, light, colors = [[0.0, 0.6, 0.8]], [[0.6, 0.0, 0.8]], [[0.2, 0.4, 0.7]]
    asked = {
        "by_light(l, e)": [0, *light[0], *eye[0], 0, 0, 0],
        "from_everywhere(e, rgb(c))": [1, 0, 0, 0, *eye[0], *colors[0]],
        "passing(e, rgb(c))": [2, 0, 0, 0, *eye[0], *colors[0]],
    }
    for call, wanted in asked.items():
        lanes = [called(IMPORTS, f"float({call}.kind) + 0 * e.x", e=eye, l=light, c=colors)[0]]
        for part in ("to_light", "to_eye", "radiance"):
            expression = f"vec3({call}.{part}) + 0 * (l + e + c)"
            lanes += list(called(IMPORTS, expression, 3, e=eye, l=light, c=colors)[0])
        assert lanes == pytest.approx(wanted)


WHITE, ALL_LIGHT, UP = (
    "rgb(1, 1, 1)",
    "from_everywhere(normalize(e), rgb(1, 1, 1))",
    "vec3(0, 0, 1)",
)
GREY = "rgb(0.3, 0.3, 0.3)"


@truth(*of("closures", "dielectric_bsdf generalized_schlick_bsdf sheen_bsdf"))
@pytest.mark.parametrize(
    "closure",
    [
        f"dielectric_bsdf({ALL_LIGHT}, w, {WHITE}, 1.5, vec2(a), false, 0, 1, {UP}, {UP})",
        f"generalized_schlick_bsdf({ALL_LIGHT}, w, {GREY}, {WHITE}, {WHITE}, 5, vec2(a), false, 0, "
        f"1, {UP}, {UP})",
        f"sheen_bsdf({ALL_LIGHT}, w, {WHITE}, a, {UP}, SheenMode.conty_kulla)",
        f"sheen_bsdf({ALL_LIGHT}, w, {WHITE}, a, {UP}, SheenMode.zeltner)",
    ],
)
def test_all_light_is_sent_or_reaches_what_lies_below(closure: str) -> None:
    chance = np.random.default_rng(3).uniform(0.02, 1, (64, 5))
    found = called(
        IMPORTS, f"vec3({closure}.response + {closure}.throughput)", 3,
        e=chance[:, :3] - [0.5, 0.5, 0], w=chance[:, 3], a=chance[:, 4],
    )  # fmt: skip
    assert found == pytest.approx(np.ones((64, 3)))


@truth(*of("matt", "compensated_even compensated_share"))
def test_white_plaster_sends_all_light() -> None:
    chance = np.random.default_rng(4).uniform(0.02, 1, (64, 4))
    response = f"oren_nayar_diffuse_bsdf({ALL_LIGHT}, 1, {WHITE}, a, {UP}, true).response"
    found = called(
        IMPORTS, f"vec3({response})", 3,
        e=chance[:, :3] - [0.5, 0.5, 0], a=chance[:, 3],
    )  # fmt: skip
    assert found == pytest.approx(np.ones((64, 3)))
