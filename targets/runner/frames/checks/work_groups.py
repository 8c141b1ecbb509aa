"""Checks the work group of a reflection by the text of its kernel, which declares it as well.

A host computes from the reflection how many work groups it runs. If the text has larger or smaller
ones, it writes more or fewer texels than there are, and no driver says a word.
"""

from __future__ import annotations

import re
from collections.abc import Mapping

from .....compiler.ir.kernel import WorkGroup
from .rows import PlanError

_DECLARED: Mapping[str, re.Pattern[str]] = {
    "glsl": re.compile(
        r"^layout\(local_size_x = ([0-9]+)(?:, local_size_y = ([0-9]+))?"
        r"(?:, local_size_z = ([0-9]+))?\) in;\r?$",
        re.MULTILINE,
    ),
    "hlsl": re.compile(r"^\[numthreads\(([0-9]+), ([0-9]+), ([0-9]+)\)\]\r?$", re.MULTILINE),
    "wgsl": re.compile(
        r"^@compute @workgroup_size\(([0-9]+)(?:, ([0-9]+))?(?:, ([0-9]+))?\)\r?$", re.MULTILINE
    ),
}
"""The line with which a text of each target declares its work group, as Burnish emits it."""


def check_work_group(
    where: str, group: WorkGroup | None, target: str, text: str, *, file: str
) -> None:
    """Raise ``PlanError`` unless the text of a kernel declares the work group of its reflection."""
    found = [tuple(int(side or 1) for side in sides) for sides in _DECLARED[target].findall(text)]
    if len(found) != 1:
        raise PlanError(f"{where}: `{file}` has {len(found)} lines that declare its work group")
    if found[0] != group:
        declared, said = _shown(found[0]), "none" if group is None else _shown(group)
        raise PlanError(
            f"{where}: its work group is {said}, and `{file}` declares {declared}: compile the "
            "source again"
        )


def _shown(group: tuple[int, ...]) -> str:
    return " x ".join(map(str, group))
