"""Burnish: a declarative shader-graph compiler.

    import burnish

    result = burnish.compile("plastic.burnish", targets=("wgsl",))
    print(result["Plastic"].text("wgsl", "fragment"))

One material comes out as HLSL, GLSL and WGSL that mean the same. See ``docs/`` for the language.
"""

from __future__ import annotations

TYPE_CHECKING = False  # As in ``typing``, which takes longer to import than all else here.
if TYPE_CHECKING:
    from typing import Any

    from .api.binding import bind
    from .api.entry_points import (
        Comparison,
        CompiledFrame,
        CompiledMaterial,
        CompileResult,
        Instance,
        MissingValuesError,
        OutputFile,
        ParameterError,
        PictureError,
        SameError,
        Texture,
        check,
        compile,
        functions,
        same,
        to_json,
    )
    from .api.modules import modules
    from .compiler.diagnostics.diagnostic import CompileError, Diagnostic

__version__ = "0.1.0"
__all__ = [
    "Comparison",
    "CompileError",
    "CompileResult",
    "CompiledFrame",
    "CompiledMaterial",
    "Diagnostic",
    "Instance",
    "MissingValuesError",
    "OutputFile",
    "ParameterError",
    "PictureError",
    "SameError",
    "Texture",
    "__version__",
    "bind",
    "check",
    "compile",
    "functions",
    "modules",
    "same",
    "to_json",
]


def __getattr__(name: str) -> Any:
    """Load the compiler on first use only: ``burnish --help`` and subpackages start without it.

    What has been found stays an attribute of the package, for which Python does not ask here again.
    """
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    if name in ("CompileError", "Diagnostic"):
        from .compiler.diagnostics import diagnostic

        found = getattr(diagnostic, name)
    elif name == "bind":
        from .api import binding

        found = binding.bind
    elif name == "modules":
        from .api import modules

        found = modules.modules
    else:
        from .api import entry_points as api

        found = getattr(api, name)
    globals()[name] = found
    return found
