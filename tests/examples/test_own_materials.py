"""Materials as people write them: odd ones that have to work, and the usual mistakes."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from burnish.targets.toolchain import Toolchain

from ..suite.verdicts import refused
from ..targets.standings import PROFILES
from .test_accepted import jobs

WORKING = {
    "a choice between whole numbers is a float": """
        material M { on : float = if uv.x > 0.5 then 1 else 0  color = vec3(on) }
    """,
    "a single number crosses": """
        material M { attribute id : int  color = vec3(float(id)) }
    """,
    "a coordinate that is guarded": """
        import std.lights.{Directional}
        import std.terms.{lambert}
        light Shadowed : Directional {
            map   depth    : texture2d with { filter = nearest }
            param to_light_space : transform<world, light> = mat4(1)
            seen    = to_light_space * vec4(position, 1)
            falloff = if depth(seen.xy / seen.w).r < seen.z / seen.w then 0 else 1
        }
        rig R { sun : Shadowed }
        material M { color = lambert(vec3(1)) }
    """,
    "reads on both sides of a choice": """
        material M {
            map a : texture2d
            map b : texture2d
            color = if a(uv).r > 0.5 then sqrt(b(uv * 2).rgb) else exp(b(uv * 3).rgb)
        }
    """,
    "names that are words elsewhere": """
        material input {
            param texture : rgb = #fff
            param sample : float = 1
            param matrix : mat3 = mat3(1)
            param gl_x : float = 1
            param a__b : float = 2
            map sampler : texture2d
            out = matrix * texture * sample * gl_x / a__b
            color = out * sampler(uv).rgb
        }
    """,
    "every operation that needs a guard": """
        material M {
            color = vec3(sqrt(uv.x - 0.5), log(uv.y), atan2(uv.x, uv.y))
                    + vec3(acos(uv.x * 2), uv.x mod uv.y, uv.x / uv.y)
        }
    """,
    "a side of a surface": """
        import std.terms.{lambert}
        material M {
            front = dot(to_eye, normal) > 0
            color = if front then lambert(#f00) else (lambert(#00f) with { normal = -normal })
        }
    """,
}


@pytest.mark.parametrize("text", WORKING.values(), ids=WORKING.keys())
def test_works(text: str, toolchain: Toolchain) -> None:
    result = burnish.compile(text, PROFILES)
    found = [each.report() for each in refused(list(jobs(result)), toolchain)]
    assert not found, "\n".join(found)


MISTAKES = {
    "material M { color = light.diffuse }": "B0601",
    "material M { color = vec3(sum i in 0..4 : uv.x * i) }": "B0305",
    "rig R { sun : M }\nmaterial M { color = vec3(1) }": "B0602",
    "import std.lights.{Spott}\nmaterial M { color = vec3(1) }": "B0012",
    "material M { map t : texture2d  color = @vertex t(uv).rgb }": "B0502",
    "material M { color = normalise(vec3(1)) }": "B0201",
    "material M { color = uv.z }": "B0304",
    "import std.terms.{lambert}\nmaterial M { color = lambert(uv) }": "B0301",
    "rig R { lamps : Nowhere[2] }\nimport std.terms.{lambert}\n"
    "material M { color = lambert(vec3(1)) }": "B0201",
}


@pytest.mark.parametrize(("text", "code"), MISTAKES.items(), ids=MISTAKES.values())
def test_mistake_is_told_once(text: str, code: str) -> None:
    assert [found.rule.code for found in burnish.check(text)] == [code]


def many_textures(count: int) -> str:
    """A material that reads so many textures."""
    maps = "\n".join(f"map t{i} : texture2d" for i in range(count))
    reads = " + ".join(f"t{i}(uv).rgb" for i in range(count))
    return f"material M {{ {maps}\ncolor = {reads} }}"


@pytest.mark.parametrize(
    ("count", "target", "message", "hint"),
    [
        (17, "glsl:es300", "17 textures of M, but glsl:es300 has only 16",
         "`GL_MAX_TEXTURE_IMAGE_UNITS` is 16 on some devices: have pictures of the same size in "
         "the layers of one `texture2d_array`, or put several beside each other in one "
         "`texture2d`, or compile for glsl:vulkan, hlsl:sm6 or wgsl:webgpu"),
        (49, "wgsl", "49 textures of M, but wgsl:webgpu has only 48",
         "`maxSampledTexturesPerShaderStage` is 48 on some devices: have pictures of the same "
         "size in the layers of one `texture2d_array`, or put several beside each other in one "
         "`texture2d`, or compile for glsl:vulkan or hlsl:sm6"),
    ],
)  # fmt: skip
def test_limits_of_devices_are_kept(count: int, target: str, message: str, hint: str) -> None:
    with pytest.raises(burnish.CompileError) as caught:
        burnish.compile(many_textures(count), (target,))
    (found,) = caught.value.diagnostics
    assert (found.message, found.hint) == (message, hint)


def test_what_devices_have_to_be_asked_for_is_told() -> None:
    made = burnish.compile(many_textures(17), ("glsl:vulkan", "hlsl", "wgsl"))
    assert [found.message for found in made.diagnostics] == [
        f"17 textures of M, and not every device of {target} has more than 16"
        for target in ("glsl:vulkan", "wgsl:webgpu")
    ]
    backends = made["M"].reflection.backends
    assert {name: row.required_limits for name, row in backends.items()} == {
        "glsl:vulkan": {"maxPerStageDescriptorSampledImages": 17},
        "hlsl:sm6": {},
        "wgsl:webgpu": {"maxSampledTexturesPerShaderStage": 17},
    }


def test_two_files_with_the_same_name(tmp_path: Path) -> None:
    (tmp_path / "own.burnish").write_text("light Point { to_light = vec3(0, 1, 0) }\n")
    main = tmp_path / "main.burnish"
    use = "rig R { lamp : Point }\nmaterial M { color = vec3(1) }\n"
    both = 'import std.lights\nimport "own.burnish"\n'
    main.write_text(both + use)
    assert [found.rule.code for found in burnish.check(main)] == ["B0207"]
    main.write_text(both + "import std.lights.{Point}\n" + use)
    assert not burnish.check(main)
