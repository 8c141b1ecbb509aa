"""Bindings of small programs: what examples lack, in every language."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

import burnish
from burnish.bindings import registry

from ..golden import assert_golden
from .kit import EXAMPLES, difference

GOLDEN = Path(__file__).parent / "golden"
PLASTIC = EXAMPLES / "plastic.burnish"


@cache
def _module(source: str | Path) -> Any:
    module = ModuleType("a_binding")
    text = burnish.bind(source, "python", "wgsl")
    exec(compile(text, "a_binding.py", "exec"), module.__dict__)
    return module


@pytest.mark.parametrize("language", registry.names())
def test_plastic(language: str) -> None:
    ending = registry.load(language).extension
    text = burnish.bind(PLASTIC, language, ("wgsl", "glsl"))
    assert_golden(text, GOLDEN / f"plastic.{ending}")


REFUSED = {
    "power": (600.0, "`power` is declared in 1..512: 600.0 is not"),
    "base": ((1.0, 2.0), "`base` takes 3 numbers: (1.0, 2.0) is not"),
    "shine": ((1.0, float("nan"), 0.0), "`shine` takes finite numbers: (1.0, nan, 0.0) is not"),
}


@pytest.mark.parametrize(("name", "value", "told"), [(k, *v) for k, v in REFUSED.items()])
def test_values_that_break_a_promise_are_refused(name: str, value: object, told: str) -> None:
    block = _module(PLASTIC).PlasticMaterial()
    before = bytes(block)
    with pytest.raises(ValueError) as error:  # noqa: PT011
        setattr(block, name, value)
    assert str(error.value) == told
    assert bytes(block) == before


def test_lengths_counts_and_names_are_checked() -> None:
    module = _module(PLASTIC)
    rig = module.Rig()
    with pytest.raises(ValueError, match=r"^`torch_axis` has to be of length 1, not 2$"):
        rig.torch_axis = (0.0, 2.0, 0.0)
    with pytest.raises(ValueError, match=r"^`lamps` takes at most 8 elements, not 9$"):
        rig.lamps = [module.Point()] * 9
    with pytest.raises(AttributeError, match=r"^Rig has no field `lamp`$"):
        module.Rig(lamp=1)
    assert bytes(rig) == bytes(module.Rig())


def test_a_stale_binding_is_told() -> None:
    module = _module(PLASTIC)
    (material,) = burnish.compile(PLASTIC, "wgsl")
    reflection = burnish.to_json(material.reflection)
    module.PLASTIC.check(reflection)
    (rig,) = [row for row in reflection["blocks"] if row["name"] == "Rig"]
    rig["layout_id"] = "0"
    with pytest.raises(ValueError) as error:  # noqa: PT011
        module.PLASTIC.check(reflection)
    assert str(error.value) == (
        "the binding of Plastic is stale: `Rig` has another layout; run `burnish bind` again"
    )


NAMES = """
material Odd : Surface {
    param lambda : float in 0..1 = 0.5
    param aB     : float = 1
    param a_b    : float = 2
    param int32_t : float = 3
    param number : float[5]
    color = rgb(lambda + aB, a_b, int32_t + number[3])
}
"""


def test_names_that_a_language_has_itself_or_that_become_equal() -> None:
    block = _module(NAMES).OddMaterial(lambda_=0.25, a_b=5.0, a_b_2=6.0, number=[1, 2, 3, 4, 5])
    assert (block.lambda_, block.a_b, block.a_b_2) == (0.25, 5.0, 6.0)
    assert tuple(block.number) == (1, 2, 3, 4, 5)
    assert "float a_b_2 = 2.0f;" in burnish.bind(NAMES, "cpp", "wgsl")


FOLDED = """
material Folded : Surface {
    param weights : float[6]
    param count   : int in 0..6 = 4
    param power   : vec3 = vec3(1, 2, 3)
    total = sum i in 0..count up to 6 : weights[i] * pow(power, float(i) / 2)
    most  = product i in 0..6 : 1 + weights[i] / total.x
    color = vec3(most) + total
}
"""


def test_folds_are_loops() -> None:
    module = _module(FOLDED)
    (material,) = burnish.compile(FOLDED, "wgsl")
    assert any(step.op == "fold" for row in material.reflection.derived for step in row.steps)
    for count in (0, 3, 6):
        values = {"weights": (1.5, -2.0, 0.25, 3.0, 8.0, -0.5), "count": count, "power": (2, -1, 3)}
        instance = material.instance()
        for name, value in values.items():
            instance.set(name, value)
        block = module.FoldedMaterial(**values)
        found = bytes(module.derive_folded_material(block))
        assert not difference(instance.blocks()["MaterialDerived"], found)
    assert "for (std::int64_t" in burnish.bind(FOLDED, "cpp", "wgsl")


def test_texts_are_embedded() -> None:
    text = burnish.bind(PLASTIC, "python", "wgsl", embed=True)
    module: Any = ModuleType("a_binding")
    exec(compile(text, "a_binding.py", "exec"), module.__dict__)
    (material,) = burnish.compile(PLASTIC, "wgsl")
    found = {each.file: each.text for each in module.PLASTIC.profiles["wgsl:webgpu"].texts}
    assert found == {file.name: file.text for file in material.files}


def test_blocks_that_are_alike_are_there_once() -> None:
    text = burnish.bind([PLASTIC, EXAMPLES / "phong.burnish"], "python", "wgsl")
    assert text.count("class View(Block)") == 1
    assert "class PlasticMaterial(Block)" in text and "class BilliardMaterial(Block)" in text


@pytest.mark.parametrize(
    ("language", "namespace", "told"),
    [
        ("perl", "", "no language of hosts is called `perl`: there are "),
        ("python", "scene", "Python has no namespaces: a binding is a file of its own"),
        ("cpp", "1::a", "`1::a` is no namespace, which would be like `scene` or `scene::glass`"),
    ],
)
def test_what_there_is_not_is_told(language: str, namespace: str, told: str) -> None:
    with pytest.raises(ValueError) as error:  # noqa: PT011
        burnish.bind(PLASTIC, language, "wgsl", namespace=namespace)
    assert str(error.value).startswith(told)
