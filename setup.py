"""Maps the repository root onto the package ``burnish``; everything else stands in pyproject.toml.

The list of sub-packages is computed so that a new folder under any of the roots is
part of the next build by itself.
"""

from setuptools import find_packages, setup
from setuptools.command.build_py import build_py

ROOTS = ("commands", "compiler", "targets", "stdlib")

sub_packages = find_packages(include=[pattern for root in ROOTS for pattern in (root, f"{root}.*")])


class BuildPackage(build_py):
    """The root is a package folder, but this file is no module of it."""

    def find_package_modules(self, package, package_dir):
        modules = super().find_package_modules(package, package_dir)
        return [module for module in modules if module[:2] != ("burnish", "setup")]


setup(
    cmdclass={"build_py": BuildPackage},
    packages=["burnish", *(f"burnish.{name}" for name in sub_packages)],
    package_dir={"burnish": "."},
    package_data={
        "burnish": ["py.typed"],
        "burnish.stdlib": ["*.burnish", "*.toml"],
        **{
            f"burnish.{name}": ["*.h", "*.j2", "*.txt", "*.json", "*.lark", "*.mjs"]
            for name in sub_packages
            if name.startswith(("compiler", "targets"))
        },
    },
)
