"""Tells the document of functions about the text for one profile."""

from __future__ import annotations

from ...compiler.documents.functions import (
    ArgumentTextRow,
    FunctionsBackendRow,
    FunctionTextRow,
)
from ..description.shading_language import Language
from .functions import EmittedSignature, FunctionEmission


def function_backend_row(
    language: Language, emission: FunctionEmission, file: str
) -> FunctionsBackendRow:
    """The row of one text, which is written to ``file``."""
    return FunctionsBackendRow(
        language=language.name,
        file=file,
        requires=emission.requires,
        helpers=tuple(part.name for part in emission.helpers),
        functions={each.name: _function(each) for each in emission.functions},
    )


def _function(signature: EmittedSignature) -> FunctionTextRow:
    return FunctionTextRow(
        identifier=signature.part.name,
        returns=signature.returns,
        members=signature.members,
        arguments=tuple(
            ArgumentTextRow(identifier=each.name, type=each.type, kind=each.kind, given=each.given)
            for each in signature.arguments
        ),
        needs=signature.part.needs,
    )
