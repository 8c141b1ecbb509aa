"""The locks of Python packages have digests of all that is installed, and fit what is wanted."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterator
from pathlib import Path

import pytest
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

ROOT = Path(__file__).parents[2]
LOCKS = {extra: ROOT / ".ci" / f"{extra}.txt" for extra in ("render", "dev", "bench")}
"""The lock of each extra."""


def _locked(lock: Path) -> list[tuple[Requirement, list[str]]]:
    """The packages of a lock with their digests."""
    joined = lock.read_text("utf-8").replace("\\\n", " ")
    lines = [line for line in joined.splitlines() if not line.lstrip().startswith("#")]
    return [
        (Requirement(line.partition(" --hash")[0].strip()), re.findall(r"--hash=(\S+)", line))
        for line in lines
    ]


def _wanted(extra: str) -> Iterator[Requirement]:
    """The requirements of a package with this extra, and of the extras that it contains."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["project"]
    waiting, seen = [extra], {extra}
    yield from map(Requirement, project["dependencies"])
    while waiting:
        for text in project["optional-dependencies"][waiting.pop()]:
            wanted = Requirement(text)
            if wanted.name != project["name"]:
                yield wanted
            waiting += wanted.extras - seen
            seen |= wanted.extras


@pytest.mark.parametrize("extra", LOCKS)
def test_every_package_has_one_version_and_its_digests(extra: str) -> None:
    packages = _locked(LOCKS[extra])
    assert len(packages) > 5
    for package, digests in packages:
        assert str(package.specifier).startswith("=="), package
        assert digests, package
        assert all(re.fullmatch("sha256:[0-9a-f]{64}", digest) for digest in digests), package


@pytest.mark.parametrize("extra", LOCKS)
def test_the_versions_are_those_that_are_wanted(extra: str) -> None:
    packages = _locked(LOCKS[extra])
    for wanted in _wanted(extra):
        found = [
            p for p, _ in packages if canonicalize_name(p.name) == canonicalize_name(wanted.name)
        ]
        assert found, f"{wanted} is not in the lock: `make locks`"
        for package in found:
            (pinned,) = package.specifier
            assert pinned.version in wanted.specifier, f"{package}, but {wanted}: `make locks`"


@pytest.mark.parametrize("extra", ["render", "dev"])
def test_what_builds_the_package_is_in_the_lock(extra: str) -> None:
    system = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))["build-system"]
    names = {canonicalize_name(package.name) for package, _ in _locked(LOCKS[extra])}
    assert {canonicalize_name(Requirement(text).name) for text in system["requires"]} <= names


def test_what_is_in_two_locks_has_one_version() -> None:
    """The bench's packages are installed beside those of development."""
    known = {(p.name, str(p.marker)): p.specifier for p, _ in _locked(LOCKS["dev"])}
    for package, _ in _locked(LOCKS["bench"]):
        here = package.name, str(package.marker)
        assert known.get(here, package.specifier) == package.specifier
