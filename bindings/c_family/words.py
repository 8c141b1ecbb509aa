"""The words of tables as enumerations, each with the constant of Vulkan that says the same.

Skeletons write them as enumerations of the host, in this order, and the section for Vulkan has the
constants by their numbers. The words are those of documents, which are WebGPU's where it has any.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache

from ...support.frozen import frozen


@frozen(kw_only=True)
class Words:
    """An enumeration of a table."""

    name: str
    vulkan: str
    """The type of Vulkan's constants; empty where Vulkan has none."""
    constants: Mapping[str, str]
    """The constant of Vulkan by each word, without what the constants of the type begin with."""
    prefix: str = ""

    def constant(self, word: str) -> str:
        """The constant of Vulkan for a word."""
        return f"{self.prefix}{self.constants[word]}"


def _plain(*words: str) -> Mapping[str, str]:
    """Words whose constants have the same name."""
    return {word: word.replace("-", "_").upper() for word in words}


def _lanes(name: str, type_: str) -> Mapping[str, str]:
    """The vertex formats of one to four numbers."""
    lanes = ("R32", "R32G32", "R32G32B32", "R32G32B32A32")
    words = (f"{name}32", f"{name}32x2", f"{name}32x3", f"{name}32x4")
    return {word: f"{each}_{type_}" for word, each in zip(words, lanes, strict=True)}


_COMPARISONS = {
    **_plain("never", "less", "equal"), "less-equal": "LESS_OR_EQUAL", **_plain("greater"),
    "not-equal": "NOT_EQUAL", "greater-equal": "GREATER_OR_EQUAL", **_plain("always"),
}  # fmt: skip
_FACTORS = {
    **_plain("zero", "one"), "src": "SRC_COLOR", "one-minus-src": "ONE_MINUS_SRC_COLOR",
    **_plain("src-alpha", "one-minus-src-alpha"), "dst": "DST_COLOR",
    "one-minus-dst": "ONE_MINUS_DST_COLOR", **_plain("dst-alpha", "one-minus-dst-alpha"),
    "src-alpha-saturated": "SRC_ALPHA_SATURATE", "constant": "CONSTANT_COLOR",
    "one-minus-constant": "ONE_MINUS_CONSTANT_COLOR",
}  # fmt: skip
_FORMATS = {
    "r8unorm": "R8_UNORM", "r16float": "R16_SFLOAT", "r32float": "R32_SFLOAT",
    "rg8unorm": "R8G8_UNORM", "rg16float": "R16G16_SFLOAT", "rg32float": "R32G32_SFLOAT",
    "rgba8unorm": "R8G8B8A8_UNORM", "rgba8unorm-srgb": "R8G8B8A8_SRGB",
    "bgra8unorm": "B8G8R8A8_UNORM", "bgra8unorm-srgb": "B8G8R8A8_SRGB",
    "rgb10a2unorm": "A2B10G10R10_UNORM_PACK32", "rgba16float": "R16G16B16A16_SFLOAT",
    "rgba32float": "R32G32B32A32_SFLOAT", "depth32float": "D32_SFLOAT",
    "depth32float-stencil8": "D32_SFLOAT_S8_UINT",
}  # fmt: skip

WORDS = (
    Words(
        name="Kind", vulkan="VkDescriptorType", prefix="VK_DESCRIPTOR_TYPE_",
        constants={
            "uniform": "UNIFORM_BUFFER", "storage": "STORAGE_BUFFER", "texture": "SAMPLED_IMAGE",
            "sampler": "SAMPLER", "image": "STORAGE_IMAGE", "result": "STORAGE_BUFFER",
            "combined": "COMBINED_IMAGE_SAMPLER",
            "push-constants": "MAX_ENUM",  # They lie in no descriptor.
        },
    ),
    Words(
        name="VertexFormat", vulkan="VkFormat", prefix="VK_FORMAT_",
        constants={
            "none": "UNDEFINED", **_lanes("float", "SFLOAT"), **_lanes("uint", "UINT"),
            **_lanes("sint", "SINT"),
        },
    ),
    Words(name="Format", vulkan="VkFormat", prefix="VK_FORMAT_", constants=_FORMATS),
    Words(
        name="Dimension", vulkan="VkImageViewType", prefix="VK_IMAGE_VIEW_TYPE_",
        constants=_plain("2d", "2d-array", "3d", "cube", "cube-array"),
    ),
    Words(
        name="SampleType", vulkan="",
        constants=_plain("float", "unfilterable-float", "depth", "sint", "uint"),
    ),
    Words(
        name="SamplerType", vulkan="",
        constants=_plain("none", "filtering", "non-filtering", "comparison"),
    ),
    Words(name="Intent", vulkan="", constants=_plain("color", "data")),
    Words(name="Encoding", vulkan="", constants=_plain("linear", "srgb")),
    Words(
        name="Filter", vulkan="VkFilter", prefix="VK_FILTER_",
        constants=_plain("nearest", "linear"),
    ),
    Words(
        name="Mip", vulkan="VkSamplerMipmapMode", prefix="VK_SAMPLER_MIPMAP_MODE_",
        constants={"none": "NEAREST", **_plain("nearest", "linear")},
    ),
    Words(
        name="Wrap", vulkan="VkSamplerAddressMode", prefix="VK_SAMPLER_ADDRESS_MODE_",
        constants={
            **_plain("repeat", "clamp-to-edge"), "mirror-repeat": "MIRRORED_REPEAT",
            **_plain("clamp-to-border"),
        },
    ),
    Words(
        name="Border", vulkan="VkBorderColor", prefix="VK_BORDER_COLOR_FLOAT_",
        constants={
            "transparent": "TRANSPARENT_BLACK", "black": "OPAQUE_BLACK", "white": "OPAQUE_WHITE",
        },
    ),
    Words(
        name="Compare", vulkan="VkCompareOp", prefix="VK_COMPARE_OP_", constants=_COMPARISONS
    ),
    Words(
        name="Factor", vulkan="VkBlendFactor", prefix="VK_BLEND_FACTOR_", constants=_FACTORS
    ),
    Words(
        name="Operation", vulkan="VkBlendOp", prefix="VK_BLEND_OP_",
        constants=_plain("add", "subtract", "reverse-subtract", "min", "max"),
    ),
    Words(
        name="StencilOperation", vulkan="VkStencilOp", prefix="VK_STENCIL_OP_",
        constants={
            **_plain("keep", "zero", "replace", "invert"),
            "increment-clamp": "INCREMENT_AND_CLAMP", "decrement-clamp": "DECREMENT_AND_CLAMP",
            "increment-wrap": "INCREMENT_AND_WRAP", "decrement-wrap": "DECREMENT_AND_WRAP",
        },
    ),
    Words(
        name="Topology", vulkan="VkPrimitiveTopology", prefix="VK_PRIMITIVE_TOPOLOGY_",
        constants=_plain(
            "point-list", "line-list", "triangle-list", "line-list-with-adjacency",
            "triangle-list-with-adjacency", "patch-list",
        ),
    ),
    Words(
        name="Cull", vulkan="VkCullModeFlagBits", prefix="VK_CULL_MODE_",
        constants={"none": "NONE", "back": "BACK_BIT", "front": "FRONT_BIT"},
    ),
    Words(
        name="Fill", vulkan="VkPolygonMode", prefix="VK_POLYGON_MODE_",
        constants={"faces": "FILL", "lines": "LINE"},
    ),
    Words(
        name="TextureUse", vulkan="VkImageUsageFlagBits", prefix="VK_IMAGE_USAGE_",
        constants={
            "target": "COLOR_ATTACHMENT_BIT", "depth": "DEPTH_STENCIL_ATTACHMENT_BIT",
            "image": "STORAGE_BIT", "sampled": "SAMPLED_BIT", "copied_from": "TRANSFER_SRC_BIT",
            "copied_to": "TRANSFER_DST_BIT",
        },
    ),
    Words(
        name="Winding", vulkan="VkFrontFace", prefix="VK_FRONT_FACE_",
        constants={"ccw": "COUNTER_CLOCKWISE", "cw": "CLOCKWISE"},
    ),
)  # fmt: skip
"""All enumerations of tables."""


@cache
def words_of(name: str) -> Words:
    """The enumeration of this name."""
    return next(each for each in WORDS if each.name == name)
