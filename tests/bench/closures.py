"""Closures in closures: documents as converters make them of MaterialX's surface models."""

from __future__ import annotations

from pathlib import Path

LAYERED = Path(__file__).parent / "layered.burnish"
"""A surface of ten closures, each asked in three ways."""

_TOPS = (
    "dielectric_bsdf(asked, l, w, vec3(coat_color), coat_ior, coat_alpha, normal, across)",
    "sheen_bsdf(asked, l, w * fuzz_weight, vec3(fuzz_color), fuzz_roughness, normal)",
    "schlick_bsdf(asked, l, w, vec3(base_color), vec3(specular_color), main_alpha, normal, across)",
    "translucent_bsdf(asked, l, w, vec3(subsurface_color), normal)",
)
_HEAD = "(asked: int, l: vec3, w: float) -> Bsdf ="


def layers(count: int) -> str:
    """A surface of ``count`` layers, each of which is a term that puts a closure on the one below.

    It has the closures and the parameters of ``LAYERED``.
    """
    text = LAYERED.read_text(encoding="utf-8")
    text = text.replace("color = lit()", "color = seen() + reflected() + lit()")
    below = "diffuse_bsdf(asked, l, w, vec3(base_color), base_roughness, normal)"
    terms = [f"term layer0{_HEAD} {below}"]
    for number in range(1, count):
        top, base = _TOPS[number % len(_TOPS)], f"layer{number - 1}(asked, l, 0.5 * w)"
        terms.append(f"term layer{number}{_HEAD} over({top}, {base})")
    last = f"layer{count - 1}"
    terms += [
        f"term seen() per light = rgb({last}(0, light.to_light, coat_weight).response)",
        f"term reflected() = rgb({last}(1, normal, coat_weight).response)",
    ]
    return text + "\n".join(terms) + "\n"
