"""One unit of light for all surfaces: a white matt one that faces a lamp has the lamp's colour."""

from __future__ import annotations

import numpy as np
import pytest

from ..semantics.kit import Painted
from .kit import NORMAL_IN_WORLD, TANGENT, TO_EYE, close, lanes, shown
from .truth import truth

MAPS = ("metallic_roughness_map", "normal_map", "occlusion_map", "emissive_map")
LAMP = np.array((0.5, 0.75, 1.5))
WHITE = "rgb(1, 1, 1)"
TEXTS = {
    "lambert": f"color = lambert({WHITE})",
    "eon": f"color = eon({WHITE}, 0)",
    "fujii": f"color = fujii({WHITE}, 0)",
    "oren_nayar": f"color = oren_nayar({WHITE}, 0)",
    "minnaert": f"color = minnaert({WHITE}, 1)",
    "wrapped_lambert": f"color = wrapped_lambert({WHITE}, rgb(0, 0, 0))",
    # Without facets, as these mirror a share.
    "metallic_rough": "base = vec4(1)\nmetalness = 0\nf0 = rgb(0, 0, 0)",
}


@truth(
    "std.terms.lambert", "std.gltf.metallic_rough", "std.reflectances.arriving_share",
    *(f"std.reflectances.{name}" for name in list(TEXTS)[1:-1]),
)  # fmt: skip
@pytest.mark.parametrize("name", TEXTS)
def test_white_surfaces_of_all_models_send_the_same(name: str) -> None:
    """The lamp shines from where the eye is, so that no share is mirrored at an angle."""
    base = "MetallicRoughness" if name == "metallic_rough" else "Surface"
    found = shown(
        "import std.gltf.{MetallicRoughness}\nimport std.lights.{Directional}\n"
        "import std.reflectances\nimport std.terms\n"
        f"material M : {base} {{\n{TEXTS[name]}\nambient_light = rgb(0, 0, 0)\n}}\n"
        "rig R { lamp : Directional }",
        vertex_tangent=(*TANGENT, 1.0), normal_scale=0.0, front_facing=(True,),
        **dict.fromkeys(MAPS, Painted(lambda *_: (0.5, 0.5, 1, 1))),
        **{"lamp.direction": lanes(-TO_EYE), "lamp.diffuse_color": lanes(LAMP)},
    )  # fmt: skip
    assert found == close(LAMP * (NORMAL_IN_WORLD @ TO_EYE))
