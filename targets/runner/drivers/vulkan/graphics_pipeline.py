"""Creates the graphics pipeline: shaders, vertex inputs and all fixed-function state."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from typing import Any

import vulkan as vk

from .....compiler.ir.blending import REPLACES, Factor, Operation
from .....compiler.ir.render_state import (
    Cull,
    Fill,
    StencilOperation,
    StencilSide,
    StencilState,
)
from ..checks import lane_count
from ..pipeline import Code, Pipeline, Primitive, StepMode, VertexInput
from ..render_state import RenderTarget, Winding
from .device import Gpu
from .formats import VERTICES
from .texture_images import COMPARES

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

BLEND_OPERATIONS: dict[Operation, int] = {
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
        colorBlendOp=BLEND_OPERATIONS[blend.color.operation],
        srcAlphaBlendFactor=FACTORS[blend.alpha.source],
        dstAlphaBlendFactor=FACTORS[blend.alpha.destination],
        alphaBlendOp=BLEND_OPERATIONS[blend.alpha.operation],
        colorWriteMask=sum(bit for lane, bit in LANES.items() if target.writes(lane)),
    )


CULL: dict[Cull, int] = {
    "none": vk.VK_CULL_MODE_NONE,
    "back": vk.VK_CULL_MODE_BACK_BIT,
    "front": vk.VK_CULL_MODE_FRONT_BIT,
}

STAGES: dict[str, int] = {
    "vertex": vk.VK_SHADER_STAGE_VERTEX_BIT,
    "control": vk.VK_SHADER_STAGE_TESSELLATION_CONTROL_BIT,
    "evaluation": vk.VK_SHADER_STAGE_TESSELLATION_EVALUATION_BIT,
    "geometry": vk.VK_SHADER_STAGE_GEOMETRY_BIT,
    "fragment": vk.VK_SHADER_STAGE_FRAGMENT_BIT,
}

TOPOLOGIES: dict[Primitive, int] = {
    "point": vk.VK_PRIMITIVE_TOPOLOGY_POINT_LIST,
    "line": vk.VK_PRIMITIVE_TOPOLOGY_LINE_LIST,
    "triangle": vk.VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST,
    "line_adjacency": vk.VK_PRIMITIVE_TOPOLOGY_LINE_LIST_WITH_ADJACENCY,
    "triangle_adjacency": vk.VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST_WITH_ADJACENCY,
    "patch": vk.VK_PRIMITIVE_TOPOLOGY_PATCH_LIST,
}

RATES: dict[StepMode, int] = {
    "vertex": vk.VK_VERTEX_INPUT_RATE_VERTEX,
    "instance": vk.VK_VERTEX_INPUT_RATE_INSTANCE,
}

FRONT: dict[Winding, int] = {
    "ccw": vk.VK_FRONT_FACE_COUNTER_CLOCKWISE,
    "cw": vk.VK_FRONT_FACE_CLOCKWISE,
}
"""Windings. Vulkan determines them in the framebuffer, so after the effect of ``viewport``."""

FILLS: dict[Fill, int] = {"faces": vk.VK_POLYGON_MODE_FILL, "lines": vk.VK_POLYGON_MODE_LINE}

OPERATIONS: dict[StencilOperation, int] = {
    "keep": vk.VK_STENCIL_OP_KEEP,
    "zero": vk.VK_STENCIL_OP_ZERO,
    "replace": vk.VK_STENCIL_OP_REPLACE,
    "invert": vk.VK_STENCIL_OP_INVERT,
    "increment_clamp": vk.VK_STENCIL_OP_INCREMENT_AND_CLAMP,
    "decrement_clamp": vk.VK_STENCIL_OP_DECREMENT_AND_CLAMP,
    "increment_wrap": vk.VK_STENCIL_OP_INCREMENT_AND_WRAP,
    "decrement_wrap": vk.VK_STENCIL_OP_DECREMENT_AND_WRAP,
}


def viewport(pipeline: Pipeline, left: int, top: int, width: int, height: int) -> Any:
    """A ``VkViewport`` that makes the first row the top one.

    Vulkan's clip y points down, so the height is negative for a text that is not flipped.
    """
    if pipeline.flip_y:
        return vk.VkViewport(float(left), float(top), float(width), float(height), 0.0, 1.0)
    bottom = float(top + height)
    return vk.VkViewport(float(left), bottom, float(width), -float(height), 0.0, 1.0)


def make_pipeline(
    owned: ExitStack, gpu: Gpu, pipeline: Pipeline, layout: Any, render_pass: Any
) -> Any:
    """The pipeline; viewport, scissors and the blend constant are set for each draw.

    Structures in lists have names here: the binding copies them, and what they point to only lives
    as long as they do.
    """
    with ExitStack() as modules:
        stages = [
            make_stage(modules, gpu, STAGES[name], code) for name, code in pipeline.stages.items()
        ]
        gpu.messages.check()
        blends = [blend_state(target) for target in pipeline.targets]
        dynamic = (
            vk.VK_DYNAMIC_STATE_VIEWPORT,
            vk.VK_DYNAMIC_STATE_SCISSOR,
            vk.VK_DYNAMIC_STATE_BLEND_CONSTANTS,
        )
        info = vk.VkGraphicsPipelineCreateInfo(
            pStages=stages,
            pVertexInputState=_vertex_inputs(pipeline.inputs),
            pInputAssemblyState=vk.VkPipelineInputAssemblyStateCreateInfo(
                topology=TOPOLOGIES[pipeline.primitive]
            ),
            pTessellationState=_tessellation(pipeline),
            pViewportState=vk.VkPipelineViewportStateCreateInfo(viewportCount=1, scissorCount=1),
            pRasterizationState=_rasterization(pipeline),
            pMultisampleState=vk.VkPipelineMultisampleStateCreateInfo(
                rasterizationSamples=pipeline.samples,
                alphaToCoverageEnable=pipeline.alpha_to_coverage,
            ),
            pDepthStencilState=_depth_stencil(pipeline),
            pColorBlendState=vk.VkPipelineColorBlendStateCreateInfo(pAttachments=blends),
            pDynamicState=vk.VkPipelineDynamicStateCreateInfo(pDynamicStates=dynamic),
            layout=layout,
            renderPass=render_pass,
        )
        infos = [info]
        handle = vk.vkCreateGraphicsPipelines(gpu.device, None, 1, infos, None)[0]
    owned.callback(vk.vkDestroyPipeline, gpu.device, handle, None)
    return handle


def make_stage(modules: ExitStack, gpu: Gpu, stage: int, code: Code) -> Any:
    """One stage of a pipeline, with a module that lasts until the pipeline is made."""
    info = vk.VkShaderModuleCreateInfo(codeSize=len(code.spirv), pCode=code.spirv)
    module = vk.vkCreateShaderModule(gpu.device, info, None)
    modules.callback(vk.vkDestroyShaderModule, gpu.device, module, None)
    return vk.VkPipelineShaderStageCreateInfo(stage=stage, module=module, pName=code.entry)


def _vertex_inputs(inputs: Sequence[VertexInput]) -> Any:
    bindings = [
        vk.VkVertexInputBindingDescription(binding, 4 * lane_count(each.format), RATES[each.step])
        for binding, each in enumerate(inputs)
    ]
    attributes = [
        vk.VkVertexInputAttributeDescription(each.location, binding, VERTICES[each.format], 0)
        for binding, each in enumerate(inputs)
    ]
    return vk.VkPipelineVertexInputStateCreateInfo(
        pVertexBindingDescriptions=bindings, pVertexAttributeDescriptions=attributes
    )


def _tessellation(pipeline: Pipeline) -> Any:
    if pipeline.primitive != "patch":
        return None
    return vk.VkPipelineTessellationStateCreateInfo(patchControlPoints=pipeline.patch_points)


def _rasterization(pipeline: Pipeline) -> Any:
    depth = pipeline.depth
    return vk.VkPipelineRasterizationStateCreateInfo(
        depthBiasEnable=pipeline.has_bias,
        depthBiasConstantFactor=depth.bias,
        depthBiasSlopeFactor=depth.slope_bias,
        depthBiasClamp=depth.bias_clamp,
        polygonMode=FILLS[pipeline.fill],
        cullMode=CULL[pipeline.cull],
        frontFace=FRONT[pipeline.front_face],
        lineWidth=1.0,
        rasterizerDiscardEnable=pipeline.stream_output is not None,
    )


def _depth_stencil(pipeline: Pipeline) -> Any:
    stencil = pipeline.stencil
    sides = (
        {}
        if stencil is None
        else {
            "stencilTestEnable": vk.VK_TRUE,
            "front": _stencil_side(stencil, stencil.front),
            "back": _stencil_side(stencil, stencil.back),
        }
    )
    return vk.VkPipelineDepthStencilStateCreateInfo(
        depthTestEnable=vk.VK_TRUE,
        depthWriteEnable=pipeline.depth.write,
        depthCompareOp=COMPARES[pipeline.depth.compare],
        **sides,
    )


def _stencil_side(stencil: StencilState, side: StencilSide) -> Any:
    return vk.VkStencilOpState(
        failOp=OPERATIONS[side.fail_op],
        passOp=OPERATIONS[side.pass_op],
        depthFailOp=OPERATIONS[side.depth_fail_op],
        compareOp=COMPARES[side.compare],
        compareMask=stencil.read_mask,
        writeMask=stencil.write_mask,
        reference=stencil.reference,
    )
