"""Planted errors, and functions that plant one in each part of a copy of the compiler."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from burnish.stdlib.builtins.row import everywhere
from burnish.support.frozen import changed
from burnish.targets import registry
from burnish.targets.conformance.rows import Status
from burnish.targets.description.forms import Forms
from burnish.targets.description.profile import Profile
from burnish.targets.description.shading_language import Language
from burnish.targets.description.spellings import Spelling
from burnish.targets.emit import templates
from burnish.targets.runner.drivers.frame_job import Found, FrameJob
from burnish.targets.runner.routes import Route
from burnish.targets.runner.runner import Runner

Plant = Callable[[pytest.MonkeyPatch, Path], None]
"""Plants an error that lasts until the patch is undone; the folder is for files."""


@dataclass(frozen=True, slots=True)
class Planted:
    """An error, and the material with which a route must show it."""

    name: str
    material: str
    """A file of ``materials`` and one of its passes: ``operations: Limits``."""
    route: str
    plant: Plant
    status: Status = "differs"
    """``failed`` if a compiler already refuses the text."""

    def __str__(self) -> str:
        return f"{self.route}, {self.name}"


QUICKEST = {"glsl": "lavapipe:glsl", "hlsl": "lavapipe:hlsl-dxc", "wgsl": "lavapipe:wgsl-naga"}
"""The fastest route of each language."""


def replaced(owner: Any, name: str, value: Any) -> Plant:
    """Replace a function, method or table."""

    def plant(patch: pytest.MonkeyPatch, _folder: Path) -> None:
        patch.setattr(owner, name, value)

    return plant


# --- in a language -------------------------------------------------------------------------------


def target(language: str, change: Callable[[Language], Language]) -> Plant:
    """Change the description of a language."""

    def plant(patch: pytest.MonkeyPatch, _folder: Path) -> None:
        load = registry.load
        wrong = change(load(language))
        patch.setattr(registry, "load", lambda name: wrong if name == language else load(name))

    return plant


def spelling(language: str, builtin: str, text: str | Spelling) -> Plant:
    """Give a builtin a wrong name or template."""
    return target(language, lambda t: changed(t, natives={**t.natives, builtin: text}))


def promised(language: str, builtin: str) -> Plant:
    """Have all profiles of a language promise a builtin's meaning for all operands."""

    def change(whole: Language) -> Language:
        profiles = (
            changed(profile, agrees={**profile.agrees, builtin: everywhere})
            for profile in whole.profiles
        )
        return changed(whole, profiles=tuple(profiles))

    return target(language, change)


def form(language: str, **forms: Any) -> Plant:
    """Give expressions or statements a wrong form."""

    def change(whole: Language) -> Language:
        wrong: Forms = changed(whole.forms, **forms)
        return changed(whole, forms=wrong)

    return target(language, change)


def supplied(language: str, name: str, read: str) -> Plant:
    """Read a pipeline input wrongly."""

    def change(whole: Language) -> Language:
        wrong = changed(whole.inputs[name], read=read)
        return changed(whole, inputs={**whole.inputs, name: wrong})

    return target(language, change)


def framebuffer(language: str, name: str, **changes: Any) -> Plant:
    """Make a profile wrong about clip space or the order of rows."""

    def wrong(right: Profile) -> Profile:
        return changed(right, framebuffer=changed(right.framebuffer, **changes))

    return _profile(language, name, wrong)


def agreeing(language: str, name: str) -> Plant:
    """Make a profile trust all operations of the language itself."""
    return _profile(language, name, lambda right: changed(right, agrees={}))


def _profile(language: str, name: str, wrong: Callable[[Profile], Profile]) -> Plant:
    def change(whole: Language) -> Language:
        profiles = tuple(wrong(each) if each.name == name else each for each in whole.profiles)
        return changed(whole, profiles=profiles)

    return target(language, change)


def skeleton(language: str, *replacements: tuple[str, str]) -> Plant:
    """Replace words in a template, and in the one that it extends."""

    def plant(patch: pytest.MonkeyPatch, folder: Path) -> None:
        whole = registry.load(language)
        files = (whole.skeleton, Path(templates.__file__).parent / "skeleton.j2")
        texts = {path.name: path.read_text(encoding="utf-8") for path in files}
        for old, new in replacements:
            said = any(old in text for text in texts.values())
            assert said, f"the skeleton of {language} does not say {old!r} any more"
            texts = {name: text.replace(old, new) for name, text in texts.items()}
        for name, text in texts.items():
            (folder / name).write_text(text, encoding="utf-8")
        target(language, lambda t: changed(t, skeleton=folder / t.skeleton.name))(patch, folder)

    return plant


# --- on the way to a driver ----------------------------------------------------------------------


def job(change: Callable[[FrameJob], FrameJob]) -> Plant:
    """Change the job that a driver gets."""

    def plant(patch: pytest.MonkeyPatch, _folder: Path) -> None:
        draw = Runner.draw_frame

        def drawn(self: Runner, route: Route, job: FrameJob, *, keep: bool = True) -> Found:
            return draw(self, route, change(job), keep=keep)

        patch.setattr(Runner, "draw_frame", drawn)

    return plant
