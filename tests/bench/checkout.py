"""Checkouts to measure: this one, and perhaps another to compare it with in the same run."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

WORKER = Path(__file__).parent / "worker.py"


@dataclass(frozen=True, slots=True)
class Checkout:
    """The root folder of a checkout, whose compiler is measured with the Python that runs this."""

    name: str
    """The checkout's name in the tables."""
    root: Path

    @contextmanager
    def environment(self) -> Iterator[Mapping[str, str]]:
        """Variables under which Python imports ``burnish`` from this checkout.

        A folder that is searched first holds the checkout under the package's name. Byte code is
        cached as for any user.
        """
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "burnish").symlink_to(self.root, target_is_directory=True)
            kept = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
            yield kept | {"PYTHONPATH": folder}

    @contextmanager
    def worker(self) -> Iterator[Worker]:
        """A process that compiles with this checkout's compiler."""
        with (
            self.environment() as environment,
            subprocess.Popen(
                [sys.executable, "-P", str(WORKER)],
                env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True,
            ) as process,
        ):  # fmt: skip
            try:
                yield Worker(process)
            finally:
                process.kill()


class Worker:
    """A process that compiles on request; see ``worker.py``."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self._process = process

    def compile(
        self,
        path: Path,
        targets: Sequence[str] = ("hlsl", "glsl", "wgsl"),
        *,
        reflect: bool = True,
        enough: float = 0.3,
        runs: int = 7,
        limit: float = 600.0,
        remember: bool = False,
        check: bool = False,
        times: int = 1,
    ) -> dict[str, Any] | None:
        """The best times of the phases of compiling a file, and the codes of its errors.

        The file is compiled until ``enough`` seconds have been spent, at most ``runs`` times. With
        ``remember``, the process uses what it has kept of earlier requests that said so, too. With
        ``check``, the file is only checked. Each run does it ``times`` times, of which the mean
        counts. ``None`` if the process ended over it, as it does after ``limit`` seconds of CPU
        time.
        """
        request = {
            "path": str(path), "targets": list(targets), "reflect": reflect,
            "enough": enough, "runs": runs, "limit": limit,
            "remember": remember, "check": check, "times": times,
        }  # fmt: skip
        assert self._process.stdin is not None
        assert self._process.stdout is not None
        try:
            self._process.stdin.write(json.dumps(request) + "\n")
            self._process.stdin.flush()
        except BrokenPipeError:
            return None
        line = self._process.stdout.readline()
        return cast(dict[str, Any], json.loads(line)) if line else None
