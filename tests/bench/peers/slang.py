"""Slang compiles the hand-written twin of ``surface.burnish`` to HLSL, GLSL and WGSL.

The package ``slangpy`` brings Slang's compiler as a shared library. The package itself wants a
device of a graphics API for each compile, so the library's functions are called here instead. They
are declared in ``slang-deprecated.h``, which the package has, too.
"""

from __future__ import annotations

import ctypes
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

from .peer import MissingPeerError, Texts

TWIN = Path(__file__).parents[1] / "twins" / "phong.hlsl"
PACKAGE, LIBRARY = "slangpy", "libslang-compiler."
TARGETS = ((5, b"sm_6_0"), (2, b"glsl_450"), (28, b""))
"""The numbers of HLSL, GLSL and WGSL in ``SlangCompileTarget``, and the profiles to compile for."""
ENTRIES = ((b"vsmain", 1), (b"main", 5))
"""The functions of the twin, and the numbers of their stages in ``SlangStage``."""
LANGUAGE = 1
"""The number of Slang's own language, which contains HLSL, in ``SlangSourceLanguage``."""
RELEASE, DATA, SIZE = 2, 3, 4
"""The places of the methods of ``ISlangBlob`` in its table."""

SLANG = "Slang"
WAYS = {SLANG: "the hand-written twin of surface.burnish to HLSL, GLSL and WGSL, in one session"}
"""What is measured, by name."""

_Pointer = ctypes.c_void_p
_Text, _Int = ctypes.c_char_p, ctypes.c_int
_SIGNATURES: dict[str, tuple[object, tuple[object, ...]]] = {
    "spCreateSession": (_Pointer, (_Text,)),
    "spFindProfile": (_Int, (_Pointer, _Text)),
    "spCreateCompileRequest": (_Pointer, (_Pointer,)),
    "spDestroyCompileRequest": (None, (_Pointer,)),
    "spAddCodeGenTarget": (_Int, (_Pointer, _Int)),
    "spSetTargetProfile": (None, (_Pointer, _Int, _Int)),
    "spAddTranslationUnit": (_Int, (_Pointer, _Int, _Text)),
    "spAddTranslationUnitSourceString": (None, (_Pointer, _Int, _Text, _Text)),
    "spAddEntryPoint": (_Int, (_Pointer, _Int, _Text, _Int)),
    "spCompile": (_Int, (_Pointer,)),
    "spGetDiagnosticOutput": (_Text, (_Pointer,)),
    "spGetEntryPointCodeBlob": (_Int, (_Pointer, _Int, _Int, ctypes.POINTER(_Pointer))),
}
"""The types of the result and of the arguments of each function."""


def ways() -> Mapping[str, Texts]:
    """The texts of the only way.

    Raises ``MissingPeerError`` if the package is not installed, or has no such library.
    """
    try:
        session = _Session()
    except (PackageNotFoundError, OSError, AttributeError) as error:
        raise MissingPeerError(str(error)) from error
    text = TWIN.read_text("utf-8")
    return {SLANG: lambda number: session.texts(f"{text}// {number}\n")}


class _Session:
    """Slang's compiler with its own library, which it reads once.

    Raises ``PackageNotFoundError``, ``OSError`` and ``AttributeError``.
    """

    def __init__(self) -> None:
        self._library = ctypes.CDLL(str(_library()))
        for name, (result, arguments) in _SIGNATURES.items():
            function = getattr(self._library, name)
            function.restype, function.argtypes = result, arguments
        self._session = self._library.spCreateSession(None)

    def texts(self, source: str) -> Sequence[str]:
        """The texts of both stages for each target."""
        with self._request() as request:
            for target, profile in TARGETS:
                number = self._library.spAddCodeGenTarget(request, target)
                if profile:
                    found = self._library.spFindProfile(self._session, profile)
                    self._library.spSetTargetProfile(request, number, found)
            unit = self._library.spAddTranslationUnit(request, LANGUAGE, b"twin")
            self._library.spAddTranslationUnitSourceString(
                request, unit, b"twin.hlsl", source.encode()
            )
            for name, stage in ENTRIES:
                self._library.spAddEntryPoint(request, unit, name, stage)
            if self._library.spCompile(request):
                raise RuntimeError(self._library.spGetDiagnosticOutput(request).decode())
            return [
                self._text(request, entry, target)
                for target in range(len(TARGETS))
                for entry in range(len(ENTRIES))
            ]

    @contextmanager
    def _request(self) -> Iterator[int]:
        request = self._library.spCreateCompileRequest(self._session)
        try:
            yield request
        finally:
            self._library.spDestroyCompileRequest(request)

    def _text(self, request: int, entry: int, target: int) -> str:
        """The text of an entry point for a target, which lies in an object of COM."""
        blob = _Pointer()
        self._library.spGetEntryPointCodeBlob(request, entry, target, ctypes.byref(blob))
        table = ctypes.cast(blob, ctypes.POINTER(ctypes.POINTER(_Pointer))).contents
        data = ctypes.CFUNCTYPE(_Pointer, _Pointer)(table[DATA] or 0)
        size = ctypes.CFUNCTYPE(ctypes.c_size_t, _Pointer)(table[SIZE] or 0)
        release = ctypes.CFUNCTYPE(ctypes.c_uint32, _Pointer)(table[RELEASE] or 0)
        text = ctypes.string_at(data(blob) or 0, size(blob)).decode()
        release(blob)
        return text


def _library() -> Path:
    """The path of the compiler's library. Raises ``PackageNotFoundError`` and ``OSError``."""
    package = distribution(PACKAGE)
    for file in package.files or ():
        if file.name.startswith(LIBRARY):
            return Path(str(package.locate_file(file)))
    raise OSError(f"{PACKAGE} has no {LIBRARY}…")
