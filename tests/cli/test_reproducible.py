"""The same sources give the same files, whatever folder the compiler runs in."""

from __future__ import annotations

import json
from pathlib import Path

import burnish

from .kit import shell

FILES = {
    "src/main.burnish": """
        import "near.burnish".{Near}
        import deep.inner.{Inner}
        import far.{Far}
        material Main : Inner + Near + Far {
            color = vec3(near * near, inner * inner, far * far)
        }
        """,
    "src/near.burnish": "mixin Near { near = sin(uv.x * 3.0) }",
    "src/deep/inner.burnish": """
        import beside.{Beside}
        abstract material Inner : Beside { inner = cos(beside * beside) }
        """,
    "src/deep/beside.burnish": "abstract material Beside { beside = sin(uv.y * 3.0) }",
    "lib/far.burnish": """
        import other.{other}
        mixin Far { far = tan(other(uv.x) + other(uv.y)) }
        """,
    "lib/other.burnish": """
        fn other(x: float) -> float = a * a * b * b + a * b + 2.0 * b where {
            a = sin(x * 3.0)
            b = exp(x) + log(x * x + 3.0)
        }
        """,
}
SOURCES = {
    "main.burnish", "near.burnish", "deep/inner.burnish", "deep/beside.burnish",
    "../lib/far.burnish", "../lib/other.burnish",
}  # fmt: skip


def checkout(folder: Path) -> Path:
    for name, text in FILES.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, "utf-8")
    return folder


def compiled(file: Path | str, library: Path | str, output: Path, folder: Path) -> dict[str, bytes]:
    """The files of a compile that runs in a folder."""
    words = (
        "compile",
        file,
        "-I",
        library,
        "-t",
        "hlsl,glsl,wgsl",
        "--line-directives",
        "-o",
        output,
    )
    run = shell(*words, folder=folder)
    assert run.returncode == 0, run.stderr
    return {path.name: path.read_bytes() for path in output.iterdir()}


def test_neither_folder_nor_path_matters(tmp_path: Path) -> None:
    one = checkout(tmp_path / "one")
    two = checkout(tmp_path / "two" / "deeper")
    (tmp_path / "link").symlink_to(two)
    expected = compiled("src/main.burnish", "lib", tmp_path / "a", one)
    assert len(expected) == 7
    assert compiled("main.burnish", "../lib", tmp_path / "b", one / "src") == expected
    absolute = (two / "src" / "main.burnish", two / "lib")
    assert compiled(*absolute, tmp_path / "c" / "d", tmp_path) == expected
    assert compiled("../link/src/main.burnish", two / "lib", tmp_path / "e", one) == expected
    maps = json.loads(expected["Main.json"])["backends"]["wgsl:webgpu"]["source_maps"]
    named = {name for each in maps.values() for name in each["sources"]}
    assert named >= SOURCES
    assert {name for name in named - SOURCES if not name.startswith("std/")} == set()
    assert "std/spaces.burnish" in named
    assert b'#line 6 "main.burnish"' in expected["Main.frag.hlsl"]


def test_a_text_has_no_folder(tmp_path: Path) -> None:
    """The names of the files that it imports begin at the first folder of the search path."""
    for where in (checkout(tmp_path / "one"), checkout(tmp_path / "two")):
        text = "import far.{Far}\nmaterial M : Surface + Far { a = sin(far) color = vec3(a * a) }\n"
        (material,) = burnish.compile(text, "wgsl", search_path=[where / "src", where / "lib"])
        maps = material.reflection.backends["wgsl:webgpu"].source_maps
        named = {name for each in maps.values() for name in each.sources}
        assert {"<text>", "../lib/far.burnish", "../lib/other.burnish"} <= named
