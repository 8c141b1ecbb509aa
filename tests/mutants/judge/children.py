"""Runs a function in a process of its own, which has loaded everything that this one has."""

from __future__ import annotations

import json
import os
import select
import signal
import traceback
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any

Answer = dict[str, Any]
"""An answer, which is printed as JSON."""


def in_child(work: Callable[[], Answer], limit: float) -> Answer:
    """The result of a function in a process of its own, which may take ``limit`` seconds."""
    source, sink = os.pipe()
    child = os.fork()
    if not child:
        os.setsid()
        os.close(source)
        os.dup2(2, 1)  # the answer is all that this program may print
        try:
            answer = work()
        except Exception as error:
            where = traceback.extract_tb(error.__traceback__)[-1]
            place = f"{Path(where.filename).name}:{where.lineno}"
            answer = {"verdict": "caught", "by": f"{type(error).__name__} at {place}"}
        with suppress(OSError), os.fdopen(sink, "w") as stream:  # Who asked may be gone.
            json.dump(answer, stream)
        os._exit(0)
    os.close(sink)
    data = b""
    with os.fdopen(source, "rb", buffering=0) as stream:
        while select.select([stream], [], [], limit)[0] and (part := stream.read(1 << 20)):
            data += part
    with suppress(ProcessLookupError):
        os.killpg(child, signal.SIGKILL)
    os.waitpid(child, 0)
    return json.loads(data) if data else {"verdict": "caught", "by": "it takes too long, or ends"}
