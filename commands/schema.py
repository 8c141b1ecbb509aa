"""``burnish schema``: prints the JSON Schema of a document that Burnish writes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from .console import say

if TYPE_CHECKING:
    from collections.abc import Mapping

DOCUMENTS = (
    "reflection", "plan", "package", "golden", "corpus", "corpus_index", "graph", "functions",
)  # fmt: skip


@click.command()
@click.argument("document", type=click.Choice(DOCUMENTS))
def schema(document: str) -> None:
    """Print the JSON Schema of a DOCUMENT that Burnish writes for other programs.

    A reflection (Plastic.json) says how one material is bound, a plan (Deferred.plan.json) by
    which steps a frame is drawn, a package has all that a page draws of a frame, and golden.json
    what a golden folder has. `burnish corpus` writes a corpus for each operation, and its index.
    A graph has the equations of materials, as `burnish export` writes them, and a document of
    functions (Plastic.functions.json) says how an engine calls them. Each has the version of its
    format as `format`, `plan`, `package`, `version`, `corpus`, `graph` or `signatures`.

    \b
    Example:
        burnish schema reflection > reflection.schema.json
    """
    import json

    from ..compiler.documents.schema import json_schema

    found = json_schema(_kinds()[document])
    for line in json.dumps(found, indent=2, ensure_ascii=False).splitlines():
        say(line)


def _kinds() -> Mapping[str, type]:
    """The records of all documents."""
    from ..compiler.documents.equation_graph import EquationGraphs
    from ..compiler.documents.functions import Functions
    from ..compiler.documents.plan import FramePlan
    from ..compiler.documents.reflection import Reflection
    from ..targets.conformance.corpus.records import Corpus, CorpusIndex
    from ..targets.conformance.golden.document import Golden
    from ..targets.web_host.serving.packages import Package

    kinds = (
        Reflection, FramePlan, Package, Golden, Corpus, CorpusIndex, EquationGraphs, Functions,
    )  # fmt: skip
    return dict(zip(DOCUMENTS, kinds, strict=True))
