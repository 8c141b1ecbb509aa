"""Measures how far off the functions of each driver are: ``python -m tests.builtins.measure``.

It writes ``targets/conformance/measured.py``. Run it when a driver is updated, and read the
difference: a function that has become much worse is worth a report to the driver's makers.
``tests/conformance/test_builtins.py`` measures again, and compares.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from burnish.compiler.reference.bounds.errors import ulp
from burnish.compiler.reference.functions import evaluate
from burnish.stdlib.builtins import BUILTINS
from burnish.stdlib.builtins.accuracy import Error
from burnish.stdlib.builtins.overloads import Overload, Shape
from burnish.targets.conformance.driver_accuracy import Envelope
from burnish.targets.runner.routes import DRIVERS, ROUTES, Route
from burnish.targets.runner.runner import Runner
from burnish.targets.toolchain import Toolchain

from .on_devices import compiled, floats, returned
from .overloads import programs
from .samples import Floats

TABLE = Path(__file__).parents[2] / "targets" / "conformance" / "measured.py"
NORMAL = 2.0**-120
"""Below, results of a function that computes in several steps may be flushed to zero."""
LARGE = 2.0**120


@dataclass(frozen=True)
class Sampled:
    """Errors of one function, where its operands and its result are in its domain."""

    operand: Floats
    result: Floats
    error: Floats


Fit = Callable[[Sampled], Error]
"""Finds the least error of a form that covers the samples."""


def _of_ulps(sampled: Sampled) -> Error:
    return Error(ulp=_most(sampled.error / ulp(sampled.result)))


def _of_exponents(sampled: Sampled) -> Error:
    """Like what specifications promise of exponentials: (3 + 2 * |x|) ulp."""
    share = _most(sampled.error / ((3.0 + 2.0 * sampled.operand) * ulp(sampled.result)))
    return Error(ulp=3.0 * share, ulp_by_operand=2.0 * share)


def _absolute(sampled: Sampled, ulps: float = 1.0) -> Error:
    """An error of one unit in the last place plus an absolute error, as polynomials have."""
    return Error(ulp=ulps, absolute=_most(sampled.error - ulps * ulp(sampled.result)))


def _of_logarithms(sampled: Sampled) -> Error:
    """Results far from zero are off by more than one unit, as they are sums."""
    return _absolute(sampled, 2.0)


def _of_angles(sampled: Sampled) -> Error:
    """An absolute error within one turn, and beyond it the error of a reduction to one turn."""
    near = sampled.operand <= math.pi
    absolute = _most(sampled.error[near])
    beyond = (sampled.error - absolute)[~near] / sampled.operand[~near]
    return Error(absolute=absolute, absolute_by_operand=_most(beyond))


def _most(errors: Floats) -> float:
    return max(float(errors.max()), 0.0)


@dataclass(frozen=True)
class Function:
    """A function of one operand, or of two that have the same type, and how it is measured."""

    fit: Fit
    low: float = -LARGE
    high: float = LARGE
    """The largest operand with which it is measured; ``low`` is the smallest."""
    operands: int = 1
    divisor: bool = False
    """True if the error depends on the second operand."""


FUNCTIONS: Mapping[str, Function] = {
    "div": Function(_of_ulps, operands=2, divisor=True),
    "sqrt": Function(_of_ulps, NORMAL),
    "inversesqrt": Function(_of_ulps, NORMAL),
    "exp": Function(_of_exponents),
    "exp2": Function(_of_ulps),
    "log": Function(_of_logarithms, NORMAL),
    "log2": Function(_of_logarithms, NORMAL),
    "sin": Function(_of_angles),
    "cos": Function(_of_angles),
    "asin": Function(_absolute, -1.0, 1.0),
    "acos": Function(_absolute, -1.0, 1.0),
    "atan": Function(_absolute),
    "atan2": Function(_absolute, operands=2),
    "tanh": Function(_absolute, -16.0, 16.0),
}
"""The functions with an error of their own; that of all others is inherited from them."""


def measure(routes: Iterable[Route], runner: Runner, toolchain: Toolchain) -> dict[str, Error]:
    """The largest errors that any of the routes of a driver has, by function."""
    vector = Shape("float", 4)
    wanted = [
        Overload(BUILTINS[name], (vector,) * function.operands, vector)
        for name, function in FUNCTIONS.items()
    ]
    found: dict[str, list[Sampled]] = {name: [] for name in FUNCTIONS}
    for program in programs(wanted):
        material = compiled(program)
        for route in routes:
            lanes = returned(material, route, runner, toolchain)
            for place, got in zip(program.lanes, lanes, strict=False):
                name = place.overload.row.name
                found[name].append(_sampled(name, place.lane, got))
    return {name: FUNCTIONS[name].fit(_joined(samples)) for name, samples in found.items()}


def _sampled(name: str, lane: int, got: Floats) -> Sampled:
    function = FUNCTIONS[name]
    operands = [floats()[number][..., lane] for number in range(function.operands)]
    with np.errstate(all="ignore"):
        (value,) = evaluate(name, [(operand,) for operand in operands], np)
        error = np.abs(got - value)
    inside: NDArray[np.bool_] = (operands[0] >= function.low) & (operands[0] <= function.high)
    for number in (*operands, value):
        inside &= (np.abs(number) >= NORMAL) & (np.abs(number) <= LARGE)
    operand = np.abs(operands[1] if function.divisor else operands[0])
    return Sampled(operand[inside], np.abs(value)[inside], error[inside])


def _joined(samples: list[Sampled]) -> Sampled:
    return Sampled(
        np.concatenate([each.operand for each in samples]),
        np.concatenate([each.result for each in samples]),
        np.concatenate([each.error for each in samples]),
    )


# --- the table ------------------------------------------------------------------------------------

HEAD = '''\
"""The largest errors that were found on each driver. ``tests/builtins/measure.py`` writes it.

``driver_accuracy.py`` says what it is for, and the manual shows it beside what specifications
promise.
"""

from __future__ import annotations

from collections.abc import Mapping

from ...stdlib.builtins.accuracy import Error
from .envelope import Envelope

'''


def written(envelopes: Mapping[str, Envelope]) -> str:
    """The text of the module with these envelopes."""
    lines = [HEAD + "ENVELOPES: Mapping[str, Envelope] = {"]
    for driver, envelope in envelopes.items():
        lines += [f'    "{driver}": Envelope(', *_device(envelope.device), "        {"]
        lines += [f'            "{n}": {_error(e)},' for n, e in envelope.errors.items()]
        lines += ["        },", "    ),"]
    return "\n".join([*lines, "}", '"""By the name of the driver in routes."""', ""])


def _device(name: str) -> list[str]:
    """A device's name as a literal, in several lines if it is long."""
    parts = re.findall(r".{1,70}(?:\s|$)", name)
    if len(parts) == 1:
        return [f'        "{name}",']
    return ["        (", *(f'            "{part}"' for part in parts), "        ),"]


def _error(error: Error) -> str:
    parts = {
        "ulp": error.ulp, "ulp_by_operand": error.ulp_by_operand,
        "absolute": error.absolute, "absolute_by_operand": error.absolute_by_operand,
    }  # fmt: skip
    return f"Error({', '.join(f'{name}={_up(part)}' for name, part in parts.items() if part)})"


def _up(value: float) -> str:
    """A number rounded up to two digits."""
    step = 10.0 ** (math.floor(math.log10(value)) - 1)
    return f"{math.ceil(value / step - 1e-9) * step:.2g}"


def main() -> None:
    """Measure every driver, and write the table."""
    with Runner(ROUTES.values()) as runner, Toolchain() as toolchain:
        envelopes = {}
        for driver in DRIVERS:
            routes = [route for route in ROUTES.values() if route.driver == driver]
            device = runner.device(routes[0])
            envelopes[driver] = Envelope(
                f"{device.name} {device.version}", measure(routes, runner, toolchain)
            )
            print(driver)
    TABLE.write_text(written(envelopes), encoding="utf-8")
    print(TABLE)


if __name__ == "__main__":
    main()
