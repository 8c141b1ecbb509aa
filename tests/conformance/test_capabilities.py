"""The routes of a profile draw or compute all that the table of capabilities promises of it.

``tests/targets/test_capabilities.py`` holds the table against the texts. Where a stage is native as
well as lowered, what is run here is the lowered form; ``test_geometry_stage.py`` compares both.
"""

from __future__ import annotations

import pytest

import burnish
from burnish.targets import registry
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.summary import details
from burnish.targets.description.capabilities import CAPABILITIES
from burnish.targets.description.capability import Capability, standing
from burnish.targets.runner.routes import ROUTES

from ..targets.capability_probes import PROBES
from .kit import PROFILES, Studio

RUN = [row for row in CAPABILITIES if not PROBES[row.name].options]
"""The capabilities that a program shows without further options."""


@pytest.mark.parametrize("row", RUN, ids=lambda row: row.name)
def test_what_a_profile_has_runs(studio: Studio, row: Capability) -> None:
    kinds = {name: standing(row, registry.select(name)[1]).kind for name in PROFILES}
    (probe,) = burnish.compile(PROBES[row.name].text, PROFILES, partial=True)
    found = conform([(row.name, probe)], list(ROUTES.values()), studio.runner, studio.toolchain)
    for each in found:
        is_absent = kinds[each.route.profile] == "absent"
        wanted = "not run" if is_absent else "agrees"
        assert each.status == wanted, "\n".join(details(each)) or each.problem
