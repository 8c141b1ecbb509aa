"""The first words of declarations, folds and foreign files, and the forms of declarations.

For members, ``ast/member_kinds.py`` has them.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import get_args

from .ast import FoldWord

_RECORD = "a {} is `{} Name : Base + Mixin {{ … }}`, where the base and the mixins are optional"

DECLARATIONS: Mapping[str, str] = MappingProxyType(
    {
        **{kind: _RECORD.format(kind, kind) for kind in ("light", "kernel", "frame")},
        "material": "a material is `material Name : Base + Mixin by Pass { … }`, where the base, "
        "the mixins and the pass are optional",
        "pass": "a pass is `pass Name : Base blend mode { … }`; the base and the mode are optional",
        "abstract": "a material for others to complete is `abstract material Name : Base { … }`",
        "mixin": "a mixin is `mixin Name { … }`, or `mixin Name for light { … }`, `… for pass`",
        "fn": "a function is `fn name(x: float, y: vec3) -> float = expression`, or, with names "
        "for parts of it, `fn name(x: float) -> float = part * part where { part = expression }`",
        "term": "a term is `term name(k: rgb) -> rgb per light = expression`, or, with names for "
        "parts of it, `term name(k: rgb) per light = k * part where { part = expression }`",
        "rig": "a rig is `rig Name { one : Kind  four : Kind[4] { slot = value } }`",
        "struct": "a structure is `struct Name { member : type, … }`",
        "enum": "an enumeration is `enum Name { first, second }`",
        "extern": "a block that the host owns is "
        "`extern block Name per frame at group 0, binding 3 { member : type at 16 }`",
        "space": "a space is `space name`",
        "import": "imports are `import folder.file`, `import folder.file.{name}` or "
        '`import "folder/file.burnish"`',
    }
)
"""The form of each declaration, by the word that it begins with."""

FOLDS: Mapping[str, str] = MappingProxyType(
    {**dict.fromkeys(get_args(FoldWord), "in"), "iterate": "from"}
)
"""Words that begin a fold, each with the word that follows the variable after it.

Without that, as in ``sum * 2``, they are names.
"""

FOREIGN_FILES: Mapping[str, str] = MappingProxyType(
    {"<": "this looks like XML", "{": "this looks like JSON"}
)
"""Other kinds of files, by their first character, with which no declaration begins."""
