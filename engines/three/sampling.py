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


def sampling(state: SamplerState) -> Mapping[str, str]:
    """The properties of a texture that say how it is read, each with its value."""
    across, down = (getattr(state, f"wrap_{axis}") or state.wrap for axis in "uv")
    found = {
        "wrapS": WRAPS[across], "wrapT": WRAPS[down], "magFilter": MAGNIFIED[state.filter],
        "minFilter": FILTERS[state.filter, state.mip],
    }  # fmt: skip
    if state.anisotropy is not None:
        found["anisotropy"] = str(state.anisotropy)
    if state.compare is not None:
        found["compareFunction"] = COMPARISONS[state.compare]
    return found


def listed(properties: Mapping[str, str]) -> str:
    """The properties as an object of JavaScript."""
    return f"{{ {', '.join(f'{name}: {value}' for name, value in properties.items())} }}"
