"""The command line: ``burnish COMMAND``, one file in ``commands`` for each command.

Exit codes: 0 all is well, 1 the input has errors, 2 the command line itself makes no sense, 130
interrupted, 143 asked to end by SIGTERM, 129 by SIGHUP. Starting fast is a feature: what was
compiled before, and has not changed since, is written again before anything of click or the
compiler is loaded.
"""

from __future__ import annotations

import gc
import os
import sys
import time

from .results import answer, ask
from .terminal import BY_SIGNAL, FAILED, asked_to_end, flushed, interrupted, show_everything

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .results import Question

PATIENCE = 1.0
"""The seconds that threads may take to end after an interruption."""


def main() -> None:
    """Run the command line that the process was started with."""
    code = flushed(_exit_code(sys.argv[1:]))
    if code > BY_SIGNAL:
        _leave_threads(code)
    if code:
        sys.exit(code)


def _exit_code(arguments: list[str]) -> int:
    """Run a command line; returns its exit code."""
    try:
        question = ask(arguments)
        if question is not None and answer(question):
            return 0
        from ..support.garbage import SELDOM
        from ..support.stack import with_room
        from .waking import wake_on_signals

        # A command makes far more objects than it drops: looking for circles of dropped ones often
        # takes a twentieth of a short compile.
        gc.set_threshold(*SELDOM)
        _heed_termination()
        wake_on_signals()
        succeeded = with_room(_compiled, arguments, question)
        if succeeded is not None:
            return 0 if succeeded else FAILED
        from .group import burnish

        with_room(burnish.main, arguments, obj=question)
    except KeyboardInterrupt:
        return interrupted()
    except BrokenPipeError:
        return FAILED  # A reader that has left, as `head` does: nobody is told, as click does it.
    except SystemExit as ended:
        return ended.code if isinstance(ended.code, int) else FAILED
    finally:
        # The process ends, and all of its memory with it. Python does not look for garbage among
        # frozen objects first, which would take longer than a short compile's passes. But
        # OpenImageIO lists all of its objects on the error output that are there at the end.
        if "OpenImageIO" not in sys.modules:
            gc.freeze()
    return 0


def _heed_termination() -> None:
    """Let SIGTERM and SIGHUP end the process like Ctrl-C, with everything that it has started.

    A process that ignores them, as under nohup, goes on to do so. But the first process, as in a
    container, has to listen to SIGTERM: the kernel ignores it there otherwise, and ``--watch``
    would run for ever.
    """
    import signal

    for name in ("SIGTERM", "SIGHUP"):
        number = getattr(signal, name, None)  # Windows has no SIGHUP.
        is_first = os.getpid() == 1 and name == "SIGTERM"
        if number and (is_first or signal.getsignal(number) == signal.SIG_DFL):
            signal.signal(number, asked_to_end)


def _leave_threads(code: int) -> None:
    """End the process after an interruption, even if some threads still compute something.

    Those that have waited for a compiler or a driver end at once, and remove their files.
    """
    import threading

    threads = [each for each in threading.enumerate() if each is not threading.current_thread()]
    # A thread that was interrupted just as it started has no identifier, and nothing to do.
    others = [each for each in threads if each.ident is not None and not each.daemon]
    end = time.monotonic() + PATIENCE
    for thread in others:
        thread.join(max(0.0, end - time.monotonic()))
    if any(thread.is_alive() for thread in others):
        os._exit(code)


def _compiled(arguments: list[str], question: Question | None) -> bool | None:
    """Run a plain ``burnish compile``: True if it succeeded, ``None`` if click has to run it."""
    from .compile_options import plain_request

    request = plain_request(arguments)
    if request is None or request.misfit:
        return None
    from .compilation import succeeds

    show_everything()
    try:
        return succeeds(request, question)
    except BrokenPipeError:
        raise
    except OSError:
        return None  # Once more, by the way on which all commands tell of what went wrong.
