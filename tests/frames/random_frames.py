"""Random frames of small passes and kernels that read, draw over and remember what others leave."""

from __future__ import annotations

import random

HEAD = """
import std.frames.{FullScreen}
pass Filled : FullScreen blend add {
    param k : float = 1
    target value : rgba16f = vec4(uv * k, 0, 1)
}
pass Small : FullScreen { target value : rgba8 = vec4(uv, 0, 1) }
pass Read : FullScreen {
    map source : texture2d with { filter = nearest, mip = none }
    target value : rgba16f = source.load(ivec2(frag_coord.xy)) + 1
}
pass Two : FullScreen {
    map source : texture2d with { filter = nearest, mip = none }
    map other  : texture2d with { filter = nearest, mip = none }
    target value : rgba16f = source.load(ivec2(frag_coord.xy)) + other.load(ivec2(frag_coord.xy))
}
kernel Doubled {
    map source : texture2d
    result value : image2d<rgba16f>[source.size()] = 2 * source.load(texel)
}
kernel Listed {
    map source : texture2d
    size = source.size()
    result list : vec4[256] = sin(source.load(ivec2(index mod size.x, index / size.x mod size.y)))
}
pass Unlisted : FullScreen {
    buffer list : vec4[]
    here = int(frag_coord.x) + 8 * int(frag_coord.y)
    target value : rgba16f = list[here] + list[int(4 * list[here].x)]
}
"""
MOST_STEPS = 9
BY_BUFFERS = 0.15
"""The probability that a step reads a buffer, which a kernel writes for it."""


def random_frame(seed: int) -> str:
    """A frame; not all that come of this can be drawn, such as one over another format."""
    chance = random.Random(seed)
    names: list[str] = []
    lines: list[str] = []
    for number in range(chance.randint(2, MOST_STEPS)):
        name = f"s{number}"
        if names and chance.random() < BY_BUFFERS:
            lines += _by_buffer(chance, names, name)
        else:
            lines.append(f"    {name} = {_step(chance, names, name)}")
        names.append(name)
    shown = chance.sample(names, min(len(names), chance.randint(1, 2)))
    lines += [f"    output o{number} = {name}.value" for number, name in enumerate(shown)]
    return f"{HEAD}frame F {{\n" + "\n".join(lines) + "\n}\n"


def _by_buffer(chance: random.Random, names: list[str], name: str) -> list[str]:
    """A kernel that lists a texture, and a pass that shows this list or that of the last frame."""
    lines = [f"    list_{name} = Listed() with {{ source = {_source(chance, names, name)} }}"]
    read = f"list_{name}.list"
    if chance.random() < 0.4:
        lines.append(
            f"    first_{name} = Listed() with {{ source = {chance.choice(names)}.value }}"
        )
        read = f"previous({read}, first_{name}.list)"
    return [*lines, f"    {name} = Unlisted(screen) with {{ list = {read} }}"]


def _step(chance: random.Random, names: list[str], name: str) -> str:
    beginnings = ("Filled(screen)", "Small(screen)", "Filled(screen, 8)",
                  "Filled(screen, 8) with { k = 2 }")  # fmt: skip
    if not names or chance.random() < 0.2:
        return chance.choice(beginnings)
    one, other = (_source(chance, names, name) for _ in range(2))
    over = chance.choice(names)
    return chance.choice((
        f"Filled(screen, {over})",
        f"Read(screen) with {{ source = {one} }}",
        f"Read(screen, {over}) with {{ source = {one} }}",
        f"Two(screen) with {{ source = {one}, other = {other} }}",
        f"Doubled() with {{ source = {one} }}",
    ))  # fmt: skip


def _source(chance: random.Random, names: list[str], name: str) -> str:
    if chance.random() < 0.75:
        return f"{chance.choice(names)}.value"
    initially = f", {chance.choice(names)}.value" if chance.random() < 0.6 else ""
    return f"previous({chance.choice([*names, name])}.value{initially})"
