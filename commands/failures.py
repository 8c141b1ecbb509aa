"""What a command that draws says when something is wrong, and what it needs to be installed."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import NoReturn

import click

from .console import FAILED, remark, show

PACKAGES = {"numpy": "NumPy", "PIL": "Pillow"}


def fail(text: str) -> NoReturn:
    """Tells an error that has no place in a file, and ends the command."""
    remark("error", text)
    click.get_current_context().exit(FAILED)


@contextmanager
def told() -> Iterator[None]:
    """Tells what goes wrong inside: errors in the material, in values, in pictures, in drivers."""
    try:
        from ..compiler.diagnostics.diagnostic import CompileError
        from ..targets.runner.codes import CodeError
        from ..targets.runner.drivers.draw import DriverError
        from ..targets.runner.instances.instance import MissingValuesError
        from ..targets.runner.instances.values import ParameterError
        from ..targets.runner.meshes import MeshError
        from ..targets.runner.routes import UnknownRouteError
        from ..targets.runner.textures.kinds import PictureError
    except ModuleNotFoundError as error:
        needed(error)
    try:
        yield
    except CompileError as error:
        show(error.diagnostics)
        click.get_current_context().exit(FAILED)
    except UnknownRouteError as error:
        raise click.UsageError(str(error)) from error
    except DriverError as error:
        fail(str(error).replace("\n", "\n  "))
    except (CodeError, MeshError, MissingValuesError, ParameterError, PictureError) as error:
        fail(str(error))
    except MemoryError:
        fail("there is not enough memory to draw this: a smaller picture may do")
    except ModuleNotFoundError as error:
        needed(error)


def needed(error: ModuleNotFoundError) -> NoReturn:
    """Says how to install what is missing; anything but the known packages is a defect."""
    package = PACKAGES.get((error.name or "").partition(".")[0])
    if package is None:
        raise error
    fail(f"drawing needs {package}, which is not installed: pip install 'burnish[render]'")
