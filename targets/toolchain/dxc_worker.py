"""A process that compiles HLSL with DXC's library, one JSON request and one JSON answer per line.

``checkers.py`` starts it as a script, with the library's path as its argument. It imports nothing
of Burnish. DXC may abort the whole process; so it runs in this one.

DXC's interface is COM, here without Windows: an object starts with a pointer to its table of
methods. In the releases for which this works, ``IUnknown`` has a virtual destructor, which takes
two places in the table after QueryInterface, AddRef and Release.
"""

from __future__ import annotations

import base64
import ctypes
import json
import os
import sys
import uuid
from typing import Any

RELEASE = 2
BLOB_POINTER, BLOB_SIZE = 5, 6
COMPILE, DISASSEMBLE = 5, 6
RESULT_STATUS, RESULT_OUTPUT, RESULT_ERRORS = 5, 6, 7

CLSID_COMPILER = uuid.UUID("73e22d93-e6ce-47f3-b5bf-f0664f39c1b0").bytes_le
IID_COMPILER3 = uuid.UUID("228b4687-5a6a-4730-900c-9702b2203f54").bytes_le
IID_RESULT = uuid.UUID("58346cda-dde7-4497-9461-6f87af5e0659").bytes_le

UTF8 = 65001
BINARY = 0


class _Buffer(ctypes.Structure):
    """``DxcBuffer``: bytes that DXC reads, with their encoding."""

    _fields_ = (
        ("data", ctypes.c_char_p),
        ("size", ctypes.c_size_t),
        ("encoding", ctypes.c_uint32),
    )


def _call(this: ctypes.c_void_p, slot: int, *arguments: Any, returns: Any = ctypes.c_int32) -> Any:
    """Call a method of a COM object; every argument is a ctypes value."""
    table = ctypes.cast(this, ctypes.POINTER(ctypes.POINTER(ctypes.c_void_p)))[0]
    prototype = ctypes.CFUNCTYPE(returns, ctypes.c_void_p, *(type(value) for value in arguments))
    return prototype(table[slot])(this, *arguments)


def _address(value: Any) -> ctypes.c_void_p:
    return ctypes.cast(ctypes.pointer(value), ctypes.c_void_p)


def _blob(result: ctypes.c_void_p, slot: int) -> bytes:
    """The bytes of a blob that a getter of ``IDxcResult`` returns; empty if there is none."""
    blob = ctypes.c_void_p()
    _call(result, slot, _address(blob))
    if not blob:
        return b""
    pointer = _call(blob, BLOB_POINTER, returns=ctypes.c_void_p)
    size = _call(blob, BLOB_SIZE, returns=ctypes.c_size_t)
    data = ctypes.string_at(pointer, size) if pointer else b""
    _call(blob, RELEASE)
    return data


def _text(data: bytes) -> str:
    return data.rstrip(b"\0").decode(errors="replace")


class Compiler:
    """DXC's ``IDxcCompiler3``."""

    def __init__(self, library: str) -> None:
        self._this = ctypes.c_void_p()
        create = ctypes.CDLL(library).DxcCreateInstance
        failure = create(CLSID_COMPILER, IID_COMPILER3, ctypes.byref(self._this))
        if failure or not self._this:
            raise RuntimeError(f"DxcCreateInstance failed: {failure & 0xFFFFFFFF:#x}")

    def compile(self, text: str, arguments: list[str]) -> tuple[bool, bytes, str]:
        """Compile a text: returns True if DXC accepted it, the object file, and DXC's messages."""
        words = (ctypes.c_wchar_p * len(arguments))(*arguments)
        count = ctypes.c_uint32(len(arguments))
        no_includes = ctypes.c_void_p()
        source = text.encode()
        result = self._result(COMPILE, source, UTF8, _address(words), count, no_includes)
        status = ctypes.c_int32()
        _call(result, RESULT_STATUS, _address(status))
        output, errors = _blob(result, RESULT_OUTPUT), _blob(result, RESULT_ERRORS)
        _call(result, RELEASE)
        return status.value >= 0, output, _text(errors)

    def disassemble(self, data: bytes) -> str:
        """The text of a DXIL container."""
        result = self._result(DISASSEMBLE, data, BINARY)
        output = _blob(result, RESULT_OUTPUT)
        _call(result, RELEASE)
        return _text(output)

    def _result(self, slot: int, data: bytes, encoding: int, *more: Any) -> ctypes.c_void_p:
        buffer = _Buffer(data, len(data), encoding)
        result = ctypes.c_void_p()
        wanted = ctypes.c_char_p(IID_RESULT)
        failure = _call(self._this, slot, _address(buffer), *more, wanted, _address(result))
        if failure or not result:
            raise RuntimeError(f"DXC failed: {failure & 0xFFFFFFFF:#x}")
        return result


def answer(compiler: Compiler, request: dict[str, Any]) -> dict[str, Any]:
    """The answer to one request."""
    accepted, output, log = compiler.compile(request["text"], request["arguments"])
    disassemble = accepted and request["disassemble"]
    return {
        "accepted": accepted,
        "object": base64.b64encode(output).decode(),
        "disassembly": compiler.disassemble(output) if disassemble else None,
        "log": log,
    }


def main() -> None:
    """Answer requests until the input ends; the library's own output goes to standard error."""
    with os.fdopen(os.dup(1), "w") as answers:
        os.dup2(2, 1)
        compiler = Compiler(sys.argv[1])
        for line in sys.stdin:
            answers.write(json.dumps(answer(compiler, json.loads(line))) + "\n")
            answers.flush()


if __name__ == "__main__":
    main()
