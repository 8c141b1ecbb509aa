"""Describes C++ as a language of hosts."""

from __future__ import annotations

from pathlib import Path

from ..c_family.words import WORDS
from ..folding import Style
from ..host_language import HostLanguage
from ..naming import pascal, snake
from ..spelling import Manner
from .functions import FUNCTIONS
from .printer import CppPrinter
from .texts import texts

_KEYWORDS = """
    alignas alignof and and_eq asm auto bitand bitor bool break case catch char char8_t char16_t
    char32_t class co_await co_return co_yield compl concept const consteval constexpr constinit
    const_cast continue decltype default delete do double dynamic_cast else enum explicit export
    extern false float for friend goto if inline int long mutable namespace new noexcept not not_eq
    nullptr operator or or_eq private protected public register reinterpret_cast requires return
    short signed sizeof static static_assert static_cast struct switch template this thread_local
    throw true try typedef typeid typename union unsigned using virtual void volatile wchar_t while
    xor xor_eq
"""
_OF_SKELETON = """
    Attachment Binding Blend Blocks Depth Equation Frame FrameBuffer FrameHost FrameTexture Kept
    LayoutId List Material Output Pass Profile Read Sampler Source Stencil StencilSide Tag Target
    Text Texture Use VertexInput Written bvec2 bvec3 bvec4 capacity count detail fault first has
    has_length_one ivec2 ivec3 ivec4 mat2 mat3 mat4 mat2x4 mat3x4 stale std uvec2 uvec3 uvec4 vec2
    vec3 vec4 vulkan near far min max assert errno NULL unix linux burnish
"""
"""Words of the skeleton, and some that headers of operating systems define as macros."""

LANGUAGE = HostLanguage(
    name="cpp",
    title="C++",
    extension="hpp",
    skeleton=Path(__file__).with_name("binding.hpp.j2"),
    printer=CppPrinter,
    texts=texts,
    style=Style(comments=("///", "//")),
    manner=Manner(
        reserved=frozenset(
            (*_KEYWORDS.split(), *_OF_SKELETON.split(), *FUNCTIONS, *(each.name for each in WORDS))
        ),
        type_case=pascal,
        function_case=snake,
        value_case=snake,
        constant_case=snake,
        only_ascii=True,
    ),
    has_namespace=True,
)
