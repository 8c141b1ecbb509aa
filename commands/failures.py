"""Turns the exceptions of commands that draw into messages and an exit code."""

from __future__ import annotations

import re
from collections.abc import Iterator
from contextlib import contextmanager
from typing import NoReturn

import click

from ..support.installing import install_command
from .console import remark, show
from .terminal import FAILED

PACKAGES = {
    "numpy": ("drawing and the corpus need NumPy", "render"),
    "PIL": ("drawing needs Pillow", "render"),
    "msgspec": ("scenes need msgspec", "scenes"),
    "OpenImageIO": (".exr and .hdr files need OpenImageIO", "scenes"),
    "starlette": ("the viewer's server needs Starlette", "view"),
    "uvicorn": ("the viewer's server needs uvicorn", "view"),
    "distributed": ("a farm needs Dask's distributed", "farm"),
    "watchfiles": ("the viewer needs watchfiles", "view"),
}
"""The message about a missing package, and the extra that installs it, by its imported name."""
REFERENCE = "reference"
"""The route of `--on` that needs no driver."""
COMMANDS = {"view": "view", "conform": "run"}
"""The extra that a command never goes without."""
_OF_SCENES = re.compile(r"\.(exr|hdr|glb|gltf)\b", re.IGNORECASE)
"""The endings of files for which the extra ``scenes`` is needed."""


def fail(text: str) -> NoReturn:
    """Print an error that has no place in a file, and end the command."""
    remark("error", text)
    click.get_current_context().exit(FAILED)


def insist_on_materialx(done: str) -> None:
    """End the command with a message if documents cannot be ``read`` or ``written``."""
    try:
        import MaterialX  # noqa: F401
    except ImportError:
        fail(
            f"documents of MaterialX are {done} by the package MaterialX: "
            f"{install_command(['materialx'])}"
        )


def drawing_errors() -> tuple[type[Exception], ...]:
    """The exceptions whose texts tell people why something cannot be drawn."""
    from ..compiler.budget import BudgetError
    from ..targets.runner.cameras import CameraError
    from ..targets.runner.codes import CodeError
    from ..targets.runner.files import FileError
    from ..targets.runner.frames.checking import PlanError
    from ..targets.runner.instances.host_values import MissingValuesError
    from ..targets.runner.instances.values import ParameterError
    from ..targets.runner.kernel_results import FeedError
    from ..targets.runner.kernels import UndrawableError
    from ..targets.runner.meshes import MeshError
    from ..targets.runner.scenes.records import SceneError
    from ..targets.runner.textures.kinds import PictureError
    from .farming.errors import FarmError

    return (
        BudgetError, CameraError, CodeError, FarmError, FeedError, FileError, MeshError,
        MissingValuesError, ParameterError, PictureError, PlanError, SceneError, UndrawableError,
    )  # fmt: skip


@contextmanager
def errors_as_messages() -> Iterator[None]:
    """Report errors inside the ``with`` block, and end the command.

    ``render`` and ``conform`` run in such a block. It catches errors in the material, in values, in
    pictures and in drivers.
    """
    try:
        from ..compiler.diagnostics.diagnostic import CompileError
        from ..targets.runner.codes import CodeError
        from ..targets.runner.drivers.device import DriverError
        from ..targets.runner.routes import UnknownRouteError

        of_drawing = drawing_errors()
    except ModuleNotFoundError as error:
        needed(error)
    try:
        yield
    except CompileError as error:
        show(error.diagnostics)
        click.get_current_context().exit(FAILED)
    except UnknownRouteError as error:
        raise click.UsageError(str(error)) from error
    except (CodeError, DriverError) as error:
        fail(str(error).replace("\n", "\n  "))
    except of_drawing as error:
        fail(str(error))
    except MemoryError:
        fail("there is not enough memory to draw this: a smaller picture may do")
    except ModuleNotFoundError as error:
        needed(error)


def needed(error: ModuleNotFoundError) -> NoReturn:
    """Say how to install a missing package, and end the command."""
    fail(lacking(error))


def lacking(error: ModuleNotFoundError) -> str:
    """Advice to install a missing package; any other missing module is a bug, and raised again."""
    package = PACKAGES.get((error.name or "").partition(".")[0])
    if package is None:
        raise error
    lack, extra = package
    return f"{lack}, which is not installed: {install_command({extra, *_extras_of_command()})}"


def _extras_of_command() -> Iterator[str]:
    """The extras that the running command needs besides, so that one installation is enough."""
    context = click.get_current_context(silent=True)
    if context is None:
        return  # A thread of the viewer's server, which has its packages.
    if context.info_name in COMMANDS:
        yield COMMANDS[context.info_name]
    if set(context.params.get("on") or ()) - {REFERENCE}:
        yield "run"
    if _OF_SCENES.search(repr(context.params)):
        yield "scenes"
