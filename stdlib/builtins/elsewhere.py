"""The words of other shading languages that are no functions, and what is written here.

They are types, values, methods of textures, and keywords. The hints for unknown names are made of
these tables. Functions are in ``stdlib/other_names.txt``.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType


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
"""Types of other languages, and the most similar type here."""

COLUMNS_FIRST: Mapping[str, str] = MappingProxyType(
    dict.fromkeys(
        (f"{word}{r}x{c}" for c, r in _SHAPES for word in ("float", "half")),
        "columns are counted before rows",
    )
)
"""The types of HLSL whose names count rows before columns, and what to know about them."""

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
        **dict.fromkeys(("gl_ViewIndex", "gl_ViewID_OVR", "SV_ViewID", "ViewID",
                         "VIEW_INDEX", "unity_StereoEyeIndex"), "view_index"),
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
            ("typedef", "type", "interface", "namespace", "module", "impl", "trait",
             "extension"),
            "types are made by `struct Name { member : type, … }` and `enum Name { a, b }` only",
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
