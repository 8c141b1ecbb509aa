"""The entry point ``burnish.bind``: from files to their binding in a host's language.

The command ``burnish bind`` calls it, too.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

from ..bindings import registry
from ..bindings.gathering import Compiled, CompiledPlan, gathered
from ..bindings.host_language import HostLanguage
from ..bindings.writing import written
from ..support.arguments import expect
from ..support.frozen import EMPTY
from ..targets.selection import DEFAULT
from .compiled import CompiledMaterial, CompileResult
from .entry_points import GivenValue, compile, declared

_NAMESPACE = re.compile(r"[^\W\d]\w*(::[^\W\d]\w*)*")


def bind(
    sources: str | Path | Sequence[str | Path],
    language: str,
    targets: str | Iterable[str] = DEFAULT,
    *,
    material: str | None = None,
    rig: str | None = None,
    pass_: str | None = None,
    search_path: Sequence[str | Path] = (),
    values: Mapping[str, GivenValue] = EMPTY,
    hoist: bool = True,
    flip_y: bool = False,
    single_file: bool = False,
    native_stages: bool = False,
    bindings: str | PathLike[str] | Mapping[str, Any] | None = None,
    namespace: str = "",
    embed: bool = False,
) -> str:
    """The binding of files, or of a text, in the language of a host: ``"cpp"``, ``"python"`` …

    All materials of the files are bound together, and share the blocks that are alike. Without
    ``rig``, a file that declares several is bound with each. ``targets``, ``material``, ``pass_``,
    ``search_path``, ``values``, ``hoist``, ``flip_y``, ``single_file``, ``native_stages`` and
    ``bindings`` are those of ``compile``: give both the same. ``namespace`` is where a language has
    such, by default the name of the first file. With ``embed``, the texts of the shaders are in the
    binding.

    Raises ``CompileError`` as ``compile`` does, ``ValueError`` for a language or a namespace that
    there is not, and ``TypeError`` for arguments of other types.
    """
    expect("language", language, str, "the name of a language")
    expect("namespace", namespace, str, "the name of a namespace")
    found = host_language(language)
    names = [sources] if isinstance(sources, str | Path) else list(sources)
    results = [
        compile(
            each, targets, material=material, rig=one, pass_=pass_, search_path=search_path,
            values=values, hoist=hoist, flip_y=flip_y, single_file=single_file,
            native_stages=native_stages, bindings=bindings,
        )
        for each in names
        for one in _rigs(each, rig, search_path)
    ]  # fmt: skip
    files = tuple(_name(each) for each in names)
    binding = gathered(
        [_compiled(each, embed) for result in results for each in result],
        list(_plans(results)),
        files, namespace_of(namespace, found, files),
    )  # fmt: skip
    return written(binding, found)


def _rigs(
    source: str | Path, rig: str | None, search_path: Sequence[str | Path]
) -> Iterator[str | None]:
    """The rigs with which a source is compiled: all that it declares, unless one is named."""
    rigs = () if rig is not None else declared(source, search_path=search_path).rigs
    yield from rigs if len(rigs) > 1 else (rig,)


def host_language(name: str) -> HostLanguage:
    """The language of hosts that has this name. Raises ``ValueError`` if none has."""
    try:
        return registry.load(name)
    except KeyError:
        there = ", ".join(f"`{each}`" for each in registry.names())
        raise ValueError(f"no language of hosts is called `{name}`: there are {there}") from None


def _compiled(material: CompiledMaterial, embed: bool) -> Compiled:
    texts = {file.name: file.text for file in material.files} if embed else EMPTY
    return Compiled(reflection=material.reflection, texts=texts, stem=material.stem)


def _plans(results: Iterable[CompileResult]) -> Iterator[CompiledPlan]:
    """The plans of all frames, whose shaders are among all materials of the results."""
    first = 0
    for result in results:
        numbers = {each.name: first + number for number, each in enumerate(result)}
        for frame in result.frames:
            shaders = tuple(numbers[each.name] for each in frame.shaders)
            yield CompiledPlan(plan=frame.plan, shaders=shaders)
        first += len(result)


def _name(source: str | Path) -> str:
    """The name of a file; ``text`` for a text."""
    is_text = isinstance(source, str) and ("\n" in source or "{" in source)
    return "text" if is_text else Path(source).name


def namespaces_of(asked: str, languages: Sequence[str], files: Sequence[str]) -> Mapping[str, str]:
    """The namespace of a binding in each language; of several, some may have none.

    Raises ``ValueError`` if none can have the one asked for.
    """
    found = [host_language(name) for name in languages]
    some = any(each.has_namespace for each in found)
    return {
        each.name: namespace_of(asked if each.has_namespace or not some else "", each, files)
        for each in found
    }


def namespace_of(asked: str, language: HostLanguage, files: Sequence[str]) -> str:
    """The namespace of a binding. Raises ``ValueError`` if it cannot have the one asked for."""
    if not asked:
        return Path(files[0]).stem if files else "materials"
    if not language.has_namespace:
        raise ValueError(f"{language.title} has no namespaces: a binding is a file of its own")
    if _NAMESPACE.fullmatch(asked) is None:
        raise ValueError(
            f"`{asked}` is no namespace, which would be like `scene` or `scene::glass`"
        )
    return asked
