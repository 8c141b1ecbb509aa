"""The origins of tools, and the commands that install them; part of a row of ``tools.py``."""

from __future__ import annotations

from dataclasses import dataclass

from ...support.installing import install_command


@dataclass(frozen=True, slots=True)
class Debian:
    """Packages of the system, by their names on Debian."""

    packages: tuple[str, ...]

    def command(self, _tool: str) -> str:
        """The command that a person types to install the tool."""
        return f"apt-get install -y --no-install-recommends {' '.join(self.packages)}"


@dataclass(frozen=True, slots=True)
class OwnInstaller:
    """``install.py`` puts the tool into the cache folder, in exactly this version."""

    pinned: str

    def command(self, tool: str) -> str:
        """The command that a person types to install the tool."""
        return f"python -m burnish.targets.toolchain.install {tool}"


@dataclass(frozen=True, slots=True)
class Extra:
    """The tool is installed together with Burnish, as an extra."""

    name: str

    def command(self, _tool: str) -> str:
        """The command that a person types to install the tool."""
        return install_command([self.name])


@dataclass(frozen=True, slots=True)
class Unstable:
    """A package of Debian unstable, which ``unstable.py`` unpacks into the cache folder.

    Unstable has one version of each package, which changes, and now and then what a package needs
    is not there. So nobody can promise that the tool can be installed today: it may be missing, and
    tests that need it are then skipped.
    """

    package: str

    def command(self, tool: str) -> str:
        """The command that a person types to install the tool."""
        return f"python -m burnish.targets.toolchain.install {tool}"


Source = Debian | OwnInstaller | Extra | Unstable
