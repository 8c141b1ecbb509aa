"""The commands that installers run, each with a limit; ``install.py`` and ``unstable.py`` use them.

Nothing waits for ever: neither for a network that does not answer, nor for a program that hangs.
"""

from __future__ import annotations

import os
import signal
import subprocess
from collections.abc import Mapping
from contextlib import suppress
from types import MappingProxyType

from .surroundings import environment as isolated
from .surroundings import which
from .tools import cache_folder

PATIENCE = 1800.0
"""The seconds that one command may take, and that one run waits for another. On a slow machine,
cargo takes ten minutes for naga."""
GRACE = 10.0
"""The seconds that a command may take to end once it was asked to; then it is killed."""
NETWORK_SECONDS = 60
"""The seconds that a download may stand still before it is tried again or given up."""
NETWORK_SETTINGS = {
    "CARGO_HTTP_TIMEOUT": f"{NETWORK_SECONDS}",
    "NPM_CONFIG_FETCH_TIMEOUT": f"{NETWORK_SECONDS * 1000}",
    "PIP_DEFAULT_TIMEOUT": f"{NETWORK_SECONDS}",
}
"""Variables that set this time for programs that have one; they are not set if somebody has set
them."""


class InstallError(Exception):
    """A tool could not be installed; the text says why, and what to do."""


def run_command(*command: str, environment: Mapping[str, str] = MappingProxyType({})) -> str:
    """Run a command of an installer; print its output only if it fails. Returns the output."""
    print("  " + " ".join(command), flush=True)
    program = which(command[0])
    if program is None:
        raise InstallError(f"it needs {command[0]}, which is not on PATH")
    process = subprocess.Popen(
        (program, *command[1:]),
        cwd=cache_folder(),  # Many of them read settings from the current folder and those above.
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        env={
            **NETWORK_SETTINGS,
            **isolated(),
            "DEBIAN_FRONTEND": "noninteractive",
            **environment,
        },
        start_new_session=True,
    )
    try:
        output, _ = process.communicate(timeout=PATIENCE)
    except subprocess.TimeoutExpired:
        said = _ended(process)
        raise InstallError(
            f"{command[0]} did not end within {minutes(PATIENCE)}, and was stopped: does the "
            f"network answer?\n{said}"
        ) from None
    except BaseException:
        _ended(process)
        raise
    if process.returncode != 0:
        raise InstallError(f"{command[0]} ended with {process.returncode}:\n{output}")
    return output


def _ended(process: subprocess.Popen[str]) -> str:
    """Ask a command and its children to end, or kill them; returns their output."""
    for number in (signal.SIGTERM, signal.SIGKILL):
        with suppress(ProcessLookupError):
            os.killpg(process.pid, number)
        with suppress(subprocess.TimeoutExpired):
            return process.communicate(timeout=GRACE)[0]
    return ""


def minutes(seconds: float) -> str:
    return f"{seconds / 60:g} minutes"
