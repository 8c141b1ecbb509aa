"""Bindings of small programs: what examples lack, in every language."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from types import ModuleType

import pytest

import burnish

from ..golden import assert_golden
from .kit import EXAMPLES, difference

GOLDEN = Path(__file__).parent / "golden"
PLASTIC = EXAMPLES / "plastic.burnish"

ODD = """
material Odd : Surface {
    param lambda : float in 0..1 = 0.5
    param double : vec3 = (1, 2, 3)
    param aB : float = 1
    param a_b : float = 2
    param weights : float[5]
    param class : bool = true

    color = rgb(lambda + double.x + aB, a_b + weights[3], choose(class)) * total
    total = sum(i in 0..<5) weights[i] * weights[i] / (aB + a_b)
}
"""


def _module(text: str) -> ModuleType:
    module = ModuleType("a_binding")
    exec(compile(text, "a_binding.py", "exec"), module.__dict__)
    return module


@pytest.mark.parametrize(("language", "ending"), [("python", "py"), ("cpp", "hpp")])
def test_plastic(language: str, ending: str) -> None:
    text = burnish.bind(PLASTIC, language, ("wgsl", "glsl"))
    assert_golden(text, GOLDEN / f"plastic.{ending}")
