"""The action for GitHub: its file is read, and its scripts are run as GitHub's runner does.

A runner replaces `${{ … }}`, sets variables, and gives each script to the shell that the step
names. The step that has GitHub's own action choose a Python is not run.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Mapping
from pathlib import Path
from subprocess import CompletedProcess
from typing import Any

import pytest
import yaml

from ..docs.kit import ROOT
from ..suite.processes import LIMIT, run
from .kit import BROKEN, WARNED, environment, project
from .offline import copied, offline

ACTION: dict[str, Any] = yaml.safe_load((ROOT / "action.yml").read_text("utf-8"))
STEPS: list[dict[str, Any]] = ACTION["runs"]["steps"]
CHECK = STEPS[-1]
INPUTS: Mapping[str, str] = {name: row["default"] for name, row in ACTION["inputs"].items()}
SHELL = ("bash", "--noprofile", "--norc", "-e", "-o", "pipefail")
"""The command of `shell: bash`, as GitHub documents it."""
_EXPRESSION = re.compile(r"\$\{\{ *inputs\.([\w-]+) *\}\}")


def ran(
    step: Mapping[str, Any], folder: Path, env: Mapping[str, str], *, action: Path = ROOT,
    **given: str,
) -> CompletedProcess[str]:  # fmt: skip
    """Run a step in the folder of a checkout, with some inputs."""
    inputs = {**INPUTS, **given}

    def evaluated(text: str) -> str:
        return _EXPRESSION.sub(lambda found: inputs[found[1]], text)

    assert step["shell"] == "bash"
    own = {name: evaluated(text) for name, text in step.get("env", {}).items()}
    variables = {**env, **own, "GITHUB_ACTION_PATH": str(action), "GITHUB_ACTIONS": "true"}
    script = folder.parent / "script.sh"
    script.write_text(evaluated(step["run"]))
    return run([*SHELL, str(script)], cwd=folder, env=variables, limit=2 * LIMIT)


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return project("github", tmp_path / "checkout")


def test_its_file() -> None:
    """A composite action names the shell of each script; the page has all inputs."""
    assert ACTION["runs"]["using"] == "composite"
    assert [step.get("uses") for step in STEPS] == ["actions/setup-python@v5", None, None]
    page = (ROOT / "docs" / "integrations.md").read_text("utf-8")
    assert [name for name in INPUTS if f"| `{name}` |" not in page] == []
    assert all(row["description"] for row in ACTION["inputs"].values())


def test_the_workflow_of_the_page(folder: Path) -> None:
    workflow = yaml.safe_load((folder / ".github" / "workflows" / "materials.yml").read_text())
    (*_, step) = workflow["jobs"]["materials"]["steps"]
    assert set(step["with"]) <= set(INPUTS)
    (folder / "materials" / "shared" / "a b.burnish").write_text(BROKEN)
    (folder / "wrong.burnish").write_text(BROKEN)  # None of its files.
    done = ran(CHECK, folder, environment(), **step["with"])
    assert done.returncode == 1
    assert done.stdout == "Checking 4 files.\n"
    (told,) = done.stderr.splitlines()
    place = "file=materials/shared/a b.burnish,line=1,col=28,endLine=1,endColumn=31"
    assert told.startswith(f"::error {place},title=B0201::unknown function `tnt`")


def test_all_files_by_default(folder: Path) -> None:
    (folder / "warned.burnish").write_text(WARNED)
    done = ran(CHECK, folder, environment())
    assert (done.returncode, done.stdout) == (0, "Checking 4 files.\n")
    assert done.stderr.startswith("::warning file=warned.burnish,line=1,col=20,")


def test_options_are_words(folder: Path) -> None:
    done = ran(CHECK, folder, environment(), options="--rig  Night")
    assert done.returncode == 1
    assert "unknown rig `Night`" in done.stderr


def test_no_files(folder: Path) -> None:
    done = ran(CHECK, folder, environment(), files="models/*.burnish\nshaders/*.burnish\n")
    assert done.returncode == 1
    assert "::error title=Burnish::no file has a name like models/*.burnish or" in done.stdout


@pytest.mark.parametrize("text", ["$(touch made)", "`touch made`", "a;touch made", '"; touch made'])
def test_inputs_are_no_commands(text: str, folder: Path) -> None:
    ran(CHECK, folder, environment(), files=text, options=text)
    assert not (folder / "made").exists()


def test_it_installs_burnish(folder: Path, tmp_path: Path) -> None:
    """From a checkout of the action, into the Python that comes first."""
    action = copied(tmp_path / "action")
    python = tmp_path / "python"
    run([sys.executable, "-m", "virtualenv", "--quiet", str(python)], check=True)
    env = dict(offline(tmp_path))
    env["PATH"] = f"{python / 'bin'}:{env['PATH']}"
    done = ran(STEPS[1], folder, env, action=action)
    assert done.returncode == 0, done
    (folder / "materials" / "plastic.burnish").write_text(BROKEN)
    done = ran(CHECK, folder, env, action=action)
    assert "::error file=materials/plastic.burnish,line=1,col=28," in done.stderr
    where = run(["python", "-c", "import burnish; print(burnish.__file__)"], cwd=folder, env=env)
    assert where.stdout.startswith(str(python))
