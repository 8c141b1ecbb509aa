"""The hook, run by pre-commit itself in a repository of its own, from a clone of this one."""

from __future__ import annotations

import sys
from pathlib import Path
from subprocess import CompletedProcess

from ..suite.processes import LIMIT, run
from .kit import BROKEN, PLACE, environment, project
from .offline import copied, offline

PERSON = ("-c", "user.name=A Person", "-c", "user.email=person@example.org")


def git(folder: Path, *words: str) -> str:
    done = run(["git", *PERSON, *words], cwd=folder, env=environment(), check=True)
    return done.stdout.strip()


def committed(folder: Path) -> str:
    """Make a folder a repository; returns the name of its commit."""
    git(folder, "init", "--quiet", ".")
    git(folder, "add", "--all")
    git(folder, "commit", "--quiet", "--message", "All of it")
    return git(folder, "rev-parse", "HEAD")


def hooks(folder: Path, place: Path) -> CompletedProcess[str]:
    """What pre-commit says of the files that are about to be committed."""
    env = offline(place, PRE_COMMIT_HOME=str(place / "home"))
    return run([sys.executable, "-m", "pre_commit", "run"], cwd=folder, env=env, limit=2 * LIMIT)


def test_the_hook(tmp_path: Path) -> None:
    source = copied(tmp_path / "burnish")
    commit = committed(source)
    folder = project("pre-commit", tmp_path / "project")
    config = folder / ".pre-commit-config.yaml"
    text = config.read_text().replace("https://github.com/OWNER/burnish", str(source))
    config.write_text(text.replace("rev: main", f"rev: {commit}"))
    committed(folder)

    (folder / "notes.txt").write_text("nothing for the hook")
    git(folder, "add", "--all")
    assert "(no files to check)Skipped" in hooks(folder, tmp_path).stdout

    (folder / "materials" / "right.burnish").write_text("material Right { color = #ffffff }\n")
    git(folder, "add", "--all")
    done = hooks(folder, tmp_path)
    assert (done.returncode, "Passed" in done.stdout) == (0, True), done

    # One that imports another file, and one with a mistake; the order of files is left open.
    plastic = folder / "materials" / "plastic.burnish"
    plastic.write_text(f"{plastic.read_text()}\n// Changed.\n")
    (folder / "materials" / "wrong.burnish").write_text(BROKEN)
    git(folder, "add", "--all")
    done = hooks(folder, tmp_path)
    assert done.returncode == 1
    (told,) = (line for line in done.stdout.splitlines() if ": error: " in line)
    assert told.startswith(f"materials/wrong.burnish{PLACE}")
