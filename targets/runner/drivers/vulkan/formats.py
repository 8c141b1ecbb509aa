"""Vulkan's formats, for each of the formats that ``draw`` names."""

from __future__ import annotations

import vulkan as vk

from .....compiler.ir.formats import VertexFormat
from ..render_state import DepthFormat, TargetFormat
from ..texels import Dimension, TextureFormat

DEPTHS: dict[DepthFormat, int] = {
    "depth32float": vk.VK_FORMAT_D32_SFLOAT,
    "depth32float-stencil8": vk.VK_FORMAT_D32_SFLOAT_S8_UINT,
}
ASPECTS: dict[DepthFormat, int] = {
    "depth32float": vk.VK_IMAGE_ASPECT_DEPTH_BIT,
    "depth32float-stencil8": vk.VK_IMAGE_ASPECT_DEPTH_BIT | vk.VK_IMAGE_ASPECT_STENCIL_BIT,
}

TEXTURES: dict[TextureFormat, int] = {
    "rgba8unorm": vk.VK_FORMAT_R8G8B8A8_UNORM,
    "rgba8unorm-srgb": vk.VK_FORMAT_R8G8B8A8_SRGB,
    "rgba32float": vk.VK_FORMAT_R32G32B32A32_SFLOAT,
    "depth32float": vk.VK_FORMAT_D32_SFLOAT,
    "r8uint": vk.VK_FORMAT_R8_UINT,
    "rgba8uint": vk.VK_FORMAT_R8G8B8A8_UINT,
    "r32uint": vk.VK_FORMAT_R32_UINT,
    "rgba32uint": vk.VK_FORMAT_R32G32B32A32_UINT,
    "r32sint": vk.VK_FORMAT_R32_SINT,
    "rgba32sint": vk.VK_FORMAT_R32G32B32A32_SINT,
}

VIEWS: dict[Dimension, int] = {
    "2d": vk.VK_IMAGE_VIEW_TYPE_2D,
    "2d_array": vk.VK_IMAGE_VIEW_TYPE_2D_ARRAY,
    "3d": vk.VK_IMAGE_VIEW_TYPE_3D,
    "cube": vk.VK_IMAGE_VIEW_TYPE_CUBE,
    "cube_array": vk.VK_IMAGE_VIEW_TYPE_CUBE_ARRAY,
}

TARGETS: dict[TargetFormat, int] = {
    "r32float": vk.VK_FORMAT_R32_SFLOAT,
    "rg32float": vk.VK_FORMAT_R32G32_SFLOAT,
    "rgba32float": vk.VK_FORMAT_R32G32B32A32_SFLOAT,
    "r16float": vk.VK_FORMAT_R16_SFLOAT,
    "rg16float": vk.VK_FORMAT_R16G16_SFLOAT,
    "rgba16float": vk.VK_FORMAT_R16G16B16A16_SFLOAT,
    "r8unorm": vk.VK_FORMAT_R8_UNORM,
    "rg8unorm": vk.VK_FORMAT_R8G8_UNORM,
    "rgba8unorm": vk.VK_FORMAT_R8G8B8A8_UNORM,
    "rgba8unorm-srgb": vk.VK_FORMAT_R8G8B8A8_SRGB,
}

VERTICES: dict[VertexFormat, int] = {
    "float32": vk.VK_FORMAT_R32_SFLOAT,
    "float32x2": vk.VK_FORMAT_R32G32_SFLOAT,
    "float32x3": vk.VK_FORMAT_R32G32B32_SFLOAT,
    "float32x4": vk.VK_FORMAT_R32G32B32A32_SFLOAT,
    "sint32": vk.VK_FORMAT_R32_SINT,
    "sint32x2": vk.VK_FORMAT_R32G32_SINT,
    "sint32x3": vk.VK_FORMAT_R32G32B32_SINT,
    "sint32x4": vk.VK_FORMAT_R32G32B32A32_SINT,
    "uint32": vk.VK_FORMAT_R32_UINT,
    "uint32x2": vk.VK_FORMAT_R32G32_UINT,
    "uint32x3": vk.VK_FORMAT_R32G32B32_UINT,
    "uint32x4": vk.VK_FORMAT_R32G32B32A32_UINT,
}
