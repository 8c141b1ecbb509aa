"""What an error that is planted on purpose is, and ways to plant one in a copy of each part."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from burnish.frozen import changed
from burnish.targets import registry
from burnish.targets.conformance.rows import Status
from burnish.targets.emit import templates
from burnish.targets.emit.description import Profile, Spelling, Target
from burnish.targets.emit.forms import Forms
from burnish.targets.runner.drivers.draw import Job, Picture
from burnish.targets.runner.routes import Route
from burnish.targets.runner.runner import Runner

Plant = Callable[[pytest.MonkeyPatch, Path], None]
"""Plants an error until the patch is undone; the folder is for files."""


@dataclass(frozen=True, slots=True)
class Planted:
    """An error, and the material by which a route has to show it."""

    name: str
    material: str
    """``operations: Limits``: a file of ``materials``, and one of its passes."""
    route: str
    plant: Plant
    status: Status = "differs"
    """``failed`` where a compiler already refuses."""

    def __str__(self) -> str:
        return f"{self.route}, {self.name}"


QUICKEST = {"glsl": "lavapipe:glsl", "hlsl": "lavapipe:hlsl-dxc", "wgsl": "lavapipe:wgsl-naga"}
"""For each language its quickest route."""


def replaced(owner: Any, name: str, value: Any) -> Plant:
    """Another function, method or table in place of one."""

    def plant(patch: pytest.MonkeyPatch, _folder: Path) -> None:
        patch.setattr(owner, name, value)

    return plant


# --- in a language -------------------------------------------------------------------------------


def target(language: str, change: Callable[[Target], Target]) -> Plant:
    """A changed description of a language."""

    def plant(patch: pytest.MonkeyPatch, _folder: Path) -> None:
        load = registry.load
        wrong = change(load(language))
        patch.setattr(registry, "load", lambda name: wrong if name == language else load(name))

    return plant


def spelling(language: str, builtin: str, text: str | Spelling) -> Plant:
    """A builtin under a wrong name or template."""
    return target(language, lambda t: changed(t, natives={**t.natives, builtin: text}))


def form(language: str, **forms: Any) -> Plant:
    """Expressions or statements of a wrong form."""

    def change(whole: Target) -> Target:
        wrong: Forms = changed(whole.forms, **forms)
        return changed(whole, forms=wrong)

    return target(language, change)


def supplied(language: str, name: str, read: str) -> Plant:
    """A pipeline input that is read wrongly."""

    def change(whole: Target) -> Target:
        wrong = changed(whole.inputs[name], read=read)
        return changed(whole, inputs={**whole.inputs, name: wrong})

    return target(language, change)


def framebuffer(language: str, name: str, **changes: Any) -> Plant:
    """A profile of a language that is wrong about clip space or the rows of pictures."""

    def change(whole: Target) -> Target:
        profiles: tuple[Profile, ...] = tuple(
            changed(each, framebuffer=changed(each.framebuffer, **changes))
            if each.name == name
            else each
            for each in whole.profiles
        )
        return changed(whole, profiles=profiles)

    return target(language, change)


def skeleton(language: str, *replacements: tuple[str, str]) -> Plant:
    """A skeleton, and the one that it extends, with other words in them."""

    def plant(patch: pytest.MonkeyPatch, folder: Path) -> None:
        whole = registry.load(language)
        files = (whole.folder / whole.template, Path(templates.__file__).parent / "skeleton.j2")
        texts = {path.name: path.read_text(encoding="utf-8") for path in files}
        for old, new in replacements:
            said = any(old in text for text in texts.values())
            assert said, f"the skeleton of {language} does not say {old!r} any more"
            texts = {name: text.replace(old, new) for name, text in texts.items()}
        for name, text in texts.items():
            (folder / name).write_text(text, encoding="utf-8")
        target(language, lambda t: changed(t, folder=folder))(patch, folder)

    return plant


# --- on the way to a driver ----------------------------------------------------------------------


def job(change: Callable[[Job], Job]) -> Plant:
    """Something else for the driver to draw."""

    def plant(patch: pytest.MonkeyPatch, _folder: Path) -> None:
        draw = Runner.draw

        def drawn(self: Runner, route: Route, asked: Job) -> tuple[Picture, ...]:
            return draw(self, route, change(asked))

        patch.setattr(Runner, "draw", drawn)

    return plant
