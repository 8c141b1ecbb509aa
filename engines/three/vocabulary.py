"""What modules for three.js may import, and the functions that they may have themselves."""

from __future__ import annotations

from collections.abc import Mapping

from .sampling import NAMES

CLASSES = (
    "MeshPhysicalNodeMaterial", "MeshBasicNodeMaterial", "CodeNode", "FunctionNode", "Node",
    "Color", "Vector2", "Vector3", "Vector4", "Matrix3", "Matrix4", "DataUtils", "HalfFloatType",
    "DataTexture", "DataArrayTexture", "Data3DTexture", "CubeTexture", "LinearFilter",
    *sorted(NAMES - {"LinearFilter"}), "AdditiveBlending", "BackSide", "DoubleSide", "FrontSide",
    "MultiplyBlending",
)  # fmt: skip
"""The names that modules may import from `three/webgpu`."""
WORDS = (
    "Fn", "attribute", "cameraPosition", "cameraProjectionMatrix", "cameraViewMatrix",
    "cubeTexture", "frontFacing", "instanceIndex", "modelNormalMatrix", "modelWorldMatrix",
    "modelWorldMatrixInverse", "normalLocal", "positionLocal", "positionWorld", "sampler",
    "tangentLocal", "texture", "texture3D", "uint", "uniform", "uv", "varying", "vec2", "vec3",
    "vec4", "vertexIndex",
)  # fmt: skip
"""The names that modules may import from `three/tsl`."""

TEXTURE_HELPERS: Mapping[str, str] = {
    "texel": "const texel = (...numbers) => ready(new DataTexture(halves(numbers), 1, 1));",
    "layeredTexel": (
        "const layeredTexel = (...numbers) => "
        "ready(new DataArrayTexture(halves(numbers), 1, 1, 1));"
    ),
    "volumeTexel": (
        "const volumeTexel = (...numbers) => ready(new Data3DTexture(halves(numbers), 1, 1, 1));"
    ),
    "cubeTexel": (
        "const cubeTexel = (...numbers) => ready(new CubeTexture(Array.from({ length: 6 }, () => "
        "ready(new DataTexture(halves(numbers), 1, 1)))));"
    ),
}
"""The functions that make default textures, of half floats: these are filtered everywhere."""
