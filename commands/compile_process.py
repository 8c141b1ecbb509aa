"""A process that compiles the files which ``compiled_files.py`` hands to it."""

from __future__ import annotations

import os
import pickle

from ..targets.toolchain.pipe import Packet, serve
from .compile_options import CompileRequest
from .compiled_files import TIME_LIMIT, compiled


def _answer(question: Packet) -> Packet:
    here: str
    request: CompileRequest
    here, request = pickle.loads(question.data)
    os.chdir(here)
    return Packet({}, pickle.dumps(compiled(request)))


if __name__ == "__main__":
    serve(_answer, 1.5 * TIME_LIMIT)
