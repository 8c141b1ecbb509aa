"""Documents as the texts of files."""

from __future__ import annotations

import json

from hypothesis import given
from hypothesis import strategies as st

from burnish.compiler.documents.writing import to_text

_TEXTS = st.text(st.characters(), max_size=5)
_PLAIN = st.none() | st.booleans() | st.integers() | st.floats() | _TEXTS
_DATA = st.recursive(_PLAIN, lambda some: st.lists(some) | st.dictionaries(_TEXTS, some))


@given(_DATA)
def test_texts_are_those_of_the_json_module(data: object) -> None:
    assert to_text(data) == json.dumps(data, indent=2, ensure_ascii=False) + "\n"
