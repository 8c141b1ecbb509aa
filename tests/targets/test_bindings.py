"""One binding model: groups have sets, and numbers in a set are used once."""

from __future__ import annotations

import pytest

from burnish.targets.emit.bindings import Slot, assign_bindings

from .kit import PROFILES, Selected
from .programs import plastic

SEPARATE = [selected for selected in PROFILES if not selected.profile.combined_samplers]
COMBINED = [selected for selected in PROFILES if selected.profile.combined_samplers]


@pytest.mark.parametrize("selected", PROFILES, ids=str)
def test_blocks(selected: Selected) -> None:
    bindings = assign_bindings(plastic(), selected.profile)
    assert bindings.blocks == {
        "View": Slot(0, 0),
        "Rig": Slot(1, 0),
        "RigDerived": Slot(1, 1),
        "Material": Slot(2, 0),
        "Draw": Slot(3, 0),
    }


@pytest.mark.parametrize("selected", SEPARATE, ids=str)
def test_separate_samplers(selected: Selected) -> None:
    bindings = assign_bindings(plastic(), selected.profile)
    assert bindings.textures == {"albedo": Slot(2, 1)}
    assert bindings.samplers == {"albedo": Slot(2, 2)}


@pytest.mark.parametrize("selected", COMBINED, ids=str)
def test_combined_samplers(selected: Selected) -> None:
    bindings = assign_bindings(plastic(), selected.profile)
    assert bindings.textures == bindings.samplers == {"albedo": Slot(2, 1)}
