"""Where a tool comes from, and the command that gets it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Debian:
    """Packages of the system, by their names on Debian."""

    packages: tuple[str, ...]

    def command(self, _tool: str) -> str:
        """What a person types to get the tool."""
        return f"apt-get install -y --no-install-recommends {' '.join(self.packages)}"


@dataclass(frozen=True, slots=True)
class OwnInstaller:
    """``install.py`` puts it into the cache folder, in this version."""

    pinned: str

    def command(self, tool: str) -> str:
        """What a person types to get the tool."""
        return f"python -m burnish.targets.toolchain.install {tool}"


@dataclass(frozen=True, slots=True)
class Extra:
    """It comes with Burnish when that is installed with an extra."""

    name: str

    def command(self, _tool: str) -> str:
        """What a person types to get the tool."""
        return f"pip install 'burnish[{self.name}]'"


Source = Debian | OwnInstaller | Extra
