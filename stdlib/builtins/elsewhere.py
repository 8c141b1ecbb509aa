"""The names of functions in other shading languages, and their replacements here.

Every function of GLSL 4.50 and ES 3.00 (chapter 8), of HLSL (the list of intrinsics) and of WGSL
(chapter "Built-in Functions") either is a builtin with the same name, or is in this table. The
hints for unknown names and docs/builtins.md are made from it.

What other systems have, and the library has under another name, is in ``library_names.py``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType

from ...support.frozen import frozen

TEXTURE = "albedo"
"""The name of the texture in ``Instead.written``."""


@frozen
class Instead:
    """The replacement here for a name of another language."""

    written: tuple[str, ...] = ()
    """Expressions with the same meaning, one for each result.

    The letters in them stand for values: ``x``, ``y``, ``z`` are floats, ``n`` and ``m`` ints,
    ``u`` and ``k`` uints, ``v`` and ``w`` vec3, ``p`` and ``q`` vec4, ``c`` and ``d`` bvec3, ``a``
    and ``b`` mat3. There are also the ``TEXTURE`` and the surface's ``uv``."""
    reason: str = ""
    """The reason why there is no such expression, or further advice."""

    @property
    def hint(self) -> str:
        """The hint in the message about the unknown name."""
        shown = " and ".join(f"`{expression}`" for expression in self.written)
        parts = [f"it is {shown} here" if shown else "", self.reason]
        return "; ".join(filter(None, parts))

    @property
    def is_read(self) -> bool:
        """True if the name is a function that reads a texture."""
        return any(expression.startswith(TEXTURE) for expression in self.written)

    def hint_for(self, texture: str) -> str:
        """The hint for somebody who reads this texture."""
        return self.hint.replace(TEXTURE, texture)


_READ = ("albedo(uv)",)
_TEXTURES = "a texture is read by calling it: see Textures in the language reference"


def same(names: str, *written: str, reason: str = "") -> Iterator[tuple[str, Instead]]:
    """Several names that mean the same."""
    for name in names.split():
        yield name, Instead(written, reason)


_MEMORY = "materials and passes have no memory to write to"
_NEIGHBOURS = (
    "a value knows nothing of other invocations, but for `ddx` and `ddy`, and in kernels "
    "`group_sum` and its like"
)
_FINITE = "finite operands have finite results: no value is infinite or NaN"
_WIDE = "there are no numbers of 64 bits"
_STAGES = "there are vertices and fragments only"
_SAMPLES = "a pixel is shaded once, whatever its samples"
_SHIFTS = "join and part the lanes with `<<`, `>>`, `&` and `|`"

_FUNCTIONS: tuple[Iterator[tuple[str, Instead]], ...] = (
    # ---- arithmetic
    same("lerp", "mix(x, y, z)"),
    same("frac", "fract(x)"),
    same("rsqrt inverseSqrt", "inversesqrt(x)"),
    same("fmod", "x - y * trunc(x / y)", reason="`x mod y` floors, and has the sign of y"),
    same("roundEven rint", "round(x)"),
    same("mad", "fma(x, y, z)"),
    same("rcp", "1 / x"),
    same("mul", "a * v"),
    same("modf", "trunc(x)", "x - trunc(x)"),
    same("frexp", "mantissa(x)", "exponent(x)"),
    same("sincos", "sin(x)", "cos(x)"),
    same("atan2f", "atan2(y, x)"),
    same("faceForward", "faceforward(v, w, v)"),
    same("matrixCompMult", "hadamard(a, b)"),
    same("outerProduct", "outer(v, w)"),
    same("dst", "vec4(1, p.y * q.y, p.z, q.w)"),
    same("isnan isinf isfinite", reason=_FINITE),
    # ---- several lanes
    same("lessThan", "v < w"),
    same("lessThanEqual", "v <= w"),
    same("greaterThan", "v > w"),
    same("greaterThanEqual", "v >= w"),
    same("equal", "v == w"),
    same("notEqual", "v != w"),
    same("select", "choose(c, v, w)", reason="the condition comes first, then what it chooses"),
    # ---- derivatives
    same("dFdx dFdxCoarse dFdxFine ddx_coarse ddx_fine dpdx dpdxCoarse dpdxFine", "ddx(x)"),
    same("dFdy dFdyCoarse dFdyFine ddy_coarse ddy_fine dpdy dpdyCoarse dpdyFine", "ddy(x)"),
    same("fwidthCoarse fwidthFine", "fwidth(x)"),
    # ---- bits
    same("bitCount countbits countOneBits", "count_bits(u)"),
    same("bitfieldReverse reversebits reverseBits", "reverse_bits(u)"),
    same("findMSB firstbithigh firstLeadingBit", "first_leading_bit(u)"),
    same("findLSB firstbitlow firstTrailingBit", "first_trailing_bit(u)"),
    same("countLeadingZeros", "31 - first_leading_bit(u)"),
    same("countTrailingZeros", "count_bits(~u & (u - 1))"),
    same("bitfieldExtract extractBits", "extract_bits(u, n, m)"),
    same("bitfieldInsert insertBits", "insert_bits(u, k, n, m)"),
    same("uaddCarry", "u + k", "uint(u + k < u)"),
    same("usubBorrow", "u - k", "uint(u < k)"),
    same("floatBitsToUint asuint", "bits_of(x)"),
    same("floatBitsToInt asint", "int(bits_of(x))"),
    same("uintBitsToFloat asfloat", "float_of_bits(u)"),
    same("intBitsToFloat", "float_of_bits(uint(n))"),
    same("bitcast", "bits_of(x)", "float_of_bits(u)", reason="`int` and `uint` keep the bits"),
    # ---- packing
    same("packUnorm4x8 pack4x8unorm", "pack_unorm4x8(p)"),
    same("packSnorm4x8 pack4x8snorm", "pack_snorm4x8(p)"),
    same("packUnorm2x16 pack2x16unorm", "pack_unorm2x16(uv)"),
    same("packSnorm2x16 pack2x16snorm", "pack_snorm2x16(uv)"),
    same("packHalf2x16 pack2x16float", "pack_half2x16(uv)"),
    same("unpackUnorm4x8 unpack4x8unorm", "unpack_unorm4x8(u)"),
    same("unpackSnorm4x8 unpack4x8snorm", "unpack_snorm4x8(u)"),
    same("unpackUnorm2x16 unpack2x16unorm", "unpack_unorm2x16(u)"),
    same("unpackSnorm2x16 unpack2x16snorm", "unpack_snorm2x16(u)"),
    same("unpackHalf2x16 unpack2x16float", "unpack_half2x16(u)"),
    same("f32tof16", "pack_half2x16(vec2(x, 0))"),
    same("f16tof32", "unpack_half2x16(u).x"),
    same("quantizeToF16", "quantize_half(x)"),
    same("unpack4xU8", "uvec4(u, u >> 8, u >> 16, u >> 24) & 255"),
    same("unpack4xI8", "ivec4(uvec4(u << 24, u << 16, u << 8, u)) >> 24"),
    same("D3DCOLORtoUBYTE4", "ivec4(p.zyxw * 255.002)"),
    same("pack4xI8 pack4xU8 pack4xI8Clamp pack4xU8Clamp", reason=_SHIFTS),
    same("dot4U8Packed dot4I8Packed msad4", reason=_SHIFTS),
    # ---- textures
    same(
        "texture texture1D texture2D texture3D textureCube tex1D tex2D tex3D texCUBE textureSample",
        *_READ,
    ),
    same(
        "texelFetchOffset textureLodOffset textureGradOffset textureOffset textureProj "
        "textureProjGrad textureProjGradOffset textureProjLod textureProjLodOffset "
        "textureProjOffset textureGatherOffset textureGatherOffsets textureQueryLod "
        "ComputeAccessedLod texture1DLod texture1DProj texture1DProjLod texture2DProj "
        "texture2DProjLod texture3DLod texture3DProj texture3DProjLod textureCubeLod shadow1D "
        "shadow1DLod shadow1DProj shadow1DProjLod shadow2D shadow2DLod shadow2DProj "
        "shadow2DProjLod tex1Dbias tex1Dgrad tex1Dlod tex1Dproj tex2Dbias tex2Dproj tex3Dbias "
        "tex3Dgrad tex3Dlod tex3Dproj texCUBEbias texCUBEgrad texCUBElod texCUBEproj "
        "textureGatherCompare textureNumLayers textureSampleBias textureSampleCompare "
        "textureSampleCompareLevel textureSampleBaseClampToEdge subpassLoad",
        reason=_TEXTURES,
    ),
    same("textureLod textureSampleLevel tex2Dlod texture2DLod", "albedo.level(uv, x)"),
    same("textureGrad textureSampleGrad tex2Dgrad", "albedo.grad(uv, ddx(uv), ddy(uv))"),
    same("texelFetch textureLoad", "albedo.load(ivec2(n, m))"),
    same("textureSize textureDimensions", "albedo.size()"),
    same("textureGather", "albedo.gather(uv, 0)"),
    same("textureQueryLevels textureNumLevels", "albedo.levels()"),
    same("CheckAccessFullyMapped", reason="textures are there as a whole"),
    # ---- not offered
    same("clip", reason="a pass says `discard when x < 0`"),
    same("ftransform", reason="`clip_position` is a slot like any other"),
    same("packDouble2x32 unpackDouble2x32 asdouble umulExtended imulExtended", reason=_WIDE),
    same(
        "interpolateAtCentroid interpolateAtOffset interpolateAtSample EvaluateAttributeCentroid "
        "EvaluateAttributeAtSample EvaluateAttributeSnapped GetRenderTargetSampleCount "
        "GetRenderTargetSamplePosition textureSamples textureNumSamples",
        reason=_SAMPLES,
    ),
    same(
        "EmitVertex EmitStreamVertex EndPrimitive EndStreamPrimitive Process2DQuadTessFactorsAvg "
        "Process2DQuadTessFactorsMax Process2DQuadTessFactorsMin ProcessIsolineTessFactors "
        "ProcessQuadTessFactorsAvg ProcessQuadTessFactorsMax ProcessQuadTessFactorsMin "
        "ProcessTriTessFactorsAvg ProcessTriTessFactorsMax ProcessTriTessFactorsMin",
        reason=_STAGES,
    ),
    same(
        "allInvocations allInvocationsEqual anyInvocation quadBroadcast quadSwapDiagonal quadSwapX "
        "quadSwapY subgroupAdd subgroupAll subgroupAnd subgroupAny subgroupBallot "
        "subgroupBroadcast subgroupBroadcastFirst subgroupElect subgroupExclusiveAdd "
        "subgroupExclusiveMul subgroupInclusiveAdd subgroupInclusiveMul subgroupMax subgroupMin "
        "subgroupMul subgroupOr subgroupShuffle subgroupShuffleDown subgroupShuffleUp "
        "subgroupShuffleXor subgroupXor",
        reason=_NEIGHBOURS,
    ),
    same(
        "AllMemoryBarrier AllMemoryBarrierWithGroupSync DeviceMemoryBarrier "
        "DeviceMemoryBarrierWithGroupSync GroupMemoryBarrier GroupMemoryBarrierWithGroupSync "
        "InterlockedAdd InterlockedAnd InterlockedCompareExchange InterlockedCompareStore "
        "InterlockedExchange InterlockedMax InterlockedMin InterlockedOr InterlockedXor "
        "arrayLength atomicAdd atomicAnd atomicCompSwap atomicCompareExchangeWeak atomicCounter "
        "atomicCounterAdd atomicCounterAnd atomicCounterCompSwap atomicCounterDecrement "
        "atomicCounterExchange atomicCounterIncrement atomicCounterMax atomicCounterMin "
        "atomicCounterOr atomicCounterSubtract atomicCounterXor atomicExchange atomicLoad "
        "atomicMax atomicMin atomicOr atomicStore atomicSub atomicXor barrier bufferArrayView "
        "bufferLength bufferView groupMemoryBarrier imageAtomicAdd imageAtomicAnd "
        "imageAtomicCompSwap imageAtomicExchange imageAtomicMax imageAtomicMin imageAtomicOr "
        "imageAtomicXor imageLoad imageSamples imageSize imageStore memoryBarrier "
        "memoryBarrierAtomicCounter memoryBarrierBuffer memoryBarrierImage memoryBarrierShared "
        "storageBarrier textureBarrier textureStore workgroupBarrier workgroupUniformLoad",
        reason=_MEMORY,
    ),
    same("printf print errorf abort", reason="shaders have nobody to tell"),
    # ---- functions of engines, and of languages that are not for shading
    same("sum", "v.x + v.y + v.z", reason="a sum over numbers is `sum i in a..b : e`"),
    same("product", "v.x * v.y * v.z", reason="a product is `product i in a..b : e`"),
    same("len", reason="the length of an array is part of its type: it is the number written"),
    same("range", reason="numbers in a row are `a..b`, in `sum i in a..b : e` and its like"),
    same("array", reason="an array is `[a, b, c]`, its type `float[3]`"),
)

FUNCTIONS: Mapping[str, Instead] = MappingProxyType(
    {name: instead for group in _FUNCTIONS for name, instead in group}
)
"""Functions of other languages, by their names there."""


def _vectors(prefix: str, ours: str, suffixes: str = "234") -> Mapping[str, str]:
    return {f"{prefix}{n}": f"{ours}{n}" for n in suffixes}


_SHAPES = [(columns, rows) for columns in (2, 3, 4) for rows in (2, 3, 4) if columns != rows]
"""The columns and rows of the matrices that are not square."""

TYPES: Mapping[str, str] = MappingProxyType(
    {
        **_vectors("float", "vec"),
        **_vectors("half", "vec"),
        **_vectors("int", "ivec"),
        **_vectors("uint", "uvec"),
        **_vectors("bool", "bvec"),
        **{f"vec{n}f": f"vec{n}" for n in (2, 3, 4)},
        **{f"vec{n}h": f"vec{n}" for n in (2, 3, 4)},
        **{f"vec{n}i": f"ivec{n}" for n in (2, 3, 4)},
        **{f"vec{n}u": f"uvec{n}" for n in (2, 3, 4)},
        **{f"{word}{n}x{n}": f"mat{n}" for n in (2, 3, 4) for word in ("float", "half", "mat")},
        **{f"mat{n}x{n}f": f"mat{n}" for n in (2, 3, 4)},
        **{f"{word}{r}x{c}": f"mat{c}x{r}" for c, r in _SHAPES for word in ("float", "half")},
        **{f"mat{c}x{r}f": f"mat{c}x{r}" for c, r in _SHAPES},
        **{f"dmat{c}x{r}": f"mat{c}x{r}" for c, r in _SHAPES},
        **_vectors("dvec", "vec"), **_vectors("dmat", "mat"),
        **_vectors("fixed", "vec"), **_vectors("vector", "vec"), "fixed": "float",
        "color3": "rgb", "color4": "rgba", "filename": "texture2d",
        "f32": "float", "f16": "float", "half": "float", "double": "float", "i32": "int",
        "u32": "uint", "dword": "uint", "sampler2D": "texture2d", "Texture2D": "texture2d",
        "texture_2d": "texture2d",
        "sampler3D": "texture3d", "Texture3D": "texture3d", "texture_3d": "texture3d",
        "samplerCube": "texture_cube", "TextureCube": "texture_cube",
        "sampler2DArray": "texture2d_array", "Texture2DArray": "texture2d_array",
        "texture_2d_array": "texture2d_array", "sampler2DShadow": "depth2d",
        "samplerCubeArray": "texture_cube_array", "TextureCubeArray": "texture_cube_array",
        "texturecube_array": "texture_cube_array", "texture_cubearray": "texture_cube_array",
        "samplerCubeShadow": "depth_cube", "texture_depth_cube": "depth_cube",
        "samplerCubeArrayShadow": "depth_cube_array", "depthcube_array": "depth_cube_array",
        "texture_depth_cube_array": "depth_cube_array",
        "texture_depth_2d": "depth2d", "isampler2D": "itexture2d", "usampler2D": "utexture2d",
        "color": "rgb", "colour": "rgb",
    }
)  # fmt: skip
COLUMNS_FIRST: Mapping[str, str] = MappingProxyType(
    dict.fromkeys(
        (f"{word}{r}x{c}" for c, r in _SHAPES for word in ("float", "half")),
        "columns are counted before rows",
    )
)
"""The types of HLSL whose names count rows before columns, and what to know about them."""
"""Types of other languages, and the most similar type here."""

VALUES: Mapping[str, str] = MappingProxyType(
    {
        "gl_Vertex": "vertex_position", "gl_Normal": "vertex_normal",
        "gl_MultiTexCoord0": "vertex_uv", "UV0": "uv", "texcoord": "uv", "TexCoord": "uv",
        "N": "normal", "V": "to_eye", "P": "position", "cameraPosition": "eye",
        "_WorldSpaceCameraPos": "eye", "unity_ObjectToWorld": "object_to_world",
        **dict.fromkeys(("modelMatrix", "model_matrix", "model"), "object_to_world"),
        **dict.fromkeys(("worldPos", "world_pos", "worldPosition", "vWorldPosition", "fragPos",
                         "FragPos"), "position"),
        **dict.fromkeys(("viewDir", "view_dir", "viewDirection", "eyeDir"), "to_eye"),
        **dict.fromkeys(("cameraPos", "camera_pos", "camPos", "viewPos"), "eye"),
        **dict.fromkeys(("worldNormal", "vNormal"), "normal"),
        **dict.fromkeys(("viewProjection", "viewProj", "view", "projection"), "view_projection"),
        **dict.fromkeys(("lightDir", "light_dir", "lightDirection", "L"), "light.to_light"),
        **dict.fromkeys(("lightColor", "light_color", "_LightColor0", "LIGHT_COLOR"),
                        "light.diffuse"),
        "gl_FragCoord": "frag_coord", "SV_Position": "frag_coord",
        "gl_FrontFacing": "front_facing", "SV_IsFrontFace": "front_facing",
        "gl_Position": "clip_position", "gl_FragColor": "color",
        "gl_VertexID": "vertex_index", "SV_VertexID": "vertex_index", "vertex_id": "vertex_index",
        "gl_InstanceID": "instance_index", "SV_InstanceID": "instance_index",
        "instance_id": "instance_index", "M_PI": "pi", "PI": "pi", "True": "true", "TRUE": "true",
        "False": "false", "FALSE": "false", "vUv": "uv", "vUV": "uv", "UV": "uv",
        "NORMAL": "normal",
        "VIEW": "to_eye", "FRAGCOORD": "frag_coord", "FRONT_FACING": "front_facing",
        "MODEL_MATRIX": "object_to_world", "positionWorld": "position", "normalWorld": "normal",
        "positionLocal": "vertex_position", "normalLocal": "vertex_normal",
        "black": "#000", "silver": "#c0c0c0", "gray": "#808080", "grey": "#808080",
        "white": "#fff", "maroon": "#800000", "red": "#f00", "purple": "#800080",
        "fuchsia": "#f0f", "magenta": "#f0f", "green": "#0f0",
        "olive": "#808000", "yellow": "#ff0", "navy": "#000080", "blue": "#00f",
        "teal": "#008080", "aqua": "#0ff", "cyan": "#0ff", "orange": "#ffa500",
        "brown": "#a52a2a", "pink": "#ffc0cb", "gold": "#ffd700", "turquoise": "#40e0d0",
        "violet": "#ee82ee", "indigo": "#4b0082", "beige": "#f5f5dc", "crimson": "#dc143c",
        "coral": "#ff7f50", "salmon": "#fa8072", "khaki": "#f0e68c",
    }
)  # fmt: skip
"""Inputs and outputs of other languages' pipelines, and names of colours."""

METHODS: Mapping[str, str] = MappingProxyType(
    {
        **dict.fromkeys(("Sample", "sample", "read", "rgba"), "name(coordinate)"),
        **dict.fromkeys(("SampleLevel", "lod", "sample_level"), "name.level(coordinate, level)"),
        **dict.fromkeys(("SampleBias", "sample_bias"), "name.bias(coordinate, bias)"),
        **dict.fromkeys(("SampleGrad", "sample_grad"), "name.grad(coordinate, dx, dy)"),
        **dict.fromkeys(
            ("SampleCmp", "SampleCmpLevelZero", "sample_compare"), "name(coordinate, reference)"
        ),
        **dict.fromkeys(("Load", "fetch"), "name.load(texel, level)"),
        **dict.fromkeys(("GetDimensions", "width", "height"), "name.size()"),
        "Gather": "name.gather(coordinate, lane)",
    }
)
"""Texture methods of other languages, and how to read such a texture here."""

_HOST = "a value that the host sets is a parameter: `param name : type`"
_LOOP = "there are no statements; `sum i in 0..n : e` and `iterate` repeat"

KEYWORDS: Mapping[str, str] = MappingProxyType(
    {
        "uniform": _HOST, "cbuffer": _HOST,
        "varying": "`@vertex e` is computed at the vertices and interpolated",
        "in": "what the mesh gives is read by its name, such as `uv`, or declared by "
        "`attribute name : type`",
        "out": "a pass writes to `target name : format = e`",
        "return": "a function is one expression: `fn f(x: float) -> float = x * x`",
        "void": "a function is one expression: `fn f(x: float) -> float = x * x`",
        "for": _LOOP, "while": _LOOP, "do": _LOOP, "loop": _LOOP,
        **dict.fromkeys(
            ("switch", "match", "case"), "there are no statements; `if c then a else b` chooses"
        ),
        "layout": "a block that the host owns is `extern block Name at group 0, binding 3 { … }`",
        "precision": "numbers have 32 bits; nothing has to be said of precision",
        "lambda": "a function is declared outside: `fn name(x: float) = x * x`",
        **dict.fromkeys(
            ("np", "numpy", "math", "Math"), "functions have no module in front: `sin(x)`"
        ),
        "is": "equality is `==`",
        **dict.fromkeys(("edition", "version"), "the edition is named by `burnish 1`"),
        "discard": "a pass discards pixels by `discard when condition`",
        "sampler": "a texture is `map name : texture2d`",
        **dict.fromkeys(
            ("lightPos", "light_pos", "lightPosition", "light_position", "LIGHT"),
            "lights are read in a `term … per light`: `light.to_light` is the direction to one",
        ),
        **dict.fromkeys(
            ("gl_ViewIndex", "view_index", "SV_ViewID", "gl_ViewID_OVR", "unity_StereoEyeIndex"),
            "each view is drawn by itself: what differs between views is a `param … per view`",
        ),
        **dict.fromkeys(
            ("fragment", "vertex", "compute"),
            "entry points are not written: `material Name { color = … }` says what a surface looks "
            "like",
        ),
        **dict.fromkeys(
            ("IN", "In", "OUT", "input", "vin", "varyings", "attributes"),
            "the inputs of a surface are read by their names alone: `uv`, `normal`, `position`",
        ),
        **dict.fromkeys(
            ("option", "variant", "keyword", "permutation", "static_switch"),
            "a choice between variants is a slot, `quality : int = 1`, which derived materials "
            "set, or a `param` that the host sets",
        ),
        **dict.fromkeys(
            ("ifdef", "ifndef", "endif"),
            "there is no preprocessor; `if c then a else b` of a constant costs nothing",
        ),
        **dict.fromkeys(
            ("def", "func", "function", "sub", "proc"),
            "a function is `fn name(x: float, y: vec3) -> float = expression`",
        ),
        **dict.fromkeys(
            ("class", "shader", "Shader", "SubShader", "surface", "technique", "effect",
             "shader_type", "render_mode"),
            "a surface is `material Name { … }`",
        ),
        **dict.fromkeys(
            ("include", "using", "use", "from", "require"),
            "a file is imported by `import std.terms` or `import std.terms.{lambert}`",
        ),
        **dict.fromkeys(
            ("export", "public", "private", "pub"),
            "all that a file declares can be imported from it; no word says so",
        ),
        **dict.fromkeys(
            ("enum", "typedef", "type", "interface", "namespace", "module", "impl", "trait",
             "extension"),
            "types are made by `struct Name { member : type, … }` only",
        ),
        "where": "functions and terms name parts behind `where`; in a record all equations do",
        "super": "the value that a base gives is `inherited.name`",
        **dict.fromkeys(("this", "self"), "a record's own slots are read by their names alone"),
        **dict.fromkeys(("null", "nil", "None"), "every slot has a value"),
        "burnish": "`burnish 1` stands in front of all declarations",
        **dict.fromkeys(
            ("static", "inline", "precise", "highp", "mediump", "lowp", "flat"),
            "an equation is `name = expression`; the compiler sees to the rest",
        ),
        "invariant": "`raster { invariant = true }` of a pass; frames, and passes that compare "
        "depths for being equal, see to it",
    }
)  # fmt: skip
"""Words that begin statements and declarations in other languages."""
