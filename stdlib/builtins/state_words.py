"""Words of other APIs for the state of pipelines and samplers.

They are comparisons, factors, and the settings themselves. The hints for unknown words are made
from it: ``GL_LEQUAL`` is ``less_equal`` here. WebGPU's words are those of the language, with ``-``
for ``_``.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from types import MappingProxyType

_PREFIX = re.compile(
    r"gl_(func_)?|func_"
    r"|vk_(compare_op|blend_factor|blend_op|stencil_op|cull_mode|front_face|polygon_mode|filter"
    r"|sampler_address_mode)_"
    r"|d3d1[12]_(comparison(_func)?|blend(_op)?|stencil_op|cull(_mode)?|fill(_mode)?"
    r"|texture_address(_mode)?)_"
)
"""The prefixes of names of OpenGL, Vulkan and Direct3D."""
_SUFFIX = re.compile(r"_(bit|color)$")

_OF_DIRECT3D = re.compile(r"d3d1[12]_stencil_op_(in|de)cr$")
"""The operations that wrap in Direct3D, although OpenGL's words like these clamp."""

_WORDS: Mapping[str, str] = MappingProxyType(
    {
        "lequal": "less_equal", "less_or_equal": "less_equal",
        "gequal": "greater_equal", "greater_or_equal": "greater_equal",
        "notequal": "not_equal",
        "dest": "dst", "inv_src": "one_minus_src", "inv_dest": "one_minus_dst",
        "inv_src_alpha": "one_minus_src_alpha", "dest_alpha": "dst_alpha",
        "inv_dest_alpha": "one_minus_dst_alpha", "src_alpha_sat": "src_alpha_saturated",
        "src_alpha_saturate": "src_alpha_saturated", "blend_factor": "constant",
        "inv_blend_factor": "one_minus_constant", "rev_subtract": "reverse_subtract",
        "incr": "increment_clamp", "incr_sat": "increment_clamp", "incr_wrap": "increment_wrap",
        "decr": "decrement_clamp", "decr_sat": "decrement_clamp", "decr_wrap": "decrement_wrap",
        "increment_and_clamp": "increment_clamp", "increment_and_wrap": "increment_wrap",
        "decrement_and_clamp": "decrement_clamp", "decrement_and_wrap": "decrement_wrap",
        "ccw": "counter_clockwise", "cw": "clockwise",
        "line": "lines", "wireframe": "lines", "fill": "faces", "solid": "faces",
        "clamp_to_edge": "clamp", "mirrored_repeat": "mirror", "wrap": "repeat",
        "clamp_to_border": "border", "border_color": "border", "bordercolor": "border",
        "address_u": "wrap_u", "address_v": "wrap_v", "address_w": "wrap_w",
        "address_mode_u": "wrap_u", "address_mode_v": "wrap_v", "address_mode_w": "wrap_w",
        "addressmodeu": "wrap_u", "addressmodev": "wrap_v", "addressmodew": "wrap_w",
        "texture_wrap_s": "wrap_u", "texture_wrap_t": "wrap_v", "texture_wrap_r": "wrap_w",
        "wrap_s": "wrap_u", "wrap_t": "wrap_v", "wrap_r": "wrap_w",
        "max_anisotropy": "anisotropy", "maxanisotropy": "anisotropy", "aniso": "anisotropy",
        "texture_max_anisotropy": "anisotropy", "texture_max_anisotropy_ext": "anisotropy",
        "point": "nearest",
        "msaa": "samples", "multisample": "samples", "sample_count": "samples",
        "alphatocoverage": "alpha_to_coverage", "alphatocoverageenable": "alpha_to_coverage",
        "alphatocoverageenabled": "alpha_to_coverage", "alphatomask": "alpha_to_coverage",
        "alpha_to_coverage_enable": "alpha_to_coverage",
        "sample_alpha_to_coverage": "alpha_to_coverage",
        "cull_mode": "cull", "cullmode": "cull", "front_face": "front", "frontface": "front",
        "polygon_mode": "fill", "fill_mode": "fill",
        "fragdepth": "value", "frag_depth": "value", "sv_depth": "value",
        "depth_write": "write", "depthwriteenabled": "write", "depthcompare": "compare",
        "depthbias": "bias", "depthbiasslopescale": "slope_bias", "depthbiasclamp": "bias_clamp",
        "zfail": "depth_fail", "depthfailop": "depth_fail", "failop": "fail", "zpass": "pass",
        "passop": "pass",
    }
)  # fmt: skip
"""The words here, by those elsewhere without prefix and suffix, in small letters."""


def word_here(name: str) -> str:
    """The word here for such a name: ``GL_LEQUAL`` and ``less-equal`` are ``less_equal``.

    A word of which nothing is known stays as it is, in small letters.
    """
    whole = name.lower().replace("-", "_")
    if turning := _OF_DIRECT3D.match(whole):
        return f"{turning[1]}crement_wrap"
    word = _PREFIX.sub("", whole, count=1) if _PREFIX.match(whole) else whole
    word = _WORDS.get(word, word)
    plain = _SUFFIX.sub("", word)
    return _WORDS.get(plain, plain)
