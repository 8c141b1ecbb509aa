"""Draws renderables of documents by MaterialX's own text, and materials of Burnish beside them.

``burnish import --check`` and tests use one ``Checker`` for many pictures: it owns the processes
that generate texts and draw.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...targets.closing import Closing
from ...targets.runner.drivers.device import DriverError
from ...targets.runner.drivers.readback import layers_of
from ...targets.runner.drivers.wire import joined
from ...targets.runner.routes import EVERY_ROUTE, Route
from ...targets.runner.runner import Runner
from ...targets.toolchain import Toolchain
from ...targets.toolchain.limits import COMPILERS
from ...targets.toolchain.surroundings import python_worker
from ...targets.toolchain.workers import Answer, Worker
from .foreign import foreign_job
from .images import Color, Images
from .own import OwnPicture, Values, draw_own
from .records import FidelityError, Generated
from .settings import ONE_LIGHT, Setting

Floats = NDArray[np.float64]

ROUTE = "llvmpipe:gl330"
"""The route of both sides, unless another one is named for Burnish's."""
GENERATE_LIMIT = 60.0
"""The seconds that generating a text may take, MaterialX's start included."""
DRAW_LIMIT = 120.0
"""The seconds that compiling and drawing a text may take."""

_WORKER = f"{__package__}.worker"


@dataclass(frozen=True, eq=False, slots=True)
class Drawn:
    """A picture by MaterialX's own text."""

    picture: Floats
    """(height, width, 4), the top row first."""
    missing: Mapping[str, Color]
    """The files that the document names and that are not there, with the default colours that are
    drawn in their place."""


class Checker(Closing):
    """Owns the processes that generate and draw. Use it as a context manager."""

    def __init__(self, *, reuse: bool = True, draw_limit: float = DRAW_LIMIT) -> None:
        """Without ``reuse``, pictures that were drawn before are drawn again. A picture that takes
        more than ``draw_limit`` seconds is given up."""
        self._route = EVERY_ROUTE[ROUTE]
        self._runner = Runner([self._route], parallel=1, reuse=reuse, time_limit=draw_limit)
        self._toolchain = Toolchain()
        self._worker = Worker(lambda: python_worker(_WORKER), COMPILERS, tells_command=False)

    def close(self) -> None:
        """End all processes."""
        self._worker.close()
        self._runner.close()
        self._toolchain.close()

    def renderables(self, document: Path) -> list[str]:
        """The names of all that a document renders. Raises ``FidelityError``."""
        answer = self._ask({"renderables": str(document.resolve())})
        names: list[str] = answer.reply["renderables"]
        return names

    def generated(
        self, document: Path, renderable: str, setting: Setting = ONE_LIGHT, *,
        complete: bool = False, by_host: bool = False,
    ) -> Generated:  # fmt: skip
        """The texts that MaterialX generates for a renderable; ``complete`` and ``by_host`` are
        those of ``draw``. Raises ``FidelityError``."""
        asked = {
            "path": str(document.resolve()), "renderable": renderable,
            "lights": list(setting.light_kinds), "complete": complete, "by_host": by_host,
        }  # fmt: skip
        answer = self._ask({"generate": asked})
        return joined(Generated, answer.reply["generated"], answer.data)

    def draw(
        self,
        document: Path,
        renderable: str,
        setting: Setting = ONE_LIGHT,
        *,
        image_folders: tuple[Path, ...] = (),
        complete: bool = False,
        by_host: bool = False,
    ) -> Drawn:
        """The picture of a renderable by MaterialX's own text.

        Images lie in the document's folder, or in one of ``image_folders``. MaterialX writes
        constants with six decimal places into texts; those of ``complete`` ones are exact, and take
        several times as long to compile. A reduced text that no compiler takes is drawn by the
        complete one: some have names of files in them. MaterialX's text decodes files from sRGB
        after filtering them; with ``by_host``, textures are decoded before, as those of most
        engines are. Raises ``FidelityError``, which also tells what is missing.
        """
        self._require(self._route)
        generated = self.generated(
            document, renderable, setting, complete=complete, by_host=by_host
        )
        try:
            return self._drawn(generated, setting, Images(document, image_folders))
        except DriverError as error:
            if not complete:
                return self.draw(
                    document,
                    renderable,
                    setting,
                    image_folders=image_folders,
                    complete=True,
                    by_host=by_host,
                )
            raise FidelityError(f"MaterialX's own text cannot be drawn: {error}") from None

    def _drawn(self, generated: Generated, setting: Setting, images: Images) -> Drawn:
        job = foreign_job(generated, setting, images)
        (texels,) = self._runner.draw_frame(self._route, job).texels
        return Drawn(layers_of(texels)[0][::-1], images.missing)

    def ours(
        self, source: Path | str, material: str, setting: Setting = ONE_LIGHT,
        values: Values | None = None, *, search_path: tuple[Path, ...] = (), is_still: bool = False,
    ) -> OwnPicture:  # fmt: skip
        """The picture of a material of Burnish in the same setting, on the same driver.

        ``source`` is a file or a text, and ``values`` are those of its parameters and textures that
        differ from their defaults; with ``is_still``, displacements move nothing. Raises
        ``FidelityError`` and ``CompileError``.
        """
        self._require(self._route)
        return draw_own(
            source, material, setting, values or {}, search_path,
            self._route, self._runner, self._toolchain, is_still=is_still,
        )  # fmt: skip

    def _require(self, route: Route) -> None:
        problem = self._runner.problem(route)
        if problem is not None:
            raise FidelityError(f"nothing can be drawn by {route.name}: {problem}")

    def _ask(self, request: Mapping[str, Any]) -> Answer:
        answer = self._worker.ask(request, GENERATE_LIMIT)
        if answer.ending != "ended":
            raise FidelityError(f"MaterialX {answer.ending}: {answer.log.strip()}")
        if "error" in answer.reply:
            raise FidelityError(answer.reply["error"])
        return answer
