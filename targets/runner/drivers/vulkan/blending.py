"""The blend state and the write mask of a target, in Vulkan's words."""

from __future__ import annotations

from typing import Any

import vulkan as vk

from .....compiler.ir.blending import REPLACES, Factor, Operation
from ..render_state import RenderTarget

FACTORS: dict[Factor, int] = {
    "zero": vk.VK_BLEND_FACTOR_ZERO,
    "one": vk.VK_BLEND_FACTOR_ONE,
    "src": vk.VK_BLEND_FACTOR_SRC_COLOR,
    "one_minus_src": vk.VK_BLEND_FACTOR_ONE_MINUS_SRC_COLOR,
    "src_alpha": vk.VK_BLEND_FACTOR_SRC_ALPHA,
    "one_minus_src_alpha": vk.VK_BLEND_FACTOR_ONE_MINUS_SRC_ALPHA,
    "dst": vk.VK_BLEND_FACTOR_DST_COLOR,
    "one_minus_dst": vk.VK_BLEND_FACTOR_ONE_MINUS_DST_COLOR,
    "dst_alpha": vk.VK_BLEND_FACTOR_DST_ALPHA,
    "one_minus_dst_alpha": vk.VK_BLEND_FACTOR_ONE_MINUS_DST_ALPHA,
    "src_alpha_saturated": vk.VK_BLEND_FACTOR_SRC_ALPHA_SATURATE,
    "constant": vk.VK_BLEND_FACTOR_CONSTANT_COLOR,
    "one_minus_constant": vk.VK_BLEND_FACTOR_ONE_MINUS_CONSTANT_COLOR,
}
"""Vulkan's blend factors. In the equation of alpha, a factor with a colour means the colour's
alpha."""

OPERATIONS: dict[Operation, int] = {
    "add": vk.VK_BLEND_OP_ADD,
    "subtract": vk.VK_BLEND_OP_SUBTRACT,
    "reverse_subtract": vk.VK_BLEND_OP_REVERSE_SUBTRACT,
    "min": vk.VK_BLEND_OP_MIN,
    "max": vk.VK_BLEND_OP_MAX,
}

LANES: dict[str, int] = {
    "r": vk.VK_COLOR_COMPONENT_R_BIT,
    "g": vk.VK_COLOR_COMPONENT_G_BIT,
    "b": vk.VK_COLOR_COMPONENT_B_BIT,
    "a": vk.VK_COLOR_COMPONENT_A_BIT,
}


def blend_state(target: RenderTarget) -> Any:
    """The state of one target of a pipeline."""
    blend = target.blend or REPLACES
    return vk.VkPipelineColorBlendAttachmentState(
        blendEnable=target.blend is not None,
        srcColorBlendFactor=FACTORS[blend.color.source],
        dstColorBlendFactor=FACTORS[blend.color.destination],
        colorBlendOp=OPERATIONS[blend.color.operation],
        srcAlphaBlendFactor=FACTORS[blend.alpha.source],
        dstAlphaBlendFactor=FACTORS[blend.alpha.destination],
        alphaBlendOp=OPERATIONS[blend.alpha.operation],
        colorWriteMask=sum(bit for lane, bit in LANES.items() if target.writes(lane)),
    )
