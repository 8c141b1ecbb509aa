"""What a command that draws says when something is wrong, and what it needs to be installed."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager

import click

from .console import FAILED, show, wants_color

PACKAGES = {"numpy": "NumPy", "PIL": "Pillow"}


def fail(text: str) -> None:
    """Tells an error that has no place in a file, and ends the command."""
    word = click.style("error", fg="red", bold=True) if wants_color(sys.stderr) else "error"
    click.echo(f"{word}: {text}", err=True, color=True)
    click.get_current_context().exit(FAILED)


@contextmanager
def told() -> Iterator[None]:
    """Tells what goes wrong inside: errors in the material, in values, in pictures, in drivers."""
    try:
        from ..compiler.diagnostics.diagnostic import CompileError
        from ..targets.runner.codes import CodeError
        from ..targets.runner.draw import DriverError
        from ..targets.runner.instance import MissingValuesError
        from ..targets.runner.meshes import MeshError
        from ..targets.runner.routes import UnknownRouteError
        from ..targets.runner.textures import PictureError
        from ..targets.runner.values import ParameterError
    except ModuleNotFoundError as error:
        needed(error)
        return
    try:
        yield
    except CompileError as error:
        show(error.diagnostics)
        click.get_current_context().exit(FAILED)
    except UnknownRouteError as error:
        raise click.UsageError(str(error)) from error
    except (
        CodeError, DriverError, MeshError, MissingValuesError, ParameterError, PictureError
    ) as error:  # fmt: skip
        fail(str(error))
    except ModuleNotFoundError as error:
        needed(error)


def needed(error: ModuleNotFoundError) -> None:
    """Says how to install what is missing; anything but the known packages is a defect."""
    package = PACKAGES.get((error.name or "").partition(".")[0])
    if package is None:
        raise error
    fail(f"drawing needs {package}, which is not installed: pip install 'burnish[render]'")
