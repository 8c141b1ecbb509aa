"""Makes the documents of pages of ``burnish view``: a package to draw, with controls, or errors.

The server asks for a document when a page is opened, when it chooses something else, and after
every change to the file.
"""

from __future__ import annotations

import json
import os
import time
from collections.abc import Iterator, Mapping, Sequence
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...api import entry_points as api
from ...compiler.diagnostics.diagnostic import CompileError, Diagnostic
from ...compiler.diagnostics.render import render_all
from ...compiler.diagnostics.style import Style
from ...compiler.documents.writing import to_json
from ...targets.runner.textures.kinds import without_prefix
from ..as_asked import wishes
from ..console import remark, say, show
from ..developing import development_package
from ..failures import drawing_errors
from ..hosts import (
    is_single,
    scenery_of,
    set_pictures,
    set_values,
    set_wished,
    tell_unmade,
    tell_unused_lamps,
)
from ..kernels import feed, kernels_of
from ..options import BACKGROUND, MESHES, TONES
from ..render import render
from ..standing import standing
from ..surroundings import surround
from .keeping import Keeping, Shelf
from .pictures import Pictures, Wanted
from .request import Choice, ViewRequest
from .uploads import MOST_BYTES

if TYPE_CHECKING:
    from ...targets.runner.frames.host import FrameHost
    from ...targets.runner.frames.subjects import FrameSubject
    from ...targets.runner.instances.instance import Instance
    from ...targets.runner.kernel_results import Kernel

PROFILES = ("wgsl:webgpu", "glsl:es300")
"""The texts that a page can ask for."""
_PICTURE = "picture."
"""The beginning of the names by which a page asks for pictures; the rest is the texture's name."""
_SIZE = (512, 512)
"""The size of the picture, until the page states its size."""
_SAMPLES = 4
"""The samples in each pixel of a material."""
_MOST_NAMES = 1000
"""The most names of each kind of declaration from which a page can choose."""
_MOST_CHOICES = 1000
"""The most choices whose full form is remembered."""
_VERSIONS = count()

Made = Shelf[tuple[str, Choice], bytes]
"""Documents, by the names of their files and by choices that leave nothing open."""


class Documents:
    """The documents of a file as it is now.

    Threads may ask for the version and for kept documents; everything else is for one thread at a
    time.
    """

    def __init__(self, request: ViewRequest, name: str, pictures: Pictures, made: Made) -> None:
        """``request`` is about one file, which pages know by its ``name``."""
        self._request = request
        self._asked = request
        """The request with what the comment of the file asks for."""
        self._name = name
        self._pictures = pictures
        self._made = made
        self._number = next(_VERSIONS)
        self._whole: dict[Choice, Choice] = {}
        """The full choice for each choice that was asked for, with everything that was left
        open."""
        self._listed: dict[str, Any] = {"subjects": [], "rigs": [], "passes": []}
        """The declarations of the file; if it cannot be read, those from before."""
        self._told = ""
        """The version whose errors have been printed on the terminal."""

    @staticmethod
    def shelf(keeping: Keeping) -> Made:
        """The shelf for the documents of several files."""
        return Shelf(keeping, len)

    @property
    def file(self) -> Path:
        """The file."""
        return self._request.file

    @property
    def version(self) -> str:
        """Identifies the present contents of the file, among all files and servers."""
        return f"{os.getpid()}.{self._number}"

    @property
    def others(self) -> set[Path]:
        """The files besides sources that are drawn, as far as they exist."""
        values = (*self._asked.wished, *self._asked.values)
        named = (without_prefix(text) for _name, text in values)
        paths = [Path(part) for text in named for part in text.split(",")]
        paths.append(Path(self._request.environment))
        scene = self._request.scene
        return {path for path in (*paths, *([scene] if scene else [])) if _is_file(path)}

    def forget(self) -> None:
        """Make everything again, as the file has changed."""
        self._number = next(_VERSIONS)
        self._whole = {}
        self._made.forget(lambda key: key[0] == self._name)

    def kept(self, choice: Choice) -> bytes | None:
        """The document of a choice, if it was made and there was room to keep it."""
        whole = self._whole.get(choice._replace(file=None))
        return None if whole is None else self._made.get((self._name, whole))

    def get(self, choice: Choice) -> bytes:
        """The document of a choice, as JSON."""
        kept = self.kept(choice)
        if kept is not None:
            return kept
        choice = choice._replace(file=None)  # All choices here are of one file.
        document = {"version": self.version, **self._document(choice)}
        made = json.dumps(document, separators=(",", ":")).encode()
        whole = choice
        if chosen := document.get("chosen"):  # The page asks for it after a change.
            whole = choice_of({**chosen, "profile": choice.profile})
            whole = whole._replace(pictures=choice.pictures)
        if len(self._whole) >= _MOST_CHOICES:
            self._whole = {}
        self._whole |= {choice: whole, whole: whole}
        self._made.put((self._name, whole), made)
        self._told = self.version
        return made

    # --- one document ----------------------------------------------------------------------------

    def _document(self, choice: Choice) -> dict[str, Any]:
        began = time.perf_counter()
        try:
            made = self._drawn(choice)
        except CompileError as error:
            self._tell(error.diagnostics)
            return {**self._head(), "error": render_all(error.diagnostics, color=True)}
        except drawing_errors() as error:
            return {**self._head(), "error": self._refused(str(error))}
        except MemoryError:
            return {**self._head(), "error": self._refused("there is not enough memory for this")}
        took = 1000 * (time.perf_counter() - began)
        say(f"{made['chosen']['subject']}: made in {took:.0f} ms")
        return {**self._head(), **made}

    def _tell(self, diagnostics: tuple[Diagnostic, ...]) -> None:
        """Print the diagnostics, once for each version of the file."""
        if self._told != self.version:
            show(diagnostics)

    def _refused(self, text: str) -> str:
        """The page's text about something that cannot be drawn; the terminal gets it, too."""
        if self._told != self.version:
            remark("error", text)
        return f"{Style(True).severity('error', 'error')}: {text}"

    def _head(self) -> dict[str, Any]:
        """The fields that every document has."""
        return {
            "file": self._name,
            **self._listed,
            "meshes": [],
            "most_bytes": MOST_BYTES,
        }

    def _drawn(self, choice: Choice) -> dict[str, Any]:
        from ...targets.web_host.package import frame_package
        from ...targets.web_view.controls import controls, of_development
        from ...targets.web_view.orbit import orbit

        self._asked = self._with_wishes()
        declared = self._declared()
        chosen = self._chosen(choice, declared)
        frame = self._compiled(chosen, declared)
        host, given = self._host(frame, chosen)
        has_mesh = self._request.scene is None and _takes_mesh(frame)
        light = self._asked.exposure, self._asked.tone
        rows = [*controls(host), *of_development(host.plan, *light, TONES)]
        return {
            "chosen": {
                "subject": chosen.subject, "rig": chosen.rig, "pass": chosen.pass_,
                "mesh": chosen.mesh if has_mesh else None,
            },
            "meshes": list(MESHES) if has_mesh else [],
            "doc": frame.plan.doc,
            "controls": [{**row, "picture": given.get(row["name"])} for row in rows],
            "orbit": orbit(host.scenery),
            "package": to_json(frame_package(host, (choice.profile,))),
            "development": {
                "package": to_json(development_package(choice.profile)), "tones": TONES,
            },
        }  # fmt: skip

    def _with_wishes(self) -> ViewRequest:
        """The request, and in it what the comment of the file asks for now."""
        request = self._request
        found = wishes(request, request.named, max(_SIZE), render)
        known = {name: value for name, value in found.options.items() if name in request._fields}
        if found.note and self._told != self.version:
            remark("note", found.note)
        return request._replace(**known)

    def _declared(self) -> api.Declared:
        request = self._request
        declared = api.declared(request.file, search_path=request.search_path)
        kinds = ("frame", declared.frames), ("material", declared.materials)
        listed = [
            {"name": name, "kind": kind}
            for kind, names in (*kinds, ("kernel", declared.kernels))
            for name in names
        ]
        self._listed = {
            "subjects": listed[:_MOST_NAMES],
            "rigs": list(declared.rigs[:_MOST_NAMES]),
            "passes": list(declared.passes[:_MOST_NAMES]),
        }
        return declared

    def _chosen(self, choice: Choice, declared: api.Declared) -> Choice:
        """The full choice: everything that a choice leaves open is filled in.

        A name that the file no longer has counts as left open.
        """
        request = self._asked
        names = (*declared.frames, *declared.materials, *declared.kernels)
        subject = _first(choice.subject if choice.subject in names else None, request.material)
        subject = _first(subject, *names)
        rig = choice.rig if choice.rig in declared.rigs else None
        pass_ = choice.pass_ if choice.pass_ in declared.passes else None
        is_free = subject in declared.materials and subject not in declared.ties
        own = declared.passes if is_free and not declared.frames else ()
        return Choice(
            None,
            subject,
            _first(rig, request.rig, *declared.rigs),
            None if subject in declared.frames else _first(pass_, request.pass_, *own),
            choice.mesh if choice.mesh in MESHES else request.mesh,
            choice.profile,
            choice.pictures,
        )

    def _compiled(self, chosen: Choice, declared: api.Declared) -> FrameSubject:
        """The chosen subject as a frame."""
        from ...targets.runner.frames.single import single_frame
        from ...targets.runner.instances.literals import color_lanes

        request = self._asked
        result = api.compile(
            request.file, (chosen.profile,), material=chosen.subject, rig=chosen.rig,
            pass_=chosen.pass_, search_path=request.search_path, hoist=request.hoist,
            keep_graphs=True,
        )  # fmt: skip
        self._tell(result.diagnostics)
        if chosen.subject in declared.frames:
            return result.frames[0]
        red, green, blue = color_lanes(BACKGROUND) or (0.0, 0.0, 0.0)
        background = red, green, blue, 1.0
        if request.floor and request.scene is None and chosen.subject in declared.materials:
            return standing(
                request.file, chosen.subject, chosen.rig, (chosen.profile,), background=background,
                samples=_SAMPLES, search_path=request.search_path, hoist=request.hoist,
            )  # fmt: skip
        return single_frame(result.materials[0], background, samples=_SAMPLES)

    def _host(
        self, frame: FrameSubject, chosen: Choice
    ) -> tuple[FrameHost, dict[str, dict[str, Any]]]:
        """The frame with a scene, and with the values of the command line and the page's pictures.

        The pictures are also returned by name.
        """
        from ...targets.runner.frames.host import FrameHost
        from ...targets.runner.frames.single import captures, give_captured

        request = self._asked
        mesh = chosen.mesh or request.mesh
        host = FrameHost(frame, scenery_of(frame, request, mesh), _SIZE)
        kernels = self._kernels(host, chosen) if is_single(frame) else []
        surround([host], request.environment)
        owners: list[FrameHost | Instance] = [host, *(kernel.instance for kernel in kernels)]
        set_wished(owners, request.wished)
        set_values(owners, request.values)
        given = dict(self._give(host, chosen.pictures))
        if is_single(frame):
            set_pictures(host.instances, _SIZE)
            tell_unmade(host.instances)
            if captures(frame):
                give_captured(host, mesh, request.instances)
            if kernels:
                feed(kernels, host.instances, {}).run(1, lambda _share: None)
        tell_unused_lamps(host)
        return host, given

    def _give(
        self, host: FrameHost, pictures: Sequence[tuple[str, str]]
    ) -> Iterator[tuple[str, dict[str, Any]]]:
        """Give textures the pictures of the page, if both exist.

        Yields the page's words for each.
        """
        for name, asked in pictures:
            wanted = _wanted(host, name)
            texture = wanted and self._pictures.texture(asked, wanted)
            kept = self._pictures.get(asked)
            if wanted and texture and kept:
                host.set(name, texture)
                is_srgb = self._pictures.is_srgb(asked, wanted)
                yield name, {"file": kept.name, "is_float": kept.is_float, "is_srgb": is_srgb}

    def _kernels(self, host: FrameHost, chosen: Choice) -> list[Kernel]:
        """The other kernels of the file, if the subject reads buffers, which they may write."""
        rows = (row for each in host.instances for row in each.reflection.buffers)
        if not any(row.stages for row in rows):
            return []
        request = self._asked
        compiled = api.compile(
            request.file, (), rig=chosen.rig, search_path=request.search_path, keep_graphs=True
        )
        return [kernel for kernel in kernels_of(compiled) if kernel.name != chosen.subject]


def choice_of(query: Mapping[str, str]) -> Choice:
    """The choice that a page asks for, by the names in its address.

    Values that have no meaning are left out.
    """
    profile = query.get("profile", PROFILES[0])
    pictures = {
        key.removeprefix(_PICTURE): asked
        for key, asked in query.items()
        if key.startswith(_PICTURE)
    }
    file, subject, rig = query.get("file"), query.get("subject"), query.get("rig")
    return Choice(
        file, subject, rig, query.get("pass"), query.get("mesh"),
        profile if profile in PROFILES else PROFILES[0], tuple(sorted(pictures.items())),
    )  # fmt: skip


def _takes_mesh(frame: FrameSubject) -> bool:
    """True if a mesh of the page's choice is drawn, or captured."""
    from ...targets.runner.frames.single import captures

    return bool(frame.plan.models) or captures(frame)


def _wanted(host: FrameHost, name: str) -> Wanted | None:
    """The kind of the texture of this name, if there is one."""
    owner = host.owner_of(name)
    own = name.removeprefix(f"{owner}.") if owner else name
    for values in host.owners[owner] if owner else (host.values, *host.instances):
        for row in values.declared.textures:
            if row.name == own:
                return Wanted(row.dimension, row.sample)
    return None


def _first(*names: str | None) -> str | None:
    return next((name for name in names if name), None)


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):  # No file has such a name.
        return False
