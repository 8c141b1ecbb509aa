"""The command line: ``burnish COMMAND``, one file in ``commands`` for each command.

Exit codes: 0 all is well, 1 the input has errors, 2 the command line itself makes no sense, 130
interrupted. Starting fast is a feature: what was compiled before, and has not changed since, is
written again before anything of click or the compiler is loaded.
"""

from __future__ import annotations

import gc
import os
import sys

from .commands.results import answer, ask
from .commands.terminal import FAILED, INTERRUPTED, flushed, show_everything

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .commands.results import Question


def main() -> None:
    """Run the command line that the process was started with."""
    code = flushed(_exit_code(sys.argv[1:]))
    if code:
        sys.exit(code)


def _exit_code(arguments: list[str]) -> int:
    """Run a command line; returns its exit code."""
    try:
        question = ask(arguments)
        if question is not None and answer(question):
            return 0
        # A command makes far more objects than it drops: looking for circles of dropped ones often
        # takes a twentieth of a short compile.
        from .garbage import SELDOM

        gc.set_threshold(*SELDOM)
        succeeded = _compiled(arguments, question)
        if succeeded is not None:
            return 0 if succeeded else FAILED
        if os.getpid() == 1:
            _heed_termination()
        from .commands.group import burnish

        burnish.main(arguments, obj=question)
    except KeyboardInterrupt:
        return INTERRUPTED
    except BrokenPipeError:
        return FAILED  # A reader that has left, as `head` does: nobody is told, as click does it.
    except SystemExit as ended:
        return ended.code if isinstance(ended.code, int) else FAILED
    finally:
        # The process ends, and all of its memory with it. What is frozen, Python need not look
        # through for garbage first, which would take longer than a short compile's passes. But
        # OpenImageIO lists all of its objects on the error output that are there at the end.
        if "OpenImageIO" not in sys.modules:
            gc.freeze()
    return 0


def _heed_termination() -> None:
    """Have SIGTERM end the process as Ctrl-C does, if it is the first one, as in a container.

    The kernel ignores it there unless somebody listens, and ``--watch`` would run for ever.
    """
    import signal

    signal.signal(signal.SIGTERM, signal.default_int_handler)


def _compiled(arguments: list[str], question: Question | None) -> bool | None:
    """Whether a plain ``burnish compile`` has succeeded; ``None`` where click has to see to it."""
    from .commands.compile_options import plain_request

    request = plain_request(arguments)
    if request is None:
        return None
    from .commands.compilation import succeeds

    show_everything()
    try:
        return succeeds(request, question)
    except BrokenPipeError:
        raise
    except OSError:
        return None  # Once more, by the way on which all commands tell of what went wrong.
