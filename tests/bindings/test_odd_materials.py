"""Bindings of materials whose names and values are those at which bindings could stumble."""

from __future__ import annotations

import json
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest

import burnish
from burnish.compiler.documents.writing import to_json

from ..suite.processes import run

pytestmark = pytest.mark.xdist_group("bindings")

ODD = """\
import std.lights.{Point}
import std.terms.{lambert}

material Odd {
    param parameters : float = 1
    param flag : bool = true
    param wet  : bool = true
    param f32  : float = 1
    param vec3_padded : vec3 = vec3(1)
    param all : int in -2147483648..2147483647 = 1
    param burnish : uint in 0..7 = 1
    lit   = float(all) * float(burnish)
    tint  = if flag and wet then parameters * f32 * vec3_padded + lit else vec3(0)
    color = lambert(tint)
}

light Counted : Point { param lamps : float = 1 }
rig Lit { lamps : Point[<= 2]  set : Counted }
"""
STALE = "fits\n"
ROOM = "`lamps` has room for 2 elements\n"

C = """\
#include "odd.h"
#include <stdio.h>
static void say(const char* told) { puts(told ? told : "fits"); }
int main(void) {
    static char text[1 << 20];
    if (fgets(text, sizeof text, stdin)) say(burnish_stale(&odd_odd, text));
    odd_LitRig rig = odd_default_lit_rig();
    rig.lamps_count = 1000000;
    say(odd_fault_lit_rig(&rig));
    return 0;
}
"""
CPP = """\
#include "odd.hpp"
#include <iostream>
#include <string>
static void say(const char* told) { std::cout << (told ? told : "fits") << "\\n"; }
int main() {
    std::string text;
    std::getline(std::cin, text);
    say(burnish::stale(burnish::odd::odd, text));
    burnish::odd::LitRig rig;
    rig.lamps_count = 1000000;
    say(fault(rig));
}
"""
PROGRAMS = {
    "c": ("gcc", "-std=c11", "odd.h", "main.c", C),
    "cpp": ("g++", "-std=c++17", "odd.hpp", "main.cpp", CPP),
}


@pytest.mark.parametrize("language", PROGRAMS)
def test_a_count_beyond_the_room_is_told_and_a_fresh_binding_fits(
    language: str, tmp_path: Path
) -> None:
    compiler, standard, header, file, program = PROGRAMS[language]
    text = burnish.bind(ODD, language, "wgsl", namespace="odd")
    (tmp_path / header).write_text(text, "utf-8")
    (tmp_path / file).write_text(program, "utf-8")
    command = [compiler, standard, "-fsanitize=undefined", "-fno-sanitize-recover", file, "-lm"]
    run([*command, "-o", "main"], cwd=tmp_path, check=True)
    (material,) = burnish.compile(ODD, "wgsl")
    given = json.dumps(to_json(material.reflection))
    done = run([str(tmp_path / "main")], text=given, check=True)
    assert done.stdout == STALE + ROOM


@pytest.mark.parametrize("language", PROGRAMS)
def test_names_beside_those_of_the_binding_give_no_warning(language: str, tmp_path: Path) -> None:
    compiler, standard, header, *_ = PROGRAMS[language]
    text = burnish.bind(ODD, language, "wgsl", namespace="burnish")
    (tmp_path / header).write_text(text, "utf-8")
    (tmp_path / f"main.{language}").write_text(f'#include "{header}"\n', "utf-8")
    warnings = ("-Wall", "-Wextra", "-Wtype-limits", "-Werror", "-Wno-unused-function")
    command = [compiler, standard, *warnings, "-fsyntax-only", f"main.{language}"]
    run(command, cwd=tmp_path, check=True)


def test_fields_in_python_may_be_called_as_the_binding_calls_types() -> None:
    module: Any = ModuleType("odd_binding")
    exec(compile(burnish.bind(ODD, "python", "wgsl"), "odd_binding.py", "exec"), module.__dict__)
    found = module.OddMaterial(flag=False, f32=2.0)
    assert (found.flag, found.wet, found.f32, found.parameters) == (False, True, 2.0, 1.0)
    (material,) = burnish.compile(ODD, "wgsl")
    module.ODD.check(to_json(material.reflection))
