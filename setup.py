"""Maps the repository root onto the package ``burnish``; everything else stands in pyproject.toml.

The list of sub-packages is computed so that a new folder under any of the roots is
part of the next build by itself.
"""

from setuptools import find_packages, setup

ROOTS = ("commands", "compiler", "targets", "stdlib")

sub_packages = find_packages(include=[pattern for root in ROOTS for pattern in (root, f"{root}.*")])

setup(
    packages=["burnish", *(f"burnish.{name}" for name in sub_packages)],
    package_dir={"burnish": "."},
    package_data={
        "burnish": ["py.typed"],
        "burnish.stdlib": ["*.burnish"],
        **{
            f"burnish.{name}": ["*.j2", "*.txt", "*.json", "*.lark", "*.mjs"]
            for name in sub_packages
            if name.startswith(("compiler", "targets"))
        },
    },
)
