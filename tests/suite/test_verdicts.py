"""Compilers are asked once about a text that they accept, and again about any other."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pytest

from burnish.targets.toolchain import Job, Message, Toolchain, Verdict

from . import verdicts
from .verdicts import refused, remarks

FINE = Job("naga", "frag", "fine")
ODD = Job("naga", "frag", "odd")
WRONG = Job("naga", "frag", "wrong")


class Answering(Toolchain):
    """Accepts two texts, one of them with a warning, and refuses the others."""

    def __init__(self) -> None:
        super().__init__()
        self.asked: list[Job] = []

    def check(self, jobs: Sequence[Job], *, keep_modules: bool = False) -> list[Verdict]:
        assert not keep_modules
        self.asked += jobs
        warning = (Message("warning", None, None, "odd"),)
        return [
            Verdict(
                job,
                "accepted" if job.text in ("fine", "odd") else "rejected",
                () if job.text == "fine" else warning,
            )
            for job in jobs
        ]


@pytest.fixture(autouse=True)
def _own_cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path))


def test_what_was_accepted_is_not_asked_again() -> None:
    with Answering() as toolchain:
        assert refused([FINE, replace(FINE, name="other"), ODD], toolchain) == []
        assert toolchain.asked == [FINE, ODD]
        assert [each.job for each in remarks([FINE, ODD], toolchain)] == [ODD]
        assert toolchain.asked == [FINE, ODD, ODD]


def test_what_was_refused_is_asked_again_and_is_told_of_each_job() -> None:
    other = replace(WRONG, name="other")
    with Answering() as toolchain:
        for _ in range(2):
            assert [each.job for each in refused([WRONG, FINE, other], toolchain)] == [WRONG, other]
        assert toolchain.asked == [WRONG, FINE, WRONG]


@pytest.mark.parametrize(
    "job",
    [
        replace(FINE, text="wrong"),
        replace(FINE, stage="vert"),
        replace(FINE, entry="other"),
        replace(FINE, flags=("-g",)),
        replace(FINE, checker="tint"),
    ],
)
def test_another_question_is_asked(job: Job) -> None:
    with Answering() as toolchain:
        remarks([FINE, job], toolchain)
        assert toolchain.asked == [FINE, job]


def test_another_compiler_is_asked(monkeypatch: pytest.MonkeyPatch) -> None:
    with Answering() as toolchain:
        refused([FINE], toolchain)
        monkeypatch.setattr(verdicts, "_compiler", lambda _checker: "a new one")
        refused([FINE], toolchain)
        assert toolchain.asked == [FINE, FINE]


def test_a_changed_file_is_another_compiler(tmp_path: Path) -> None:
    file = tmp_path / "compiler"
    file.write_text("one")
    (before,) = verdicts._states([file])
    file.write_text("other")
    assert [before] != list(verdicts._states([file]))
