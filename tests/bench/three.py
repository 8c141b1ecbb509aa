"""The first frame of many materials in three.js: by Burnish's modules, and the same in its own TSL.

A page of Chromium has loaded three.js and the modules. It makes the materials and draws one frame:
the time until a pixel of it can be read counts. All ways are measured in turn, each in a browser of
its own, so that nothing has been compiled before. A pixel shows that the surfaces are the same.
"""

from __future__ import annotations

import statistics
from collections.abc import Iterator
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from burnish.api.compiling_engines import functions_for, shader_files, shaders_for
from burnish.compiler.diagnostics.diagnostic import Report
from burnish.engines import known

from ..engines.kit import ADDRESS, module_of, site_in
from ..suite import browsers
from .table import Row, Section

COUNT = 25
OCTAVES = 6
TURNS = 3
WAYS = {
    "TSL": ("tsl", "webgpu"), "functions": ("functions", "webgpu"),
    "TSL, WebGL 2": ("tsl", "webgl"), "functions, WebGL 2": ("functions", "webgl"),
    "whole shaders, WebGLRenderer": ("whole", "webgl"),
}  # fmt: skip
PAGE = Path(__file__).with_name("three.html")


def measure() -> Iterator[Section]:
    """The section of the first frame."""
    with TemporaryDirectory() as name:
        site = site_in(Path(name), str(PAGE))
        _write_modules(site)
        times: dict[str, list[float]] = {way: [] for way in WAYS}
        pixels: dict[str, Any] = {}
        for _ in range(TURNS):
            for way, (kind, backend) in WAYS.items():
                with browsers.browser() as browser:
                    page = browser.new_page()
                    browsers.serve(page, site)
                    page.goto(ADDRESS)
                    page.wait_for_function("window.ready === true")
                    found = page.evaluate("given => first(...given)", [kind, backend, COUNT])
                times[way].append(found["milliseconds"])
                pixels[way] = found["pixel"]
    rows: list[Row] = [
        {
            "way": way,
            "milliseconds": _median(times[way]),
            "beside TSL": _beside(times, way),
            "a pixel": str(pixels[way]),
        }
        for way in WAYS
    ]
    yield Section("three", f"The first frame of {COUNT} materials in three.js", rows)


def _median(times: list[float]) -> float:
    return statistics.median(times)


def _beside(times: dict[str, list[float]], way: str) -> float:
    """The ratio to TSL by the same backend."""
    is_gl = "WebGL" in way
    return _median(times[way]) / _median(times["TSL, WebGL 2" if is_gl else "TSL"])


def source(number: int) -> str:
    """A surface of octaves of waves, unlike those of other numbers."""
    waves = "".join(
        f"    p{octave} = {2**octave}.0 * uv + vec2({number}.25, {octave}.5)\n"
        f"    w{octave} = sin(3.0 * p{octave}.x + cos(2.0 * p{octave}.y)) / {2**octave}.0\n"
        for octave in range(OCTAVES)
    )
    total = " + ".join(f"w{octave}" for octave in range(OCTAVES))
    return (
        f"material Wave{number} {{\n    param dye : rgb = #b5651d\n{waves}"
        f"    height = 0.5 + 0.25 * ({total})\n"
        "    tint = mix(dye, dye * dye, smoothstep(0.2, 0.8, height))\n    color = tint\n}\n"
    )


def _write_modules(site: Path) -> None:
    functions, whole = known.load("three"), known.load("three-webgl")
    for number in range(COUNT):
        (made,) = functions_for(functions, source(number)).materials
        module_of(made, site)
        (material,) = shaders_for(whole, source(number)).materials
        for name, text in shader_files(whole, material, Report()).items():
            (site / name).write_text(text, encoding="utf-8")
