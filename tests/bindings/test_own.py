"""Bindings of small programs: what examples lack, in every language."""

from __future__ import annotations

import itertools
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

import burnish
from burnish.bindings import registry
from burnish.bindings.gathering import Compiled, gathered
from burnish.bindings.writing import written
from burnish.compiler.documents.steps import (
    BoundStep,
    CallStep,
    ConstantStep,
    FoldStep,
    ParameterStep,
)
from burnish.support.frozen import changed

from ..golden import assert_golden
from .kit import ELSEWHERE, EXAMPLES, PLASTIC, UNFIT_BY_NAME, difference, reflections

GOLDEN = Path(__file__).parent / "golden"


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
    assert_golden(text, GOLDEN / f"plastic.{ending}.txt")


REFUSED = {
    "power": (600.0, "`power` is declared in 1..512: 600.0 is not"),
    "base": ((1.0, 2.0), "`base` takes 3 numbers: (1.0, 2.0) is not"),
    "shine": ((1.0, float("nan"), 0.0), "`shine` takes finite numbers: (1.0, nan, 0.0) is not"),
}


@pytest.mark.parametrize(("name", "value", "told"), [(k, *v) for k, v in REFUSED.items()])
def test_values_that_break_a_promise_are_refused(name: str, value: object, told: str) -> None:
    block = _module(PLASTIC).PlasticMaterial()
    before = bytes(block)
    with pytest.raises(ValueError) as error:
        setattr(block, name, value)
    assert str(error.value) == told
    assert bytes(block) == before


def test_lengths_counts_and_names_are_checked() -> None:
    module = _module(PLASTIC)
    rig = module.StudioRig()
    with pytest.raises(ValueError, match=r"^`torch_axis` has to be of length 1, not 2$"):
        rig.torch_axis = (0.0, 2.0, 0.0)
    with pytest.raises(ValueError, match=r"^`lamps` takes at most 8 elements, not 9$"):
        rig.lamps = [module.Point()] * 9
    with pytest.raises(TypeError, match=r"unexpected keyword argument 'lamp'"):
        module.StudioRig(lamp=1)
    with pytest.raises(AttributeError, match=r"^'StudioRig' object has no attribute 'lamp'"):
        rig.lamp = 1
    assert bytes(rig) == bytes(module.StudioRig())


def test_a_stale_binding_is_told() -> None:
    material = _module(PLASTIC).PLASTIC
    fits, *others = reflections()
    material.check(fits)
    told = []
    for reflection in others:
        with pytest.raises(ValueError) as error:
            material.check(reflection)
        told.append(str(error.value))
    stale = "the binding of Plastic is stale: "
    assert told == [
        f"{stale}`Rig` has another layout; run `burnish bind` again",
        f"{stale}it lacks `Fog`; run `burnish bind` again",
        *[f"{stale}for `wgsl:webgpu`, {ELSEWHERE}"] * 2,
        *UNFIT_BY_NAME,
    ]


@pytest.mark.parametrize("members", ["fresh, mouldy", "worn, fresh"])
@pytest.mark.parametrize("type_", ["Wear", "Spot[2]"])
def test_a_binding_is_stale_when_numbers_have_other_names(members: str, type_: str) -> None:
    text = """
        enum Wear { fresh, worn }
        struct Spot { wear : Wear  size : float }
        material Wall {
            param first : TYPE
            color = first.is_it * vec3(1)
        }
    """
    value = "first" if type_ == "Wear" else "first[1].wear"
    text = text.replace("TYPE", type_).replace(
        "first.is_it", f"if {value} == Wear.fresh then 1.0 else 0.0"
    )
    material = _module(text).WALL
    (same,) = burnish.compile(text, "wgsl")
    material.check(burnish.to_json(same.reflection))
    (now,) = burnish.compile(text.replace("fresh, worn", members), "wgsl")
    with pytest.raises(ValueError, match="stale: `Material` has another layout"):
        material.check(burnish.to_json(now.reflection))


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


FOLD = (
    ParameterStep(op="parameter", type="int", args=(), parameter="lamps.count"),
    ConstantStep(op="constant", type="vec3", args=(), value=(0.5, 1.0, -2.0)),
    ParameterStep(op="parameter", type="vec3", args=(), parameter="torch.place"),
    BoundStep(op="bound", type="int", args=(), binder=0),
    CallStep(op="native", type="float", args=(3,), function="to_float"),
    CallStep(op="native", type="vec3", args=(2, 4), function="mul"),
    FoldStep(op="fold", type="vec3", args=(0, 1, 5), operator="add", bound=6),
    CallStep(op="native", type="float", args=(6, 2), function="dot"),
)
"""A sum over as many terms as lamps shine, but 6 at most; a loop in every language."""


def test_folds_are_loops() -> None:
    (material,) = burnish.compile(PLASTIC, "wgsl")
    row, *others = material.reflection.derived
    reflection = changed(material.reflection, derived=(changed(row, steps=FOLD), *others))
    binding = gathered([Compiled(reflection=reflection, texts={})], (), (), "folds")
    module: Any = ModuleType("a_binding")
    exec(compile(written(binding, registry.load("python")), "a.py", "exec"), module.__dict__)
    for count in (0, 3, 8):
        instance = burnish.Instance(reflection)
        instance.set("lamps.count", count)
        instance.set("lamps", [{"place": (0.0, 0.0, 0.0)}] * count)
        instance.set("torch.place", (2.0, -1.0, 3.5))
        block = module.StudioRig(lamps_count=count, torch_place=(2.0, -1.0, 3.5))
        found = bytes(module.derive_studio_rig(block))
        assert not difference(instance.blocks()["DerivedFromRig"], found)


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
    with pytest.raises(ValueError) as error:
        burnish.bind(PLASTIC, language, "wgsl", namespace=namespace)
    assert str(error.value).startswith(told)


def test_images_of_kernels_are_bound_as_storage_textures() -> None:
    module = _module(EXAMPLES / "bilateral.burnish")
    entries = [each for group in module.bind_group_layouts(module.BILATERAL) for each in group]
    images = [each["storage_texture"] for each in entries if "storage_texture" in each]
    (image,) = (each for each in module.BILATERAL.targets)
    assert images == [{"access": "write-only", "format": image["format"]}]


def test_a_block_shows_what_differs_from_its_defaults() -> None:
    module = _module(PLASTIC)
    assert repr(module.StudioRig()) == "StudioRig()"
    rig = module.StudioRig(torch_place=(0.0, 1.5, 2.0), lamps=[module.Point(place=(0.1, 0.0, 0.0))])
    assert repr(rig) == (
        "StudioRig(lamps=[Point(place=(0.1, 0, 0)), Point(), …], lamps_count=1, "
        "torch_place=(0, 1.5, 2))"
    )


def test_all_blocks_of_a_material() -> None:
    module = _module(PLASTIC)
    rig = module.StudioRig(torch_place=(0.0, 1.5, 2.0))
    blocks = module.PlasticBlocks(rig=rig)
    blocks.set_roles({"eye": (1.0, 2.0, 3.0), "morph": 1})
    assert blocks.view.eye == (1.0, 2.0, 3.0)
    found = {type(each).__name__: each for each in blocks.all()}
    assert found["StudioRig"] is rig
    assert bytes(found["StudioDerivedFromRig"]) == bytes(module.derive_studio_rig(rig))
    bound = {row.block for row in module.PLASTIC.profiles["wgsl:webgpu"].bound if row.block}
    assert bound <= {type(each) for each in blocks.all()}


def test_names_of_blocks_and_roles_are_checked() -> None:
    module = _module(PLASTIC)
    with pytest.raises(TypeError, match=r"unexpected keyword argument 'rigs'"):
        module.PlasticBlocks(rigs=module.StudioRig())
    blocks = module.PlasticBlocks()
    before = bytes(blocks.view)
    with pytest.raises(AttributeError, match=r"^'PlasticBlocks' object has no attribute 'rigs'"):
        blocks.rigs = module.StudioRig()
    with pytest.raises(ValueError, match=r"^no role is called `eyes`$"):
        blocks.set_roles({"eye": (1.0, 2.0, 3.0), "eyes": (1.0, 2.0, 3.0)})
    assert bytes(blocks.view) == before


def test_roles_of_lights_are_left_to_the_rig() -> None:
    module = _module(PLASTIC)
    blocks = module.PlasticBlocks()
    blocks.set_roles({"place": (1.0, 2.0, 3.0), "towards_object": (1.0, 0.0, 0.0)})
    assert bytes(blocks.rig) == bytes(module.StudioRig())


LAMPS = """
    import std.lights.{Point, Directional}
    import std.terms.{lambert, phong}
    rig Lamps { lamps : Point[<= 2] }
"""
ONE = "material One : Surface { color = lambert(#808080) }"
TWO = """
    material Two : Surface {
        param glow : rgb per draw = #101010
        color = lambert(#808080) + glow
    }
"""
THREE = """
    material Three : Surface {
        param glow : rgb per draw = #101010
        color = lambert(#404040) + 2 * glow
    }
"""


def test_materials_share_blocks_that_are_not_those_of_the_first() -> None:
    module = _module(LAMPS + ONE + TWO + THREE)
    draws = [
        {row.block for row in each.profiles["wgsl:webgpu"].bound if row.block}
        for each in module.MATERIALS
    ]
    assert module.TwoDraw in draws[1] & draws[2]
    assert module.Draw in draws[0]
    assert module.ThreeDraw is module.TwoDraw


def test_names_do_not_depend_on_what_else_is_bound() -> None:
    """What a host calls by a material's binding alone is there in each binding with it."""
    for texts in itertools.permutations((ONE, TWO, THREE)):
        module = _module(LAMPS + "".join(texts))
        for text in texts:
            alone = _module(LAMPS + text)
            for name, block in vars(alone).items():
                if hasattr(block, "LAYOUT_ID"):
                    assert getattr(module, name).LAYOUT_ID == block.LAYOUT_ID, name


def test_rigs_of_one_name_that_differ_have_the_names_of_their_materials(tmp_path: Path) -> None:
    (tmp_path / "one.burnish").write_text(LAMPS + ONE, "utf-8")
    (tmp_path / "two.burnish").write_text(LAMPS.replace("<= 2", "<= 3") + TWO, "utf-8")
    for names in (("one", "two"), ("two", "one")):
        files = [tmp_path / f"{name}.burnish" for name in names]
        module = ModuleType("bound")
        exec(burnish.bind(files, "python", "wgsl"), vars(module))
        assert module.OneRig.SIZE < module.TwoRig.SIZE
        assert not hasattr(module, "LampsRig")


def test_a_material_of_two_rigs_has_its_block_once() -> None:
    module = _module(
        LAMPS
        + "rig Sun { sun : Directional }"
        + "material Wall { param tint : rgb = #808080\n color = lambert(tint) }"
    )
    blocks = {name for name, each in vars(module).items() if isinstance(each, type)}
    assert {name for name in blocks if name.endswith("Material")} == {"Material", "WallMaterial"}
    assert {"LampsRig", "SunRig"} <= blocks


WEAR = """
enum Wear {
    fresh,  /// From the factory.
    worn
}
material Wall {
    param wear : Wear = Wear.worn
    param many : Wear[2]
    color = (if many[1] == wear then 1.0 else 0.5) * vec3(1)
}
"""


def test_enumerations_are_enumerations_of_the_host() -> None:
    module = _module(WEAR)
    block = module.WallMaterial(many=[module.Wear.WORN, 0])
    assert repr(block) == "WallMaterial(many=[Wear.WORN, Wear.FRESH])"
    assert block.wear is module.Wear.WORN
    with pytest.raises(ValueError, match="`wear` is one of 0 FRESH, 1 WORN: 2 is not"):
        block.wear = 2
    assert block.wear is module.Wear.WORN


@pytest.mark.parametrize("language", registry.names())
def test_comments_of_members_are_carried_over(language: str) -> None:
    assert "From the factory" in burnish.bind(WEAR, language, "wgsl")


def test_blocks_have_their_own_types_and_names() -> None:
    module = _module(PLASTIC)
    with pytest.raises(TypeError, match=r"^`rig` takes a StudioRig, not a Draw$"):
        module.PlasticBlocks(rig=module.Draw())
