"""The command line of ``burnish view``: options, and messages on the terminal."""

from __future__ import annotations

import os
import webbrowser
from pathlib import Path
from threading import Thread
from typing import Any

import click

from ..console import say
from ..failures import errors_as_messages, fail, needed
from ..options import (
    budget_option,
    environment_option,
    exposure_option,
    eye_option,
    floor_option,
    hoist_option,
    instances_option,
    look_at_option,
    mesh_option,
    pass_option,
    plain_option,
    rig_option,
    scene_option,
    search_option,
    tone_option,
    turn_option,
    values_option,
    variant_option,
)
from .request import ViewRequest


@click.command()
@click.argument("file", metavar="FILE|FOLDER", type=click.Path(path_type=Path))
@mesh_option
@floor_option
@scene_option
@variant_option
@environment_option
@eye_option
@look_at_option
@turn_option
@instances_option
@exposure_option
@tone_option
@values_option
@plain_option
@budget_option
@click.option(
    "--material", metavar="NAME", help="The material, kernel or frame to begin with.",
)  # fmt: skip
@click.option(
    "--port", metavar="N", default=0, type=click.IntRange(0, 65535),
    help="The port of the server, instead of any that is free.",
)  # fmt: skip
@click.option("--no-browser", is_flag=True, help="Print the address, and open no browser.")
@rig_option
@pass_option
@search_option
@hoist_option
def view(port: int, no_browser: bool, **chosen: Any) -> None:
    """Show FILE in a web page, and draw again whenever it is saved; or any file of FOLDER, of which
    the page has a list.

    The page draws with WebGPU, or with WebGL 2 in browsers that have no WebGPU. Turn the camera by
    dragging, move it with Shift or the right button, come closer by the wheel. Each parameter is a
    slider, a colour or a field beside the picture, with the range and the comment of its
    declaration. What you set stays when the file changes. Mistakes are shown in the page, over the
    last good picture, and here.

    The server listens on this computer only (127.0.0.1), and needs no network. Ctrl-C ends it.
    Values of --set are written as for `burnish render`.

    \b
    Example:
        burnish view plastic.burnish
        burnish view materials
        burnish view deferred.burnish --mesh torus --set exposure=2
        burnish view gltf_material.burnish --scene helmet.glb
        burnish view plastic.burnish --port 8000 --no-browser
    """
    from ..as_asked import named_options

    request = ViewRequest(**chosen, named=named_options(click.get_current_context()))
    if not (request.file.is_file() or request.file.is_dir()):
        fail(f"there is no file `{request.file}`")
    with errors_as_messages():
        _serve(request, port, opens=not no_browser)


def _serve(request: ViewRequest, port: int, *, opens: bool) -> None:
    from ...targets.toolchain.surroundings import search_path

    try:
        import watchfiles  # noqa: F401

        from .server import Server
    except ModuleNotFoundError as error:
        needed(error)
    try:
        server = Server(request, port)
    except OSError as error:
        fail(
            f"port {port} cannot be used: {os.strerror(error.errno or 0)}\n"
            "  = help: name another one, or leave `--port` out to get one that is free"
        )
    if server.is_empty:
        fail(f"there is nothing in the folder `{request.file}` that could be drawn")
    say(f"{request.file} is shown at {server.address}")
    say("Only this computer can open it. Ctrl-C ends it.")
    if opens:
        # The module looks for browsers by PATH, and those of the current folder are not the user's.
        os.environ["PATH"] = search_path()
        # Some browsers of terminals return only when they are closed.
        Thread(target=webbrowser.open, args=(server.address,), daemon=True).start()
    server.run()
