"""The tests that ``make quick`` leaves out: a plugin of pytest that adds the option ``--quick``.

Quick tests compile in the process of the tests. Left out are folders and modules that mostly start
programs (drivers, downstream compilers, the command line) and those that compile huge or random
programs. They find what a change breaks in few places, and take nine tenths of the time.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import pytest

TESTS = Path(__file__).parents[1]

_DRAW = "draw with every driver"
_COMPILERS = "run downstream compilers"
_COMMANDS = "start the command line again and again"
_PRECISE = "compute thousands of numbers to many places"
_LARGE = "compile huge programs, or many random ones"

LEFT_OUT: Mapping[str, str] = {
    "bench/test_aims.py": _COMMANDS,
    "builtins/test_properties.py": _LARGE,
    "cli/test_build_ninja.py": _COMMANDS,
    "cli/test_commands.py": _COMMANDS,
    "cli/test_conform.py": _DRAW,
    "cli/test_conform_ended.py": _DRAW,
    "cli/test_conform_explain.py": _DRAW,
    "cli/test_endings.py": _COMMANDS,
    "cli/test_farm.py": _DRAW,
    "cli/test_gallery.py": _DRAW,
    "cli/test_gallery_hostile.py": _DRAW,
    "cli/test_golden.py": _DRAW,
    "cli/test_graph.py": _LARGE,
    "cli/test_hostile_outputs.py": _COMMANDS,
    "cli/test_hostile_sources.py": _COMMANDS,
    "cli/test_helping.py": _DRAW,
    "cli/test_judges.py": _DRAW,
    "cli/test_kills.py": _COMMANDS,
    "cli/test_names.py": _COMPILERS,
    "cli/test_odd_environments.py": _COMMANDS,
    "cli/test_output.py": _COMMANDS,
    "cli/test_progress.py": _DRAW,
    "cli/test_render.py": _DRAW,
    "cli/test_render_errors.py": _DRAW,
    "cli/test_results_cache.py": _COMMANDS,
    "cli/test_traps.py": _DRAW,
    "cli/test_unchanged.py": _COMMANDS,
    "cli/test_validate.py": _COMPILERS,
    "comparers": _COMPILERS,
    "conformance": _DRAW,
    "corpus": _PRECISE,
    "diagnostics/test_growth.py": _LARGE,
    "equivalence/test_soundness.py": _LARGE,
    "examples/test_accepted.py": _COMPILERS,
    "examples/test_own_materials.py": _COMPILERS,
    "fuzz": _LARGE,
    "integrations": "run other build systems",
    "judging/test_assertions.py": "start pytest again and again",
    "layout/test_compilers.py": _COMPILERS,
    "library/test_mutants.py": _LARGE,
    "materialx/test_bounds.py": _DRAW,
    "materialx/test_by_hand.py": _DRAW,
    "materialx/test_checker.py": _DRAW,
    "materialx/test_documents.py": _DRAW,
    "materialx/test_suite.py": _DRAW,
    "mistakes/test_edits.py": _LARGE,
    "mutants": _DRAW,
    "passes/test_expansions.py": _LARGE,
    "passes/test_scale.py": _LARGE,
    "passes/test_work.py": _LARGE,
    "runner": _DRAW,
    "semantics/test_depth.py": _LARGE,
    "semantics/test_new_member_kind.py": _COMMANDS,
    "semantics/test_signatures.py": _LARGE,
    "semantics/test_transcripts.py": _LARGE,
    "semantics/test_work.py": _LARGE,
    "structure/test_generated.py": _COMMANDS,
    "structure/test_wheel.py": "builds a wheel",
    "suite": "start pytest again and again",
    "targets/test_accepted.py": _COMPILERS,
    "targets/test_branches.py": _COMPILERS,
    "targets/test_capabilities.py": _COMPILERS,
    "targets/test_chosen_literals.py": _COMPILERS,
    "targets/test_constant_operands.py": _COMPILERS,
    "targets/test_every_name.py": _COMPILERS,
    "targets/test_metal.py": _COMPILERS,
    "targets/test_operands_of_reads.py": _COMPILERS,
    "targets/test_own_words.py": _LARGE,
    "tolerances/test_experiment.py": _DRAW,
    "toolchain": _COMPILERS,
    "view/test_folder.py": _DRAW,
    "view/test_hostile_requests.py": _COMMANDS,
    "view/test_memory.py": _COMMANDS,
    "view/test_modules.py": _COMPILERS,
    "view/test_outputs.py": _DRAW,
    "view/test_page.py": _DRAW,
    "view/test_pictures.py": _DRAW,
    "view/test_server.py": _COMMANDS,
    "web_host/test_frames.py": _DRAW,
    "web_host/test_modules.py": _COMPILERS,
    "web_host/test_page.py": _DRAW,
    "web_host/test_random_programs.py": _DRAW,
}
"""The folders and modules that are left out, and what their tests do."""


def pytest_addoption(parser: pytest.Parser) -> None:
    """Called when pytest starts."""
    parser.addoption("--quick", action="store_true", help="leave out tests that take long")


def pytest_ignore_collect(collection_path: Path, config: pytest.Config) -> bool | None:
    """Called for each folder and each module, before it is imported; ``None`` is no opinion."""
    if config.getoption("--quick") and is_left_out(collection_path):
        return True
    return None


def is_left_out(path: Path) -> bool:
    """True if a folder or a module is left out."""
    return path.is_relative_to(TESTS) and path.relative_to(TESTS).as_posix() in LEFT_OUT
