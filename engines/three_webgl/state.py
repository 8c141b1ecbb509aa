"""The state of a pass as properties of three.js's materials, and what three.js cannot do."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ...compiler.documents.drawing import TargetRow
from ...compiler.documents.reflection import Reflection
from ...compiler.ir.blending import Blend

SIDES = {"none": "DoubleSide", "back": "FrontSide", "front": "BackSide"}
DEPTHS = {
    "never": "NeverDepth", "less": "LessDepth", "equal": "EqualDepth",
    "less_equal": "LessEqualDepth", "greater": "GreaterDepth", "not_equal": "NotEqualDepth",
    "greater_equal": "GreaterEqualDepth", "always": "AlwaysDepth",
}  # fmt: skip
FACTORS = {
    "zero": "ZeroFactor", "one": "OneFactor", "src": "SrcColorFactor",
    "one_minus_src": "OneMinusSrcColorFactor", "src_alpha": "SrcAlphaFactor",
    "one_minus_src_alpha": "OneMinusSrcAlphaFactor", "dst": "DstColorFactor",
    "one_minus_dst": "OneMinusDstColorFactor", "dst_alpha": "DstAlphaFactor",
    "one_minus_dst_alpha": "OneMinusDstAlphaFactor",
    "src_alpha_saturated": "SrcAlphaSaturateFactor", "constant": "ConstantColorFactor",
    "one_minus_constant": "OneMinusConstantColorFactor",
}  # fmt: skip
OPERATIONS = {
    "add": "AddEquation", "subtract": "SubtractEquation",
    "reverse_subtract": "ReverseSubtractEquation", "min": "MinEquation", "max": "MaxEquation",
}  # fmt: skip


def lacking(reflection: Reflection) -> Iterator[str]:
    """What the draw needs and three.js does not do, each as the rest of a sentence."""
    state, draw = reflection.render_state, reflection.draw
    if reflection.extent is not None:
        yield "it is a kernel, and WebGL has none"
    if reflection.capture is not None:
        yield "its pass captures vertices, and draws nothing"
    if draw.expanded_by is not None or draw.tessellation is not None:
        yield "it makes vertices of its own"
    if draw.layers is not None:
        yield "its pass draws several layers"
    if state.stencil is not None:
        yield "its pass has a stencil test"
    if state.front != "counter_clockwise":
        yield "its pass has clockwise front faces"
    if any(row.mask not in ("none", _lanes(row)) for row in reflection.targets):
        yield "its pass writes some lanes of a target only"


def _lanes(row: TargetRow) -> str:
    """The lanes that the target's format has."""
    return "rgba"[: len(row.format) - len(row.format.lstrip("rgba"))]


def state_of(reflection: Reflection) -> Mapping[str, str]:
    """The properties of the material, each with its value in JavaScript."""
    state = reflection.render_state
    depth = state.depth
    found = {"side": SIDES[state.cull], "forceSinglePass": "true"}
    found["depthTest"] = "true" if depth.is_used else "false"
    found |= {
        "depthFunc": DEPTHS[depth.compare],
        "depthWrite": "true" if depth.write else "false",
    }
    if depth.bias or depth.slope_bias:
        found |= {
            "polygonOffset": "true", "polygonOffsetFactor": f"{depth.slope_bias:g}",
            "polygonOffsetUnits": str(depth.bias),
        }  # fmt: skip
    if state.alpha_to_coverage:
        found["alphaToCoverage"] = "true"
    if reflection.targets and reflection.targets[0].mask == "none":
        found["colorWrite"] = "false"
    blend = next((row.blend for row in reflection.targets if row.blend is not None), None)
    return found | ({"blending": "NoBlending"} if blend is None else _blending(blend))


def _blending(blend: Blend) -> dict[str, str]:
    color, alpha = blend.color, blend.alpha
    return {
        "transparent": "true", "blending": "CustomBlending",
        "blendEquation": OPERATIONS[color.operation], "blendSrc": FACTORS[color.source],
        "blendDst": FACTORS[color.destination], "blendEquationAlpha": OPERATIONS[alpha.operation],
        "blendSrcAlpha": FACTORS[alpha.source], "blendDstAlpha": FACTORS[alpha.destination],
    }  # fmt: skip
