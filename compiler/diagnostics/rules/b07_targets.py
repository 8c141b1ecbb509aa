"""B07: features that targets lack, and the tools that check their texts."""

from __future__ import annotations

from .row import error, warning

UNSUPPORTED = error(
    "B0701",
    "{target} has no {feature}",
    "The target's language cannot express this, and no exact replacement is known.",
)
TOO_MANY = error(
    "B0702",
    "{count} {what}, but {target} has only {limit}",
    "Every device of the target is guaranteed to have as many as the limit says, and compilers "
    "accept them.",
)
REJECTED = error(
    "B0703",
    "{checker} rejects `{file}`: {text}",
    "Every text that Burnish writes should be accepted, so this is a fault of Burnish and not of "
    "the material. Please report it together with the material.",
)
DOUBTED = warning(
    "B0704",
    "{checker} about `{file}`: {text}",
    "The text was accepted, but with this remark.",
)
TOOL_BROKE = error(
    "B0705",
    "{checker} gives no answer about `{file}`: {reason}",
    "The tool crashed or took too long. That is the tool's fault. The shader has not been checked.",
)
TOOL_MISSING = error(
    "B0706",
    "{checker} cannot be run: {problem}",
    "`burnish doctor` lists the tools, with a command that installs each missing one.",
)
ASKED_OF_DEVICES = warning(
    "B0707",
    "{count} {what}, and not every device of {target} has more than {limit}",
    "The text is written. A host has to ask the device for as many, and to do without the material "
    "where a device has fewer: the reflection says it, `required_limits` of the backend.",
)
BINDING_SCHEME = error(
    "B0708",
    "{file}: {problem}",
    "A scheme of bindings has the tables `sets`, `resources`, `first` and `kinds`, and the values "
    "`combined_samplers` and `push_constants`; the page on commands explains them.",
)
OCCUPIED = error(
    "B0709",
    "`{name}` and `{other}` both have binding {binding} of group {group} for {target}",
    "A binding number is used once in a group. Blocks have numbers that follow from the groups of "
    "parameters, so that all materials agree; textures and buffers take what is free.",
)
NO_TEXT_OF_MODULE = error(
    "B0710",
    "`--emit {format}` compiles texts of {profile}, which is not among the targets",
    "SPIR-V is made of the GLSL for Vulkan, and DXIL of HLSL: name the target as well, or leave "
    "`--target` out. A reflection has the bindings of a module where it has those of the text.",
)
NOT_OPTIMISED = error(
    "B0711",
    "the SPIR-V of `{file}` cannot be optimized: {reason}",
    "`--optimize` needs spirv-opt of SPIRV-Tools; `burnish doctor` says how to install it. Nothing "
    "was written.",
)
