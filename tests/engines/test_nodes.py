"""The functions for nodes of Unity and Unreal: DXC takes them. These engines have not seen them.

Unity's structures of a texture and its sampler are stubs here.
"""

from __future__ import annotations

from pathlib import Path

import pytest

from burnish.engines import known
from burnish.targets.toolchain import Job, Toolchain

from ..golden import assert_golden
from ..suite.verdicts import refused
from .files import EXAMPLES, files_of

GOLDEN = Path(__file__).parent / "golden"
STUBS = "".join(
    f"struct Unity{kind} {{ {kind}<float4> tex; SamplerState samplerstate; }};\n"
    for kind in ("Texture2D", "Texture2DArray", "Texture3D", "TextureCube")
)
ENTRY = "\nfloat4 main() : SV_Target {\n    return float4(0, 0, 0, 0);\n}\n"
NODES = {"plastic": "Plastic", "water": "Water", "texture_array": "Terrain", "fins": "Mole"}


@pytest.mark.parametrize("engine", ["unity", "unreal"])
def test_text(engine: str) -> None:
    for name, text in files_of(engine, EXAMPLES / "plastic.burnish", "Plastic").items():
        assert "ever compiled by" in text.splitlines()[0]
        assert_golden(text, GOLDEN / name)
    assert known.load(engine).unproven.startswith("never compiled by ")


def test_dxc_takes_the_functions() -> None:
    jobs = []
    for engine in ("unity", "unreal"):
        for name, material in NODES.items():
            files = files_of(engine, EXAMPLES / f"{name}.burnish", material)
            lines = "".join(files.values()).splitlines()
            inner = "\n".join(line for line in lines if not line.startswith("#"))  # the guard
            text = (STUBS if engine == "unity" else "") + inner + ENTRY
            jobs.append(Job("dxc-dxil", "frag", text, name=f"{engine} {material}"))
    with Toolchain() as toolchain:
        assert not [(each.job.name, each.messages[:3]) for each in refused(jobs, toolchain)]
