"""How textures are read: the state of a sampler as properties of three.js's textures."""

from __future__ import annotations

from collections.abc import Mapping

from ...compiler.documents.drawing import SamplerState

WRAPS = {
    "repeat": "RepeatWrapping", "clamp": "ClampToEdgeWrapping", "mirror": "MirroredRepeatWrapping",
}  # fmt: skip
FILTERS = {
    ("linear", "linear"): "LinearMipmapLinearFilter",
    ("linear", "nearest"): "LinearMipmapNearestFilter",
    ("linear", "none"): "LinearFilter",
    ("nearest", "linear"): "NearestMipmapLinearFilter",
    ("nearest", "nearest"): "NearestMipmapNearestFilter",
    ("nearest", "none"): "NearestFilter",
}
"""The filter where a texture is shrunk, by the filter in a level and that between levels."""
MAGNIFIED = {"linear": "LinearFilter", "nearest": "NearestFilter"}
COMPARISONS = {
    "never": "NeverCompare", "less": "LessCompare", "equal": "EqualCompare",
    "less_equal": "LessEqualCompare", "greater": "GreaterCompare", "not_equal": "NotEqualCompare",
    "greater_equal": "GreaterEqualCompare", "always": "AlwaysCompare",
}  # fmt: skip
NAMES = frozenset((
    *WRAPS.values(), *FILTERS.values(), *MAGNIFIED.values(), *COMPARISONS.values()
))  # fmt: skip
"""The names that modules import for it."""


def sampling(state: SamplerState, dimension: str) -> Mapping[str, str]:
    """The properties of a texture that say how it is read, each with its value."""
    axes = {"wrapS": state.wrap_u, "wrapT": state.wrap_v}
    if dimension == "3d":
        axes["wrapR"] = state.wrap_w
    found = {name: WRAPS[wrap or state.wrap] for name, wrap in axes.items()}
    found["magFilter"] = MAGNIFIED[state.filter]
    found["minFilter"] = FILTERS[state.filter, state.mip]
    if state.anisotropy is not None:
        found["anisotropy"] = str(state.anisotropy)
    if state.compare is not None:
        found["compareFunction"] = COMPARISONS[state.compare]
    return found


def listed(properties: Mapping[str, str]) -> str:
    """The properties as an object of JavaScript."""
    return f"{{ {', '.join(f'{name}: {value}' for name, value in properties.items())} }}"
