"""Computes everything that is the same for every compile, and writes it as modules of the package.

``setup.py`` calls ``generate`` when a wheel is built or a checkout is installed. ``make demo`` and
pytest run ``python -m burnish.generate``, which does so if something has changed, and then gives
editors the types of the host for web pages. ``compiler/precomputed.py`` loads the modules. They are
like any other code of the package, and nothing is ever written to them while Burnish runs. This
module is not in the wheel.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from compileall import compile_dir
from pathlib import Path

from .compiler.library import trees_to_generate
from .compiler.precomputed import Precomputations, precomputed
from .compiler.reflection.roles import scene_names_to_generate
from .compiler.syntax.lalr_tables import tables_to_generate
from .support.initialisers import texts_to_generate
from .targets import registry
from .targets.emit.templates import FUNCTIONS, functions_to_generate
from .targets.web_host.checking import write_for_checking
from .targets.web_host.serving.builtin_table import module_to_generate

FOLDER = Path(__file__).parent / "generated"
HOST = Path(__file__).parent / "targets" / "web_host"
_HEAD = '"""Written by generate.py."""'


def generate(folder: Path) -> None:
    """Write the package ``generated`` into a folder, which is made if it is not there."""
    folder.mkdir(parents=True, exist_ok=True)
    _write(folder / "__init__.py", (_HEAD,))
    for name, values in _modules().items():
        _write(folder / f"{name}.py", _WRITERS.get(name, _data)(values))


def is_current() -> bool:
    """True if everything was generated from the files as they are now."""
    wanted = ((name, key) for name, values in _modules().items() for key in values)
    return all(precomputed(name, key) is not None for name, key in wanted)


def _modules() -> dict[str, Precomputations]:
    languages = [registry.load(name) for name in registry.names()]
    skeletons = [
        language.under(profile).skeleton for language in languages for profile in language.profiles
    ]
    return {
        "grammar": tables_to_generate(),
        "library": trees_to_generate(),
        "scene": scene_names_to_generate(),
        "skeletons": functions_to_generate(dict.fromkeys((*skeletons, FUNCTIONS))),
        "builtin_table": module_to_generate(),
        "initialisers": dict.fromkeys(texts_to_generate(), str),  # Their keys are all of them.
    }


def _data(values: Precomputations) -> Iterator[str]:
    """The lines of a module with ``VALUES`` that Python can write."""
    yield from (_HEAD, "VALUES = {")
    yield from (f"    {key!r}: {compute()!r}," for key, compute in values.items())
    yield "}"


def _functions(values: Precomputations) -> Iterator[str]:
    """The lines of a module whose ``VALUES`` are functions."""
    yield from (_HEAD, "from ..targets.emit.templates import joiner as joiner_")
    codes = {key: compute() for key, compute in values.items()}
    yield from (str(code) for code in codes.values() if code is not None)
    yield "VALUES = {"
    yield from (f"    {key!r}: render_{key}," for key, code in codes.items() if code is not None)
    yield "}"


def _codes(values: Precomputations) -> Iterator[str]:
    """The lines of a module whose ``VALUES`` are the codes of functions, by their texts."""
    yield from (_HEAD, "VALUES = {}")
    for text in values:
        yield from (text, f"VALUES[{text!r}] = __init__.__code__")


_WRITERS = {"skeletons": _functions, "initialisers": _codes}


def _write(path: Path, lines: Iterable[str]) -> None:
    """Write a module in one step, as other processes may be about to load it."""
    new = path.with_suffix(f".{os.getpid()}.new")
    new.write_text("".join(f"{line}\n" for line in lines), encoding="utf-8")
    new.replace(path)


if __name__ == "__main__":
    if not is_current():
        generate(FOLDER)
        compile_dir(FOLDER, quiet=1)
    write_for_checking(HOST)
