"""Tools of every kind are found where distributions have them."""

from __future__ import annotations

import platform
from importlib.metadata import version
from pathlib import Path

import pytest

from burnish.targets.toolchain import inspect
from burnish.targets.toolchain.tools import tool_named

MACHINE = platform.machine()


def plant(root: Path, path: str, content: str = "") -> Path:
    file = root / path
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(content)
    return file


def plant_program(root: Path, path: str, says: str) -> Path:
    file = plant(root, path, f"#!/bin/sh\necho '{says}'\n")
    file.chmod(0o755)
    return file


@pytest.mark.parametrize(
    ("libraries", "icd"),
    [
        (f"usr/lib/{MACHINE}-linux-gnu", f"usr/share/vulkan/icd.d/lvp_icd.{MACHINE}.json"),
        ("usr/lib64", f"etc/vulkan/icd.d/lvp_icd.{MACHINE}.json"),
        ("usr/lib", "usr/share/vulkan/icd.d/lvp_icd.json"),
    ],
)
def test_a_driver_is_found_by_its_file(no_tools: Path, libraries: str, icd: str) -> None:
    lavapipe = tool_named("lavapipe")
    plant(no_tools, "usr/share/vulkan/icd.d/lvp_icd.another.json")
    library = plant(no_tools, f"{libraries}/libvulkan_lvp.so", "\0Mesa 23.1.2 (LLVM 16)\0")
    file = plant(no_tools, icd)
    assert inspect(lavapipe).paths == ()  # the loader is missing yet
    loader = plant(no_tools, f"{libraries}/libvulkan.so.1")
    state = inspect(lavapipe)
    assert state.problem is None
    assert state.paths == (file, library, loader)
    assert state.version == "23.1.2"


def test_a_driver_may_be_too_old(no_tools: Path) -> None:
    plant(no_tools, "usr/lib64/libvulkan_lvp.so", "Mesa 20.3.5")
    plant(no_tools, "usr/lib64/libvulkan.so.1")
    plant(no_tools, "usr/share/vulkan/icd.d/lvp_icd.json")
    assert "older than 22.3" in (inspect(tool_named("lavapipe")).problem or "")


@pytest.mark.parametrize(
    ("folder", "browser"),
    [("usr/lib/chromium", "chromium"), ("opt/google/chrome", "chrome")],
)
def test_the_browsers_driver_has_the_browsers_version(
    no_tools: Path, folder: str, browser: str
) -> None:
    swiftshader = tool_named("swiftshader")
    icd = plant(no_tools, f"{folder}/vk_swiftshader_icd.json")
    plant(no_tools, "usr/lib/libvulkan.so.1")
    assert "does not say its version" in (inspect(swiftshader).problem or "")
    plant_program(no_tools, f"{folder}/{browser}", "Chromium 150.0.1.2 on something")
    state = inspect(swiftshader)
    assert (state.problem, state.version, state.paths[0]) == (None, "150.0.1.2", icd)


def test_a_browser_goes_by_several_names(no_tools: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    chrome = plant_program(no_tools, "usr/bin/google-chrome", "Google Chrome 150.0.1.2")
    monkeypatch.setenv("PATH", str(chrome.parent))
    # "Google" is no part of what is looked for, nor is the order on PATH.
    assert inspect(tool_named("chromium")).paths == (chrome,)
    chromium = plant_program(no_tools, "usr/bin/chromium", "Chromium 112.0")
    state = inspect(tool_named("chromium"))
    assert (state.paths, state.version) == ((chromium,), "112.0")
    assert "older than 113" in (state.problem or "")


@pytest.mark.parametrize("text", ["{}", '{"layer": 1}', '{"layer": {"api_version": 1}}'])
def test_a_layer_that_does_not_say_its_version_is_not_used(no_tools: Path, text: str) -> None:
    plant(no_tools, "etc/vulkan/explicit_layer.d/VkLayer_khronos_validation.json", text)
    state = inspect(tool_named("vulkan-validation"))
    assert state.version is None
    assert "does not say its version" in (state.problem or "")


def test_a_python_package_is_a_tool() -> None:
    state = inspect(tool_named("numpy"))
    assert state.problem is None
    assert state.version == version("numpy")
    assert (state.paths[0] / "numpy" / "__init__.py").is_file()
