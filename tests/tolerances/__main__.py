"""``python -m burnish.tests.tolerances``: count what tolerances miss, and how often they cry wolf.

It draws a fixed choice of the examples by all routes that need no GPU, plants errors in them, and
asks each rule of ``rules.py`` and the bounds of ``conform`` about every picture. It prints a table
and writes ``build/tolerances.json``. With ``--keep``, the numbers are kept, too, of which
``docs/tolerances.md`` is made. The same version plants the same errors every time.

    python -m burnish.tests.tolerances                             # everything: some minutes
    python -m burnish.tests.tolerances examples/plastic.burnish --routes lavapipe --count 100
"""

from __future__ import annotations

import json
from argparse import ArgumentParser, Namespace, RawDescriptionHelpFormatter
from collections.abc import Iterator, Sequence
from pathlib import Path

import burnish
from burnish.api.entry_points import CompiledMaterial
from burnish.targets.runner.routes import Route, select
from burnish.targets.toolchain import Toolchain

from .experiment import MisledRunner, outcome_of
from .summary import KEPT, Numbers, document, printed

ROOT = Path(burnish.__file__).parent
EXAMPLES = ROOT / "examples"
OUTPUT = ROOT / "build" / "tolerances.json"

MATERIALS = (
    "plastic", "gold", "toon", "clear_coat", "principled", "gltf_material", "normal_map",
    "parallax", "triplanar", "cutout", "marble", "matcap", "cube_map", "texture_array", "volume",
    "water", "area_lights", "focused_spot", "instances", "skinned",
)  # fmt: skip
"""Examples with all kinds of light, reflectance, texture, noise and motion."""


def main() -> None:
    """Do the experiment that the command line asks for."""
    asked = _asked()
    routes = select([asked.routes])
    numbers = Numbers()
    with MisledRunner(routes) as runner, Toolchain() as toolchain:
        for path in asked.files:
            for label, material in _materials(path, routes):
                outcome = outcome_of(
                    label, material, routes, runner, toolchain, count=asked.count
                )  # fmt: skip
                numbers.add(outcome)
                print(f"{label}: {numbers.told(outcome)}", flush=True)
    print(printed(numbers))
    text = json.dumps(document(numbers, len(routes)), indent=1) + "\n"
    for output in (OUTPUT, KEPT) if asked.keep else (OUTPUT,):
        output.parent.mkdir(exist_ok=True)
        output.write_text(text, encoding="utf-8")
    print(f"written to {OUTPUT}")


def _materials(path: Path, routes: Sequence[Route]) -> Iterator[tuple[str, CompiledMaterial]]:
    """The materials of a file."""
    result = burnish.compile(path, sorted({route.profile for route in routes}), partial=True)
    for material in result.materials:
        yield f"{path.stem}: {material.name}", material


def _asked() -> Namespace:
    parser = ArgumentParser(
        prog="python -m burnish.tests.tolerances", description=__doc__,
        formatter_class=RawDescriptionHelpFormatter,
    )  # fmt: skip
    usual = [EXAMPLES / f"{name}.burnish" for name in MATERIALS]
    parser.add_argument("files", type=Path, nargs="*", default=usual, help="instead of the choice")
    parser.add_argument("--routes", default="all", help="as for `burnish conform`")
    parser.add_argument("--count", type=int, default=20, help="errors in texts of each material")
    parser.add_argument("--keep", action="store_true", help="for docs/tolerances.md")
    return parser.parse_args()


if __name__ == "__main__":
    main()
