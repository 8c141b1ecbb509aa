"""The comparison of graphs allows what rounding may do, also where a value jumps."""

from __future__ import annotations

import pytest

from .agreement import disagreements
from .kit import World, shader


@pytest.mark.parametrize("jump", ["ceil", "floor", "sign"])
def test_an_expansion_may_lose_what_is_tiny_before_a_jump(jump: str) -> None:
    text = f"material M {{ color = {jump}(asinh(vec3(vertex_normal))) }}"
    worlds = [World(seed, traps=True) for seed in range(3)]
    assert not disagreements(shader(text), worlds)
