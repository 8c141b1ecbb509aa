"""The options of ``burnish compile`` as rows, and a parser of plain command lines.

click shows the rows in the help, and reads any command line by them (``compile.py``). But to load
click takes a tenth of a short compile, and most command lines need nothing of it: they name files,
and options in full with their values. ``cli.py`` has those read here.
"""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from ..support.frozen import changed, frozen
from .results import STDOUT


@frozen
class Option:
    """One option: a value, a flag, or a switch between two flags."""

    field: str
    """The field of ``CompileRequest`` that the option sets."""
    names: tuple[str, ...]
    help: str
    metavar: str = ""
    """The word for the value in the help; a flag has none."""
    off: str = ""
    """The flag that switches the option off, which is on by default; ``names`` switch it on."""
    many: bool = False
    """True if the option may be given several times; all values count."""
    is_path: bool = False
    required: bool = False
    choices: tuple[str, ...] = ()
    """The values that there are, the default first, if not any text is one."""
    default: str | None = None
    """The value of an option that is not given."""


TARGET = Option(
    "targets",
    ("-t", "--target"),
    "The targets to write; see `burnish targets`. Default: the first profile of every target that "
    "is not marked as unproven there; `all` means every profile that need not be named.",
    metavar="NAME[:PROFILE],…",
    many=True,
)
OUTPUT = Option(
    "output",
    ("-o", "--output"),
    "The folder for the files; created if needed. `-` prints the shaders instead.",
    metavar="FOLDER",
    required=True,
)
SHADERS, FUNCTIONS = "shaders", "functions"
MODULES = ("spirv", "dxil")
EMIT = Option(
    "emit",
    ("--emit",),
    "What to write: whole `shaders`, and with `spirv` or `dxil` also what drivers take: SPIR-V of "
    "the GLSL for Vulkan, or DXIL of the HLSL, by glslang or DXC (see `burnish doctor`). Or "
    "`functions`, which an engine that lights surfaces itself calls: one for each slot, such as "
    "`tint` or `normal`.",
    metavar="KIND,…",
    default=SHADERS,
)
OPTIMIZE = Option(
    "optimize", ("--optimize",), "With `--emit spirv`: let spirv-opt make the modules shorter."
)
SLOTS = Option(
    "slots",
    ("--slots",),
    "With `--emit functions`: only these slots. One is computed for vertices where `@vertex` "
    "follows its name. Default: those that the material itself, or its model, gives a value, and "
    "that need no lights. With `--engine`, `base_color=stain` says that the slot `stain` is the "
    "base colour.",
    metavar="NAME[@vertex],…",
    many=True,
)
TOGETHER = Option(
    "together",
    ("--together",),
    "With `--emit functions`: one function for pixels and one for vertices, each for all slots.",
)
ENGINE = Option(
    "engines",
    ("--engine",),
    "Write what an engine takes, instead of texts: a module with a material for `three` "
    "(three.js), a shader for `godot`, a definition for `filament`, a shader with a module in Rust "
    "for `bevy`, functions for nodes of `unity` and `unreal`. It implies `--emit functions`, "
    "except `three-webgl`: that is a module with a material of whole shaders for three.js's "
    "WebGLRenderer.",
    metavar="NAME",
    many=True,
)
PREFIX = Option(
    "prefix",
    ("--prefix",),
    "With `--emit functions`: what names in the text begin with, instead of the material's name.",
    metavar="NAME",
)

MATERIAL = Option(
    "material",
    ("--material",),
    "Only this material, instead of all in the file; the file's syntax has to be right throughout.",
    metavar="NAME",
)
RIG = Option("rig", ("--rig",), "The rig to use, if the file declares several.", metavar="NAME")
PASS = Option(
    "pass_", ("--pass",), "The pass that draws, if not the library's Forward.", metavar="NAME"
)
INCLUDE = Option(
    "search_path",
    ("-I", "--include"),
    "A folder in which to look for imported files; may be given several times.",
    metavar="FOLDER",
    many=True,
    is_path=True,
)
SET = Option(
    "values",
    ("--set",),
    "Serve one value of a parameter only, or a part of its range, and leave out what is dead then; "
    "may be given many times.",
    metavar="NAME=VALUE|LOW..HIGH",
    many=True,
)
WHY = Option("why", ("--why",), "Say what values of parameters make dead, and why.")
VALIDATE = Option("validate", ("--validate",), "Have the real compilers check the texts.")
SINGLE_FILE = Option(
    "single_file", ("--single-file",), "All stages in one text: vs_main and fs_main."
)
FLIP_Y = Option("flip_y", ("--flip-y",), "Turn the picture upside down, to draw into textures.")
LINE_DIRECTIVES = Option(
    "line_directives",
    ("--line-directives",),
    "Write #line directives, so that other tools name lines of the material in messages.",
)
HOIST = Option(
    "hoist",
    ("--hoist",),
    "Leave values that depend only on parameters to the host, or compute them in the shader.",
    off="--no-hoist",
)
BINDINGS = Option(
    "bindings",
    ("--bindings",),
    "A file of TOML that says where things are bound: sets, first numbers, combined samplers, push "
    "constants.",
    metavar="FILE",
    is_path=True,
)
NATIVE_STAGES = Option(
    "native_stages",
    ("--native-stages",),
    "Use the stages that a target has for primitives, instead of drawing each as an instance.",
)
DEPFILE = Option(
    "depfile",
    ("--depfile",),
    "A file to write for Make and Ninja: the outputs depend on all files that were read.",
    metavar="FILE",
)
DEPFILE_TARGET = Option(
    "depfile_target",
    ("--depfile-target",),
    "What depends on them in --depfile, such as a stamp, instead of the outputs.",
    metavar="NAME",
)
LIST_OUTPUTS = Option(
    "list_outputs", ("--list-outputs",), "Print the paths of all outputs, and write none of them."
)
FORMAT = Option(
    "form",
    ("--format",),
    "How messages are told: as texts for people, one line for each, one JSON document (`burnish "
    "schema answer`), a log in SARIF 2.1.0, or annotations for a workflow of GitHub.",
    metavar="FORM",
    choices=("text", "line", "json", "sarif", "github"),
)
FORCE = Option(
    "force",
    ("--force",),
    "Overwrite files that another source, or another program, has made, and outputs that were "
    "changed by hand.",
)
CACHE = Option(
    "cache",
    ("--cache",),
    "Write the earlier result again if nothing has changed, or compile in any case.",
    off="--no-cache",
)

OPTIONS = (
    TARGET, OUTPUT, EMIT, OPTIMIZE, ENGINE, SLOTS, TOGETHER, PREFIX, MATERIAL, RIG, PASS, INCLUDE,
    SET, WHY, VALIDATE, SINGLE_FILE, FLIP_Y, LINE_DIRECTIVES, HOIST, BINDINGS, NATIVE_STAGES,
    DEPFILE, DEPFILE_TARGET, LIST_OUTPUTS, FORMAT, FORCE, CACHE,
)  # fmt: skip
"""The options for compiling. ``--watch`` and ``--help`` are not among them."""


@frozen(kw_only=True)
class CompileRequest:
    """A parsed command line of ``burnish compile``."""

    files: tuple[Path, ...]
    output: str
    """A folder, or ``-``."""
    targets: tuple[str, ...] = ()
    """The targets as they were given, each perhaps several with commas; empty for the default
    ones."""
    emit: str = SHADERS
    """Words, with commas: ``shaders``, the formats of modules, or ``functions``."""
    optimize: bool = False
    engines: tuple[str, ...] = ()
    """The engine; two of them are a mistake."""
    slots: tuple[str, ...] = ()
    """Slots as they were given, each perhaps several with commas."""
    together: bool = False
    prefix: str | None = None
    material: str | None = None
    rig: str | None = None
    pass_: str | None = None
    search_path: tuple[Path, ...] = ()
    values: tuple[str, ...] = ()
    """What is said of parameters, each as ``NAME=VALUE`` or ``NAME=LOW..HIGH``."""
    why: bool = False
    validate: bool = False
    single_file: bool = False
    flip_y: bool = False
    line_directives: bool = False
    hoist: bool = True
    bindings: Path | None = None
    native_stages: bool = False
    depfile: str | None = None
    depfile_target: str | None = None
    list_outputs: bool = False
    form: str = "text"
    force: bool = False
    cache: bool = True

    @property
    def has_functions(self) -> bool:
        """True if functions are written, or what an engine takes of them."""
        return self.emit == FUNCTIONS or bool(self.engines)

    @property
    def has_engine_shaders(self) -> bool:
        """True if an engine is asked for that takes whole shaders."""
        if len(self.engines) != 1:
            return False
        from ..engines import known

        (name,) = self.engines
        return name in known.names() and known.load(name).write_shaders is not None

    @property
    def prints(self) -> bool:
        """True if the shaders are printed instead of written."""
        return self.output == STDOUT

    def of_one(self, file: Path) -> CompileRequest:
        """What is asked of one file, without what is said of the outputs of all together."""
        return changed(
            self,
            files=(file,),
            depfile=None,
            depfile_target=None,
            list_outputs=False,
            form="text",
            force=False,
        )

    @property
    def uses_tools(self) -> bool:
        """True if other programs are needed, each of which runs in several processes itself."""
        return self.validate or bool(self.modules)

    @property
    def modules(self) -> tuple[str, ...]:
        """The formats of modules that are asked for."""
        words = self.emit.split(",")
        return tuple(name for name in MODULES if name in words)

    @property
    def contradiction(self) -> str | None:
        """What is wrong with options that go with each other; ``None`` if nothing is."""
        words = self.emit.split(",")
        for word in words:
            if word not in (SHADERS, *MODULES, FUNCTIONS):
                known = (SHADERS, *MODULES)
                return f"--emit takes {', '.join(known)} or {FUNCTIONS}, not '{word}'"
        if FUNCTIONS in words and len(words) > 1:
            return f"--emit {FUNCTIONS} writes nothing else: leave the other words out"
        return self._misfit or self._contradiction

    @property
    def _misfit(self) -> str | None:
        """What is wrong between options about whole shaders and those about functions."""
        if len(self.engines) > 1 or any("," in name for name in self.engines):
            return "--engine names one engine: run the command once for each"
        if self.prefix is not None and not _NAME.fullmatch(self.prefix):
            return f"--prefix is a name of letters, digits and single `_`, not '{self.prefix}'"
        if self.engines and self.targets:
            return "--engine says the targets itself: leave --target out"
        if self.has_engine_shaders:
            return self._misfit_of_engine_shaders
        if self.engines and self.together:
            return "an engine takes one function for each slot: leave --together out"
        of_others = _OF_SHADERS if self.has_functions else _OF_FUNCTIONS
        given = [row.names[-1] for row in of_others if getattr(self, row.field) not in _NOTHING]
        if self.has_functions:
            given += [] if self.hoist else [HOIST.off]
            words = "is about whole shaders: leave it out, or `--emit functions` and `--engine`"
            return f"{given[0]} {words}" if given else None
        return f"{given[0]} goes with `--emit functions` only" if given else None

    @property
    def _misfit_of_engine_shaders(self) -> str | None:
        """What does not go with an engine that takes whole shaders, in a dialect of its own."""
        rows = [*_OF_FUNCTIONS, *(row for row in _OF_SHADERS if row != PASS)]
        given = [row.names[-1] for row in rows if getattr(self, row.field) not in _NOTHING]
        if self.emit != SHADERS:
            given.append(f"--emit {self.emit}")
        return f"{given[0]} does not go with --engine {self.engines[0]}" if given else None

    @property
    def _contradiction(self) -> str | None:
        """What is wrong between options about what is written and told."""
        if self.modules and self.prints:
            return "--emit makes files of bytes: it goes with a folder, not with -o -"
        if self.optimize and "spirv" not in self.modules:
            return "--optimize is for SPIR-V: it goes with --emit spirv"
        if self.why and self.prints:
            return "--why prints reasons: it goes with a folder, not with -o -"
        if self.list_outputs and self.prints:
            return "--list-outputs names files: it goes with a folder, not with -o -"
        if self.list_outputs and (self.why or self.depfile is not None):
            other = "--why" if self.why else "--depfile"
            return f"--list-outputs prints nothing else, and writes nothing: not with {other}"
        if self.prints and self.form in ("json", "sarif"):
            return f"--format {self.form} prints a document: it goes with a folder, not with -o -"
        if self.depfile == STDOUT:
            return "--depfile is a file: what is printed are the shaders"
        if self.depfile is not None and self.prints and self.depfile_target is None:
            return "--depfile with -o - has no outputs to speak of: say what, by --depfile-target"
        if self.depfile is None and self.depfile_target is not None:
            return "--depfile-target is a name in the file of --depfile, which is not given"
        return None


_OF_FUNCTIONS = (SLOTS, TOGETHER, PREFIX)
_OF_SHADERS = (
    OPTIMIZE, PASS, WHY, VALIDATE, SINGLE_FILE, FLIP_Y, LINE_DIRECTIVES, BINDINGS, NATIVE_STAGES,
)  # fmt: skip
_NAME = re.compile("[A-Za-z][A-Za-z0-9]*(_[A-Za-z0-9]+)*")
_NOTHING: tuple[object, ...] = (None, False, ())

_VALUES = {name: row for row in OPTIONS if row.metavar for name in row.names}
_FLAGS = {
    **{name: (row.field, True) for row in OPTIONS if not row.metavar for name in row.names},
    **{row.off: (row.field, False) for row in OPTIONS if row.off},
}


def plain_request(arguments: Sequence[str]) -> CompileRequest | None:
    """Parse a command line as click does; ``None`` if click has to parse it.

    Click has to do so if the command line asks for help, has something unusual, or has a mistake.
    """
    if arguments[:1] != ["compile"] or os.name == "nt":  # On Windows, click expands wildcards.
        return None
    chosen: dict[str, Any] = {}
    words = iter(arguments[1:])
    for word in words:
        name, equals, value = word.partition("=")
        if word in _FLAGS:
            field, on = _FLAGS[word]
            chosen[field] = on
        elif name in _VALUES and (not equals or name.startswith("--")):
            if not equals:
                value = next(words, "--")
                if value.startswith("-") and value != "-":
                    return None
            row = _VALUES[name]
            if row.choices and value not in row.choices:
                return None
            given = Path(value) if row.is_path else value
            chosen[row.field] = (*chosen.get(row.field, ()), given) if row.many else given
        elif word and not word.startswith("-"):
            chosen["files"] = (*chosen.get("files", ()), Path(word))
        else:
            return None
    paths = [*chosen.get("search_path", ()), *chosen.get("files", ())]
    if "bindings" in chosen:
        paths.append(chosen["bindings"])
    if not chosen.keys() >= {"files", "output"} or not all(map(_may_be_read, paths)):
        return None
    if not _are_named_once(chosen.get("values", ())):
        return None
    request = CompileRequest(**chosen)
    return request if request.contradiction is None else None


def _may_be_read(path: Path) -> bool:
    """True if nothing forbids to read a file or folder. It need not exist."""
    return os.access(path, os.R_OK) or not os.path.lexists(path)


def _are_named_once(values: Sequence[str]) -> bool:
    """True if all values are like ``power=32``, each with another name."""
    pairs = [name_and_value(text) for text in values]
    return all(name and value for name, value in pairs) and len(dict(pairs)) == len(pairs)


def name_and_value(text: str) -> tuple[str, str]:
    """The parts of a value of ``--set``: ``power=32``."""
    name, _, value = (part.strip() for part in text.partition("="))
    return name, value


def is_range(value: str) -> bool:
    """True if a value of ``--set`` is a part of a range: ``0.3..0.5``."""
    return ".." in value
