"""Makes the state that a material asks for, for hosts that set it call by call as WebGL does."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...compiler.documents.writing import to_json
from ..model import Material

PROFILE = "glsl:es300"


def has_webgl(material: Material) -> bool:
    """True if a material is compiled for WebGL 2."""
    return any(profile.name == PROFILE for profile in material.profiles)


def state(material: Material) -> Mapping[str, Any]:
    """The state of the pipeline, in WebGPU's words."""
    row = to_json(material.reflection.render_state)
    depth, stencil = row["depth"], row["stencil"]
    targets = [to_json(each) for each in material.reflection.targets]
    return {
        "topology": to_json(material.reflection.draw)["topology"],
        "cull": row["cull"],
        "alphaToCoverage": row["alpha_to_coverage"],
        "depth": {
            "compare": depth["compare"], "write": depth["write"], "bias": depth["bias"],
            "slopeBias": depth["slope_bias"],
        },
        "stencil": None if stencil is None else _stencil(stencil),
        "targets": [{"blend": each["blend"], "mask": each["mask"]} for each in targets],
    }  # fmt: skip


def _stencil(row: Mapping[str, Any]) -> Mapping[str, Any]:
    sides = {name: row[name] for name in ("front", "back")}
    return {
        "reference": row["reference"], "readMask": row["read_mask"],
        "writeMask": row["write_mask"],
        **{
            name: {
                "compare": side["compare"], "failOp": side["fail_op"],
                "depthFailOp": side["depth_fail_op"], "passOp": side["pass_op"],
            }
            for name, side in sides.items()
        },
    }  # fmt: skip
