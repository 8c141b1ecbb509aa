"""The owners of a frame's values: whose parameter is meant by ``Clay.base``.

``FrameHost`` asks here for a name that neither the frame nor a shader has as a whole.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence

from ....compiler.diagnostics.nearest import suggestion
from ....compiler.documents.plan import DrawStep, FramePlan
from ..instances.host_values import HostValues
from ..instances.values import ParameterError


def owned_shaders(plan: FramePlan) -> Mapping[str, tuple[int, ...]]:
    """The numbers of the shaders of each material, and of each pass or kernel without one."""
    found: dict[str, dict[int, None]] = {}
    for step in plan.steps:
        for use in step.uses:
            alone = step.pass_ if isinstance(step, DrawStep) else _last(plan, use.shader)
            found.setdefault(use.material or alone, {})[use.shader] = None
    return {owner: tuple(numbers) for owner, numbers in found.items()}


def _last(plan: FramePlan, shader: int) -> str:
    """The last part of a shader's name, which is that of its kernel."""
    return plan.shaders[shader].name.rpartition(".")[2]


def check_one_type(name: str, known: Iterable[tuple[str, HostValues]]) -> None:
    """Raise ``ParameterError`` if a name has values of several types among these owners."""
    types = {owner: found for owner, values in known if (found := values.type_of(name))}
    if len(set(types.values())) > 1:
        listed = " and ".join(f"{type_} in {owner}" for owner, type_ in types.items())
        first = next(iter(types))
        raise ParameterError(
            name, f"`{name}` is {listed}: say whose is meant, as in `{first}.{name}`"
        )


def unowned(name: str, owners: Mapping[str, Sequence[HostValues]]) -> str:
    """The message about ``Mud.base`` or ``Clay.bsae``; empty for a name without an owner.

    That no owner is called ``Mud`` is told if some owner has the parameter.
    """
    owner, dot, own = name.partition(".")
    if dot and owner in owners:
        known = [row.name for each in owners[owner] for row in each.declared.parameters]
        hint = suggestion(own, known) or f"there are {', '.join(dict.fromkeys(known))}"
        return f"`{owner}` has no parameter `{own}`: {hint}"
    having = [each for each, all_of in owners.items() if any(v.type_of(own) for v in all_of)]
    if not dot or owner in owners or not having:
        return ""
    hint = suggestion(owner, having) or f"`{own}` belongs to {', '.join(having)}"
    return f"there is no material `{owner}` here: {hint}"
