"""A process that compiles the files which ``many_files.py`` hands to it."""

from __future__ import annotations

import os
import pickle

from ..targets.toolchain.pipe import Packet, serve
from .compile_options import CompileRequest
from .kept_files import KeptFiles
from .many_files import TIME_LIMIT, compiled_and_kept


def _answer(question: Packet) -> Packet:
    here: str
    request: CompileRequest
    kept: KeptFiles | None
    here, request, kept = pickle.loads(question.data)
    os.chdir(here)
    return Packet({}, pickle.dumps(compiled_and_kept(request, kept)))


if __name__ == "__main__":
    serve(_answer, 1.5 * TIME_LIMIT)
