"""Maps the repository root onto the package ``burnish``; everything else stands in pyproject.toml.

The list of sub-packages is computed so that a new folder under any of the roots is part of the next
build by itself. The package ``generated`` is written while the package is built (``generate.py``).
"""

from __future__ import annotations

import sys
from compileall import compile_dir, compile_file
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path

from setuptools import find_packages, setup
from setuptools.command.build_py import build_py

HERE = Path(__file__).parent.resolve()
ROOTS = (
    "api", "bindings", "commands", "compiler", "engines", "materialx", "stdlib", "support",
    "targets",
)  # fmt: skip
TOOLS = ("generate", "setup")
"""Modules of the root that only a checkout needs."""
DATA = (
    "h", "hpp", "rs", "ts", "j2", "txt", "json", "lark", "mjs", "css", "js", "html", "svg",
    "burnish",
)  # fmt: skip
"""The endings of files that belong to the package besides its code."""

sub_packages = find_packages(include=[pattern for root in ROOTS for pattern in (root, f"{root}.*")])


class BuildPackage(build_py):
    """Adds the computed modules, and leaves out those that only a checkout needs."""

    def find_package_modules(self, package, package_dir):
        modules = super().find_package_modules(package, package_dir)
        return [module for module in modules if module[0] != "burnish" or module[1] not in TOOLS]

    def run(self):
        super().run()
        if self.editable_mode:
            generate(HERE / "generated")
            compile_checkout()
        else:
            generate(Path(self.build_lib).resolve() / "burnish" / "generated")


def generate(folder):
    """Run ``generate.py`` of this checkout, whatever its folder is called."""
    place = {"submodule_search_locations": [str(HERE)]}
    spec = spec_from_file_location("burnish", HERE / "__init__.py", **place)
    sys.modules["burnish"] = module_from_spec(spec)
    from burnish import generate as generator

    generator.generate(folder)


def compile_checkout():
    """Write the byte code of all modules, as pip does for a wheel: the first start takes less."""
    for folder in (*ROOTS, "generated"):
        compile_dir(HERE / folder, quiet=1)
    for path in HERE.glob("*.py"):
        compile_file(path, quiet=1)


setup(
    cmdclass={"build_py": BuildPackage},
    packages=["burnish", *(f"burnish.{name}" for name in sub_packages)],
    package_dir={"burnish": "."},
    # Only editors read these files of the checkout; pages get them from the package `generated`.
    exclude_package_data={"burnish.targets": ["web_host/generated/*"]},
    package_data={
        "burnish": [
            "py.typed",
            # Pages link to these.
            *(
                "README.md",
                "CONTRIBUTING.md",
                "SECURITY.md",
                "CHANGELOG.md",
                "LICENSE",
                "LICENSE-OUTPUT.md",
            ),
            *(f"docs/**/*.{ending}" for ending in ("md", "png")),
            *(
                f"examples/**/*.{ending}"
                for ending in ("burnish", "md", "mtlx", "said", "png", "hdr")
            ),
            # Projects of `burnish new`, in whichever languages they are.
            "examples/hosts/**/*.*",
            # What GitHub runs is in the repository alone.
            *(
                f"integrations/**/*.{ending}"
                for ending in ("cmake", "toml", "rs", "json", "js", "ts")
            ),
        ],
        "burnish.stdlib": ["**/*.burnish", "*.toml", "*.txt"],
        # Not every folder below these is a package.
        **{
            f"burnish.{root}": [f"**/*.{ending}" for ending in DATA]
            for root in ("bindings", "commands", "compiler", "engines", "targets")
        },
    },
)
