"""Errors to plant: changes of emitted texts, and of what a program hands to a driver.

Texts have the small changes of ``tests/mutants/texts.py``, and the slips of this module: what
people who write or port shaders get wrong. Hosts have errors with textures, samplers, vertices and
blocks. None of them was chosen by what finds it.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from burnish.targets.runner.drivers.checks import level_size
from burnish.targets.runner.drivers.draws import Draw
from burnish.targets.runner.drivers.frame_job import FrameJob
from burnish.targets.runner.drivers.pipeline import Pipeline
from burnish.targets.runner.drivers.texels import TEXELS, Image, TextureFormat

from ..conformance.kit import redrawn
from ..mutants.texts import KINDS, Kind

# --- slips in texts ------------------------------------------------------------------------------

_GLSL = r"\btexture\((?P<map>\w+|sampler\w+\(\w+, \w+\)), (?P<at>[^()]+)\)"
_HLSL = r"\b(?P<map>\w+)\.Sample\((?P<sampler>\w+), (?P<at>[^()]+)\)"
_WGSL = r"\btextureSample\((?P<map>\w+), (?P<sampler>\w+), (?P<at>[^()]+)\)"
READS = {_GLSL: "vec4(2.2)", _HLSL: "2.2", _WGSL: "vec4f(2.2)"}
"""A filtered read of a texture in each language, and the exponent that decodes its result."""


def _digits(found: re.Match[str]) -> str:
    return repr(float(f"{float(found[0]):.3g}"))


def _one_less(found: re.Match[str]) -> str:
    return f"{found[1]}{float(found[2]) - 1}{found[3]}"


def _half_a_texel(found: re.Match[str]) -> str:
    return found[0].replace(found["at"], f"{found['at']} + 0.015625")


def _next_level(found: re.Match[str]) -> str:
    if "Sample(" not in found[0]:
        return f"{found[0][:-1]}, 1.0)"
    return f"{found[0][:-1].replace('Sample(', 'SampleBias(')}, 1.0)"


def _decoded_again(exponent: str) -> Callable[[re.Match[str]], str]:
    return lambda found: f"pow({found[0]}, {exponent})"


_ROOT = r" \* (?:inversesqrt|inverseSqrt|rsqrt)\(max\(dot\([^()]*\), [^()]*\)\)"
"""The factor that gives a vector length one."""
_TERM = r" \+ [\w.]+(?:\[\w+\])?(?:\.\w+)?(?=[;,)])"

SLIPS: Sequence[Kind] = (
    ("constant of three digits", r"(?<![\w.])\d+\.\d{4,}(?![\w.e])", _digits),
    ("not normalised", r"\bnormalize(?=\()", lambda _found: ""),
    ("not normalised", _ROOT, lambda _found: ""),
    ("term left out", _TERM, lambda _found: ""),
    ("sum overwritten", r" \+= ", lambda _found: " = "),
    ("loop one short", r"(; \w+ < )([^;]+)(; \w+\+\+)",
     lambda found: f"{found[1]}{found[2]} - 1{found[3]}"),
    ("loop from one", r"(for \((?:var |int )\w+(?:: i32)? = )0(?=;)", lambda found: f"{found[1]}1"),
    ("cross product turned", r"\bcross\(([^(),]+), ([^(),]+)\)",
     lambda found: f"cross({found[2]}, {found[1]})"),
    ("other exponent", r"(\bpow\([^(),]+, )(\d+\.\d+)(\))", _one_less),
    ("1 % too bright", r"((?:out_color = |return )(?:float4|vec4f?)\()(\w+)(, 1\.0\);)",
     lambda found: f"{found[1]}{found[2]} * 1.01{found[3]}"),
    *(("texture half a texel aside", read, _half_a_texel) for read in READS),
    *(("texture a level too coarse", read, _next_level) for read in READS),
    *(("sRGB decoded twice", read, _decoded_again(power)) for read, power in READS.items()),
)  # fmt: skip
"""What people get wrong in shaders."""

TEXT_ERRORS: Sequence[Kind] = (*KINDS, *SLIPS)

# --- errors of hosts -----------------------------------------------------------------------------

Change = Callable[[FrameJob], FrameJob]


@dataclass(frozen=True, slots=True)
class HostError:
    """An error in what a driver is told."""

    name: str
    change: Change


def _samplers(**state: Any) -> Change:
    return _pipelines(
        lambda made: replace(made, textures=tuple(replace(slot, **state) for slot in made.textures))
    )


def _pipelines(change: Callable[[Pipeline], Pipeline]) -> Change:
    return lambda job: replace(job, pipelines=tuple(map(change, job.pipelines)))


def _draws(change: Callable[[Draw], Draw]) -> Change:
    return lambda job: redrawn(job, change)


def _images(change: Callable[[Image], Image]) -> Change:
    return _draws(lambda draw: replace(draw, textures=tuple(map(change, draw.textures))))


def _levels(change: Callable[[np.ndarray[Any, Any]], np.ndarray[Any, Any]]) -> Change:
    """Change the texels of every level, of shape (depth, height, width, lanes)."""

    def changed(image: Image) -> Image:
        texel = TEXELS[image.format]
        levels = []
        for number, level in enumerate(image.levels):
            width, height, depth = level_size(image, number)
            texels = np.frombuffer(level, texel.kind).reshape(depth, height, width, texel.lanes)
            levels.append(np.ascontiguousarray(change(texels)).tobytes())
        return replace(image, levels=tuple(levels))

    return _images(changed)


def _in_16_bits(texels: np.ndarray[Any, Any]) -> np.ndarray[Any, Any]:
    """The texels with five bits of each lane, as formats of 16 bits keep them."""
    if texels.dtype != np.uint8:
        return texels
    return (np.rint(texels / 255 * 31) / 31 * 255 + 0.5).astype(np.uint8)


_OTHER_CURVE: Mapping[TextureFormat, TextureFormat] = {
    "rgba8unorm": "rgba8unorm-srgb", "rgba8unorm-srgb": "rgba8unorm",
}  # fmt: skip


def _in_halves(data: bytes) -> bytes:
    """Floats that were kept in 16 bits; what does not fit, such as a count, stays."""
    floats = np.frombuffer(data, "<f4")
    fits = (np.abs(floats) > 1e-4) & (np.abs(floats) < 6e4)
    halves = np.where(fits, floats, 0).astype("<f2").astype("<f4")
    return np.where(fits, halves, floats).astype("<f4").tobytes()


def _vertices_in_halves(job: FrameJob) -> FrameJob:
    floats = [
        tuple(vertex.format.startswith("float32") for vertex in made.inputs)
        for made in job.pipelines
    ]
    if not all(map(all, floats)):
        return job
    return redrawn(
        job, lambda draw: replace(draw, vertices=tuple(map(_in_halves, draw.vertices)))
    )  # fmt: skip


def _other_curve(image: Image) -> Image:
    return replace(image, format=_OTHER_CURVE.get(image.format, image.format))


def _levels_off(image: Image) -> Image:
    """Each level holds what the next one should."""
    if image.dimension != "2d" or len(image.levels) < 2:
        return image
    texel = TEXELS[image.format]
    levels = []
    for number, level in enumerate(image.levels[1:], start=1):
        width, height, _ = level_size(image, number)
        texels = np.frombuffer(level, texel.kind).reshape(height, width, texel.lanes)
        above, across, _ = level_size(image, number - 1)
        rows, columns = np.arange(across) * height // across, np.arange(above) * width // above
        levels.append(texels[rows[:, None], columns[None]].tobytes())
    return replace(image, levels=(*levels, image.levels[-1]))


HOST_ERRORS: Sequence[HostError] = (
    HostError("all textures repeat", _samplers(wrap="repeat")),
    HostError("all textures mirror", _samplers(wrap="mirror")),
    HostError("all textures end at their edges", _samplers(wrap="clamp")),
    HostError("single texels", _samplers(filter="nearest")),
    HostError("single levels", _samplers(mip="nearest")),
    HostError("only the first level", _samplers(mip="none")),
    HostError("textures exchanged", _draws(lambda d: replace(d, textures=d.textures[::-1]))),
    HostError("rows from below", _levels(lambda texels: texels[:, ::-1])),
    HostError("red and blue exchanged", _levels(lambda texels: texels[..., [2, 1, 0, 3]]
              if texels.shape[-1] == 4 else texels)),
    HostError("textures a texel aside", _levels(lambda texels: np.roll(texels, 1, axis=2))),
    HostError("textures a level off", _images(_levels_off)),
    HostError("the other curve of colours", _images(_other_curve)),
    HostError("texels of 16 bits", _levels(_in_16_bits)),
    HostError("vertices as half floats", _vertices_in_halves),
    HostError("values as half floats",
              _draws(lambda draw: replace(draw, blocks=tuple(map(_in_halves, draw.blocks))))),
    HostError("clockwise fronts", _pipelines(lambda made: replace(made, front_face="cw"))),
)  # fmt: skip
"""What hosts get wrong."""
