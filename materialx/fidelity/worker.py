"""The process that generates texts by MaterialX: ``python -m burnish.materialx.fidelity.worker``.

A document may make the package crash or hang, which then only ends this process.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ...support.installing import install_command
from ...targets.runner.drivers.wire import split
from ...targets.toolchain.pipe import Packet, serve
from .generating import Generator
from .records import FidelityError

EXTRA = "materialx"
"""The extra of Burnish with the package MaterialX."""
ORPHAN_LIMIT = 900.0
"""The seconds after which a request ends the process: far more than callers wait for."""


class _Worker:
    """Answers requests; the first one parses MaterialX's library."""

    def __init__(self) -> None:
        self._generator: Generator | None = None

    def answer(self, request: Packet) -> Packet:
        """The answer to ``{"renderables": path}`` has ``renderables``, that to ``{"generate": …}``
        has ``generated``; or it has ``error``."""
        try:
            return self._answer(request.content)
        except FidelityError as error:
            return Packet({"error": str(error)})
        except ImportError as error:
            return Packet({"error": f"{error}; to install it: {install_command((EXTRA,))}"})

    def _answer(self, content: Mapping[str, Any]) -> Packet:
        if self._generator is None:
            self._generator = Generator()
        if "renderables" in content:
            return Packet({"renderables": self._generator.renderables(content["renderables"])})
        asked = content["generate"]
        found = self._generator.generated(
            asked["path"], asked["renderable"], asked["lights"],
            complete=asked["complete"], by_host=asked["by_host"],
        )  # fmt: skip
        answer, data = split(found)
        return Packet({"generated": answer}, data)


if __name__ == "__main__":
    serve(_Worker().answer, ORPHAN_LIMIT)
