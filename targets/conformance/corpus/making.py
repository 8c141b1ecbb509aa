"""Makes the files of the corpus; ``burnish corpus`` writes them."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable

from ....compiler.documents.writing import to_json
from ....stdlib.builtins.accuracy import PLATFORMS
from ....stdlib.builtins.overloads import Overload, Shape
from ....stdlib.builtins.row import Builtin
from .bits import bits_of
from .operands import OPERATIONS, CorpusCase, cases_of, chosen_overloads
from .records import (
    VERSION,
    CaseRow,
    Corpus,
    CorpusIndex,
    Kind,
    OperationRow,
    OverloadRow,
    PromiseRow,
    SpecificationRow,
    TypeRow,
)
from .results import PROMISES, result_of, title_of

INDEX = "index.json"


def make(
    names: Iterable[str], seed: int, generator: str, tell: Callable[[float], None]
) -> dict[str, str]:
    """The texts of the files for some operations, and of their index, by their names.

    ``tell`` is told how much of the work is done.
    """
    wanted = list(names)
    texts: dict[str, str] = {}
    rows = []
    for number, name in enumerate(wanted):
        corpus = corpus_of(OPERATIONS[name], seed)
        cases = [case for overload in corpus.overloads for case in overload.cases]
        guarded = sum(case.guarded for case in cases)
        rows.append(OperationRow(name=name, file=f"{name}.json", cases=len(cases), guarded=guarded))
        texts[f"{name}.json"] = _text(corpus)
        tell((number + 1) / len(wanted))
    index = CorpusIndex(
        corpus=VERSION,
        generator=generator,
        seed=seed,
        promises=tuple(PromiseRow(name=name, title=title_of(name)) for name in PROMISES),
        operations=tuple(rows),
    )
    return {INDEX: json.dumps(to_json(index), indent=2) + "\n", **texts}


def corpus_of(row: Builtin, seed: int) -> Corpus:
    """The cases of an operation."""
    return Corpus(
        corpus=VERSION,
        name=row.name,
        operator=row.operator,
        doc=row.doc,
        domain=row.needs,
        outside=row.outside,
        specifications=tuple(_specifications(row)),
        overloads=tuple(_overload(each, seed) for each in chosen_overloads(row)),
    )


def _specifications(row: Builtin) -> Iterable[SpecificationRow]:
    for platform in PLATFORMS:
        promise = row.accuracy.on(platform)
        yield SpecificationRow(
            platform=platform,
            accuracy=str(promise.bound),
            source=promise.source,
            assumed=promise.assumed,
        )


def _overload(overload: Overload, seed: int) -> OverloadRow:
    return OverloadRow(
        operands=tuple(map(_type, overload.operands)),
        result=_type(overload.result),
        cases=tuple(_case(overload, case) for case in cases_of(overload, seed)),
    )


def _case(overload: Overload, case: CorpusCase) -> CaseRow:
    pairs = zip(overload.operands, case.operands, strict=True)
    return CaseRow(
        operands=tuple(
            tuple(_bits_of_operand(lane, _type(shape).kind) for lane in lanes)
            for shape, lanes in pairs
        ),
        guarded=case.guarded,
        result=result_of(overload, case),
    )


def _bits_of_operand(lane: float, kind: Kind) -> str:
    """The bits of an operand, of which even a zero has a sign."""
    return "80000000" if str(lane) == "-0.0" else bits_of(lane, kind)


def _type(shape: Shape) -> TypeRow:
    kind: Kind = shape.kind  # type: ignore[assignment]
    return TypeRow(name=str(shape), kind=kind, width=shape.width, columns=shape.columns)


def _text(corpus: Corpus) -> str:
    """A corpus as JSON, in which each case has a line."""
    whole = to_json(corpus)
    overloads = whole.pop("overloads")
    head = json.dumps(whole, indent=2, ensure_ascii=False).removesuffix("\n}")
    parts = []
    for overload in overloads:
        cases = overload.pop("cases")
        types = json.dumps(overload, separators=(", ", ": "))[1:-1]
        lines = ",\n".join(f"    {json.dumps(case, separators=(',', ':'))}" for case in cases)
        parts.append(f'  {{{types}, "cases": [\n{lines}\n  ]}}')
    body = ",\n".join(parts)
    return f'{head},\n  "overloads": [\n{body}\n  ]\n}}\n'
