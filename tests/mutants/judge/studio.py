"""The codes that compilers make of a material's texts, and the judgement of its pictures."""

from __future__ import annotations

import re
import struct
from collections.abc import Iterator, Mapping
from contextlib import ExitStack
from typing import TYPE_CHECKING

from burnish.support.frozen import cached_property

from .behaviour import (
    DRAWN,
    Name,
    compiled,
    description,
    digest,
    label,
    lacks,
    shaders_of,
    texts,
)

if TYPE_CHECKING:
    from burnish.targets.runner.runner import Runner
    from burnish.targets.toolchain import Toolchain

    from .behaviour import Judged

NOTICED = ("differs", "failed")
SMALL = (36, 28)
"""The size of the pictures that are drawn first, as most errors show in a small one."""
PICTURES = 16
"""The most materials and routes that are drawn: first each material on its first route."""
LARGE_PICTURES = 2
"""The number of these of which large pictures are drawn if small ones are right."""


class Studio(ExitStack):
    """Compilers and drivers, which are started when something is to be drawn."""

    drawn = 0
    """The number of pictures that were drawn."""

    @cached_property
    def _toolchain(self) -> Toolchain:
        from burnish.targets.toolchain import Toolchain

        return self.enter_context(Toolchain())

    @cached_property
    def _runner(self) -> Runner:
        from burnish.targets.runner.routes import ROUTES
        from burnish.targets.runner.runner import Runner

        return self.enter_context(Runner([ROUTES[name] for name in DRAWN]))

    def code(self, subject: Judged, route: str) -> object:
        """The compiled codes of a material's texts, or a frame's, without the names in them."""
        from burnish.targets.runner.codes import compile_one
        from burnish.targets.runner.routes import ROUTES

        return [
            (code.entry, _plain(code.text), _nameless(code.spirv))
            for shader in shaders_of(subject)
            for code in compile_one(ROUTES[route], shader.files, self._toolchain).stages.values()
        ]

    def wrong(self, name: Name, subject: Judged, route: str, known: Mapping[str, str]) -> str:
        """The error in a picture; empty if there is none.

        It is also empty if no picture is drawn, because its code is known or because there are
        enough pictures already.
        """
        from burnish.targets.conformance.cases import SIZE
        from burnish.targets.conformance.conform import conform
        from burnish.targets.runner.codes import CodeError
        from burnish.targets.runner.routes import ROUTES

        if self.drawn >= PICTURES:
            return ""
        place, row = f"{label(name)}, {route}", ROUTES[route]
        if reason := lacks(subject, row):
            return f"{place}: {reason}"
        try:
            code = self.code(subject, route)
        except CodeError:
            return f"{place}: failed"
        if known.get(f"{place}: code") == digest((code, description(subject))):
            return ""
        self.drawn += 1
        for size in (SMALL, SIZE)[: 1 + (self.drawn <= LARGE_PICTURES)]:
            subjects = [(place, subject)]
            (found,) = conform(
                subjects, [row], self._runner, self._toolchain, size=size, brief=True
            )
            if found.status in NOTICED:
                return f"{place}: {found.status}"
        return ""


def codes_of(name: Name, studio: Studio) -> Iterator[tuple[str, str]]:
    """Digests of the code of a material or a frame, and of its description, on each route."""
    subject = compiled(name)
    for route, _ in texts(subject):
        code = studio.code(subject, route)
        yield f"{label(name)}, {route}: code", digest((code, description(subject)))


def _plain(text: str) -> str:
    """A text without comments, and without the white space that only arranges it."""
    text = re.sub(r"//[^\n]*", "", text)
    return re.sub(r"\s*([^\w\s])\s*", r"\1", text)


NAMES = {3, 4, 5, 6, 7, 8, 317, 330}
"""The instructions of SPIR-V that only name things: sources, names, lines, and modules."""


def _nameless(module: bytes) -> str:
    """A module of SPIR-V without the instructions that only name things."""
    words = [word for (word,) in struct.iter_unpack("<I", module)]
    kept, at = words[:5], 5
    while at < len(words):
        length = max(1, words[at] >> 16)
        if words[at] & 0xFFFF not in NAMES:
            kept += words[at : at + length]
        at += length
    return repr(kept)
