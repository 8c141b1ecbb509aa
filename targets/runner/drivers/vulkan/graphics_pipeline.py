"""Creates the graphics pipeline: shaders, vertex inputs and all fixed-function state."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import ExitStack
from typing import Any, Literal

import vulkan as vk

from ..checks import lane_count
from ..draw import (
    Blend,
    BlendEquation,
    Code,
    Cull,
    Factor,
    Operation,
    Pipeline,
    Primitive,
    RenderTarget,
    StepMode,
    VertexInput,
)
from .device import Gpu
from .formats import VERTICES
from .texture_images import COMPARES

CULL: dict[Cull, int] = {
    "none": vk.VK_CULL_MODE_NONE,
    "back": vk.VK_CULL_MODE_BACK_BIT,
    "front": vk.VK_CULL_MODE_FRONT_BIT,
}

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
"""Of alpha, a factor of a colour is its alpha."""

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

REPLACED = Blend(BlendEquation(), BlendEquation())


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

FRONT: dict[Literal["ccw", "cw"], int] = {
    "ccw": vk.VK_FRONT_FACE_COUNTER_CLOCKWISE,
    "cw": vk.VK_FRONT_FACE_CLOCKWISE,
}
"""Windings. Vulkan determines them in the framebuffer, so after the effect of ``viewport``."""


def viewport(pipeline: Pipeline, width: int, height: int) -> Any:
    """A ``VkViewport`` that makes the first row the top one.

    Vulkan's clip y points down, so the height is negative for a text that is not flipped.
    """
    if pipeline.flip_y:
        return vk.VkViewport(0.0, 0.0, float(width), float(height), 0.0, 1.0)
    return vk.VkViewport(0.0, float(height), float(width), -float(height), 0.0, 1.0)


def make_layout(owned: ExitStack, gpu: Gpu, sets: Sequence[Any]) -> Any:
    """A pipeline layout from the layouts of descriptor sets."""
    info = vk.VkPipelineLayoutCreateInfo(pSetLayouts=sets)
    layout = vk.vkCreatePipelineLayout(gpu.device, info, None)
    owned.callback(vk.vkDestroyPipelineLayout, gpu.device, layout, None)
    return layout


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
        blends = [_blend(target) for target in pipeline.targets]
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
                rasterizationSamples=vk.VK_SAMPLE_COUNT_1_BIT
            ),
            pDepthStencilState=vk.VkPipelineDepthStencilStateCreateInfo(
                depthTestEnable=vk.VK_TRUE,
                depthWriteEnable=pipeline.depth_write,
                depthCompareOp=COMPARES[pipeline.depth_compare],
            ),
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
    return vk.VkPipelineRasterizationStateCreateInfo(
        polygonMode=vk.VK_POLYGON_MODE_FILL,
        cullMode=CULL[pipeline.cull],
        frontFace=FRONT[pipeline.front_face],
        lineWidth=1.0,
        rasterizerDiscardEnable=pipeline.stream_output is not None,
    )


def _blend(target: RenderTarget) -> Any:
    blend = target.blend or REPLACED
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
