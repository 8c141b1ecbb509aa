"""The entry point ``burnish.bind``: from files to their binding in a host's language.

The command ``burnish bind`` calls it, too.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from ..bindings import registry
from ..bindings.gathering import Compiled, CompiledPlan, gathered
from ..bindings.host_language import HostLanguage
from ..bindings.writing import written
from ..support.arguments import expect
from ..support.frozen import EMPTY
from ..targets.selection import DEFAULT
from .compiled import CompiledMaterial, CompileResult
from .entry_points import GivenValue, compile

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
    namespace: str = "",
    embed: bool = False,
) -> str:
    """The binding of files, or of a text, in the language of a host: ``"cpp"``, ``"python"`` …

    All materials of the files are bound together, and share the blocks that are alike. ``targets``,
    ``material``, ``rig``, ``pass_``, ``search_path``, ``values`` and ``hoist`` are those of
    ``compile``: give both the same. ``namespace`` is where a language has such, by default the name
    of the first file. With ``embed``, the texts of the shaders are in the binding.

    Raises ``CompileError`` as ``compile`` does, ``ValueError`` for a language or a namespace that
    there is not, and ``TypeError`` for arguments of other types.
    """
    expect("language", language, str, "the name of a language")
    expect("namespace", namespace, str, "the name of a namespace")
    found = host_language(language)
    names = [sources] if isinstance(sources, str | Path) else list(sources)
    results = [
        compile(
            each, targets, material=material, rig=rig, pass_=pass_, search_path=search_path,
            values=values, hoist=hoist,
        )
        for each in names
    ]  # fmt: skip
    files = tuple(_name(each) for each in names)
    binding = gathered(
        [_compiled(each, embed) for result in results for each in result],
        list(_plans(results)),
        files, namespace_of(namespace, found, files),
    )  # fmt: skip
    return written(binding, found)


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
