"""Describes TypeScript as a language of hosts."""

from __future__ import annotations

from pathlib import Path

from ..folding import Style
from ..host_language import HostLanguage
from ..naming import camel, pascal
from ..spelling import Manner
from .printer import TypeScriptPrinter
from .texts import texts

_KEYWORDS = """
    abstract any arguments as async await bigint boolean break case catch class const continue
    debugger declare default delete do else enum eval export extends false finally for from function
    get if implements import in infer instanceof interface is keyof let module namespace never new
    null number object of package private protected public readonly require return satisfies set
    static string super switch symbol this throw true try type typeof undefined unique unknown var
    void while with yield
"""
_OF_SKELETON = """
    Area Array ArrayLike Attachment Bindings Blend Block BlockClass Blocks Bound COVER Drawn Error
    Float32Array Frame FrameBuffer FrameHost FrameTexture Gl GlBindings GlMesh GlModel GlResources
    GlTexture Infinity Int32Array JSON LAYOUT_ID Lanes Map Material Math Mesh Model NaN NoBlocks
    Number Numbers Object Omit Partial Pass PipelineState Profile ROLES RangeError Record
    Reflection RenderState Resources Role SHOWN SIZE Source StencilSide Target Text Texture
    Uint32Array
    Uint8Array Use VertexInput WeakMap WebGlFrames WebGpuFrames Written bytes checked common
    complete computePipeline constructor counted drawGlMesh drawMesh elements exponentOf f32 finite
    glFormat glProgram glTarget glWord halved hasOwnProperty i32 integer isPrototypeOf isSame known
    member lanesOf layoutOf linked materials modules nearest programs propertyIsEnumerable
    prototype remainder renderPipeline reset samplerOf setGlState showOnCanvas stage stale store
    texts toLocaleString toString turn u32 usageOf value valueOf values whole
"""
"""Words of the skeleton, and those that objects have themselves."""

LANGUAGE = HostLanguage(
    name="typescript",
    title="TypeScript",
    extension="ts",
    skeleton=Path(__file__).with_name("binding.ts.j2"),
    printer=TypeScriptPrinter,
    texts=texts,
    style=Style(comments=("//",), last_comma=True, indent="  "),
    manner=Manner(
        reserved=frozenset((*_KEYWORDS.split(), *_OF_SKELETON.split())),
        type_case=pascal,
        function_case=camel,
        value_case=camel,
        constant_case=camel,
    ),
)
