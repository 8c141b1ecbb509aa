"""The floors of the tree: nobody imports upwards, and no modules import each other in a circle.

Every import counts: those at the top of a module, those inside functions, which only put off when a
module is loaded, and those for types. A circle of modules cannot be understood, tested or replaced
one module at a time, whichever way it is closed.
"""

from __future__ import annotations

import pytest

from burnish.targets import registry

from .modules import PACKAGE, between, circles, modules

pytestmark = pytest.mark.xdist_group("imports")  # One process reads all modules.

BACKENDS = registry.names()

FLOORS: dict[str, str] = {
    "support.initialisers": "",
    "support.frozen": "initialisers",
    "support.arguments": "",
    "support.stack": "",
    "support.depth": "",
    "support.locks": "",
    "support.installing": "",
    "support.garbage": "stack locks",
    "support.late": "locks",
    "support.unique": "",
    "stdlib": "frozen",
    # From text to a staged program.
    "compiler.budget": "",
    "compiler.cache": "",
    "compiler.precomputed": "cache",
    "compiler.inputs": "",
    "compiler.srgb": "",
    "compiler.units": "",
    "compiler.watching": "",
    "compiler.diagnostics": "frozen",
    "compiler.syntax": "frozen locks late stdlib precomputed diagnostics units",
    "compiler.constraints": "frozen",
    "compiler.ir": "frozen stdlib diagnostics constraints",
    "compiler.layout": "ir",
    "compiler.packing": "frozen ir",
    "compiler.documents": "frozen constraints ir packing",
    "compiler.formula": "stdlib ir",
    "compiler.promises": "frozen stdlib ir formula",
    "compiler.source_map": "frozen diagnostics ir",
    "compiler.reference": "frozen stdlib budget diagnostics ir formula",
    "compiler.semantics.work": "frozen",
    "compiler.semantics.types": "frozen stdlib diagnostics syntax ir",
    "compiler.semantics.names": "frozen locks stdlib diagnostics syntax types",
    "compiler.library_trees": "cache precomputed diagnostics syntax names",
    "compiler.library": "locks stdlib precomputed diagnostics syntax names library_trees",
    "compiler.semantics.inheritance": "frozen stdlib diagnostics syntax work names",
    "compiler.semantics.state": (
        "frozen stdlib diagnostics syntax ir reference work types names inheritance"
    ),
    "compiler.semantics.hints": "stdlib diagnostics syntax ir types names state",
    "compiler.semantics.declarations": (
        "frozen stdlib diagnostics syntax ir layout types names inheritance state hints"
    ),
    "compiler.semantics.checking": (
        "frozen stdlib diagnostics syntax srgb units ir library types names inheritance state "
        "hints declarations"
    ),
    "compiler.semantics.lowering": "frozen syntax ir types state checking",
    "compiler.semantics.shading": (
        "frozen locks watching stdlib diagnostics syntax ir library work types names inheritance "
        "state hints declarations checking lowering"
    ),
    "compiler.semantics.equations": (
        "frozen stdlib diagnostics syntax ir types names inheritance state checking shading"
    ),
    "compiler.semantics.frames": (
        "frozen stdlib diagnostics syntax ir types names inheritance state declarations checking "
        "lowering shading"
    ),
    "compiler.opening": "inputs diagnostics syntax names inheritance",
    "compiler.frontend": (
        "watching inputs diagnostics syntax ir library names inheritance shading equations frames "
        "opening"
    ),
    "compiler.planning": "frozen diagnostics ir documents",
    "compiler.expansion_templates": (
        "frozen stdlib diagnostics syntax ir library types names inheritance state checking "
        "lowering"
    ),
    "compiler.passes": (
        "frozen watching stdlib diagnostics ir layout formula reference expansion_templates"
    ),
    "compiler.tracing": "",
    "compiler.javascript": "",
    "compiler.equivalence": "frozen stdlib diagnostics ir reference",
    "compiler.reflection": (
        "frozen stdlib precomputed diagnostics constraints ir packing documents promises planning "
        "passes"
    ),
    # Shaders in each language, and the programs that check, draw and compare them.
    "targets.closing": "",
    "targets.toolchain": "installing cache budget closing",
    "targets.description": "frozen stdlib ir",
    "targets.legalise": "frozen stdlib ir passes expansion_templates description",
    "targets.emit": "frozen stdlib precomputed diagnostics ir documents description legalise",
    **{f"targets.{name}": "stdlib ir description" for name in BACKENDS},
    "targets.registry": "description",
    "targets.availability": "description registry",
    "targets.selection": "diagnostics description registry availability",
    "targets.binding_schemes": "frozen diagnostics inputs ir syntax description",
    "targets.web_host.serving": (
        "frozen stdlib precomputed constraints ir documents reference tracing javascript"
    ),
    "targets.runner": (
        "frozen garbage stdlib arguments cache diagnostics srgb units ir documents promises "
        "reference installing reflection budget closing toolchain serving"
    ),
    "targets.web_host": "frozen ir documents budget runner toolchain serving",
    "targets.conformance": (
        "frozen stdlib diagnostics constraints ir documents reference budget runner web_host "
        "toolchain"
    ),
    "targets.web_view": "documents runner",
    # What hosts set, compute and bind, in their own languages.
    "bindings": "frozen unique ir packing documents reflection reference tracing javascript",
    # Engines.
    "engines.slot_table": "frozen ir documents reflection",
    "engines.drawing": "ir documents",
    "engines.values": "frozen",
    "engines.surface": "frozen diagnostics documents emit slot_table",
    "engines.writer": "documents reflection emit surface values",
    "engines.texts": "surface",
    "engines.engine": "frozen diagnostics documents description emit",
    "engines.godot": (
        "frozen ir documents description registry emit engine drawing surface values writer"
    ),
    "engines.filament": (
        "frozen ir documents description registry emit engine drawing surface texts values writer"
    ),
    "engines.bevy": (
        "frozen ir diagnostics documents description registry emit engine drawing surface values "
        "writer"
    ),
    "engines.node_graph": "frozen unique documents reflection emit surface slot_table texts values",
    "engines.unity": "unique emit engine node_graph surface slot_table",
    "engines.unreal": "unique emit engine node_graph surface slot_table",
    "engines.known": "engine",
    "engines.fitting": "frozen diagnostics documents reflection emit engine surface slot_table",
    "engines.three": "frozen diagnostics documents emit engine drawing slot_table",
    "engines.three_webgl": (
        "frozen diagnostics documents ir tracing bindings description registry engine three"
    ),
    # The door.
    "api.graphs": "frozen locks diagnostics ir passes source_map emit legalise selection",
    "api.compiled": (
        "frozen garbage inputs diagnostics ir documents passes planning reflection description "
        "legalise emit selection graphs runner"
    ),
    "api.remembered": "frozen locks watching compiled",
    "api.narrowed_values": "frozen stdlib ir reflection runner",
    "api.specialising": "frozen diagnostics ir passes runner narrowed_values",
    "api.shared_texts": "frozen emit selection graphs",
    "api.compiling": (
        "frozen arguments garbage cache inputs diagnostics ir passes source_map names reflection "
        "frontend description emit legalise availability selection binding_schemes graphs "
        "shared_texts compiled specialising"
    ),
    "api.compiled_functions": "frozen diagnostics documents inputs emit",
    "api.compiling_functions": (
        "frozen garbage diagnostics inputs ir passes reflection frontend description legalise emit "
        "selection compiling specialising compiled_functions"
    ),
    "api.compiling_engines": (
        "frozen diagnostics documents ir passes emit engine slot_table compiled compiling "
        "compiled_functions compiling_functions"
    ),
    "api.validating": "diagnostics ir emit toolchain compiled",
    "api.modules": "frozen arguments diagnostics documents ir toolchain compiled validating",
    "api.sameness": ("frozen garbage diagnostics ir passes frontend equivalence compiling"),
    "api.entry_points": (
        "frozen arguments garbage diagnostics documents passes names equations frontend emit "
        "selection runner compiled remembered compiling sameness compiled_functions "
        "compiling_functions"
    ),
    "api.binding": ("frozen arguments selection bindings compiled entry_points"),
    "api.frame_sameness": "documents passes equivalence compiled entry_points",
    # Documents of MaterialX.
    "materialx": "opening depth garbage stdlib diagnostics syntax library_trees library runner",
    "materialx.export": (
        "diagnostics syntax srgb units ir names inheritance state checking shading equations "
        "frontend compiling materialx"
    ),
    "materialx.fidelity": (
        "installing diagnostics ir documents reference reflection closing runner conformance "
        "toolchain entry_points materialx"
    ),
    "commands": (
        "installing frozen garbage stack cache watching inputs diagnostics syntax ir documents "
        "passes equations frontend formula budget closing description emit registry availability "
        "selection runner web_host web_view conformance toolchain serving compiled sameness "
        "entry_points binding modules validating frame_sameness materialx bindings "
        "compiled_functions compiling_engines engine known fitting"
    ),
    "generate": "initialisers precomputed library syntax reflection emit registry web_host serving",
    "testing": "conformance",
    "__main__": "commands",
}
"""The modules that each folder or module may import, by their last names; lowest first.

All other modules are out of reach; a folder stands for all modules inside it. The folder of a
language is listed as long as it exists: no language imports another, and no other module imports
a language, as the registry finds them.
"""

OUT_OF_REACH = {
    "targets.emit": ("compiler.ir.ranges", "compiler.ir.rewrite"),
    "api.entry_points": ("targets.runner.drivers",),
}
"""Modules of a floor below that a folder may not import all the same: emission prints what is legal
and decides nothing, and only processes of their own load a driver."""


def _full(name: str) -> str:
    (found,) = (floor for floor in FLOORS if floor.rpartition(".")[2] == name)
    return found


ALLOWED = {floor: [_full(name) for name in names.split()] for floor, names in FLOORS.items()}


def _short(module: str) -> str:
    return module.removeprefix(f"{PACKAGE}.")


def test_each_floor_stands_on_those_before_it() -> None:
    order = list(FLOORS)
    for floor, others in ALLOWED.items():
        assert all(order.index(other) < order.index(floor) for other in others), floor


def test_each_module_lies_on_a_floor() -> None:
    floors = tuple(f"{PACKAGE}.{floor}." for floor in FLOORS)
    packages = {"", *(".".join(floor.split(".")[:depth]) for floor in FLOORS for depth in (1, 2))}
    above = {f"{PACKAGE}.{package}".rstrip(".") for package in packages}
    outside = {f"{PACKAGE}.setup", f"{PACKAGE}.tests"}
    assert not [
        module
        for module in modules().keys() - above - outside
        if not f"{module}.".startswith((*floors, f"{PACKAGE}.tests."))
    ]


def test_no_floor_imports_what_it_may_not() -> None:
    found = between(modules(), [f"{PACKAGE}.{floor}" for floor in FLOORS])
    wrong = [
        each
        for (start, end), imports in found.items()
        if not f"{_short(end)}.".startswith(tuple(f"{each}." for each in ALLOWED[_short(start)]))
        for each in imports
    ]
    assert not wrong, "\n".join(wrong)


@pytest.mark.parametrize(("floor", "forbidden"), OUT_OF_REACH.items())
def test_no_floor_imports_what_is_out_of_reach(floor: str, forbidden: tuple[str, ...]) -> None:
    assert not [
        f"{module} imports {other}"
        for module, others in modules().items()
        for other in others
        if f"{_short(module)}.".startswith(f"{floor}.")
        and f"{_short(other)}.".startswith(tuple(f"{name}." for name in forbidden))
    ]


def test_the_package_itself_is_only_a_door_to_the_library() -> None:
    assert modules()[PACKAGE] == {
        "burnish.api.binding",
        "burnish.api.entry_points",
        "burnish.api.modules",
        "burnish.compiler.diagnostics.diagnostic",
    }


def test_no_modules_import_each_other_in_a_circle() -> None:
    found = circles(modules())
    assert not found, "\n".join(", ".join(circle) for circle in found)


@pytest.mark.parametrize(
    ("graph", "expected"),
    [
        ({"a": "b", "b": "c", "c": ""}, []),
        ({"a": "b", "b": "a", "c": "a"}, [["a", "b"]]),
        (
            {"a": "b c", "b": "d", "c": "d", "d": "a", "e": "f", "f": "e"},
            [["a", "b", "c", "d"], ["e", "f"]],
        ),
    ],
)
def test_circles_are_found(graph: dict[str, str], expected: list[list[str]]) -> None:
    assert sorted(circles({k: frozenset(v.split()) for k, v in graph.items()})) == expected


def test_imports_inside_functions_and_for_types_are_seen() -> None:
    graph = modules()
    assert (
        "burnish.targets.runner.textures.files" in graph["burnish.targets.runner.textures.texture"]
    )
    assert "burnish.compiler.ir.shader" in graph["burnish.compiler.layout"]
    assert "burnish.api.entry_points" in graph["burnish.commands.compiled_files"]
