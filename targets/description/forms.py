"""Forms: the small templates in a language's rows, and the rows of statements and expressions.

A *form* is a text with fields in braces, filled in by ``str.format``: ``if ({condition}) {{``. A
brace that is meant as such is doubled. ``form_fields.py`` lists which fields each form can have. A
language is compared with that when it is loaded. Besides plain fields there are these:

``{0}``, ``{1}`` …
    the operands of a native, as they stand between commas
``{0:p}``
    an operand in parentheses, unless it is a name or a call. ``:p`` works for every field that
    holds an expression: ``{value:p}``
``{going:and}``
    the same for an operand of ``&&``
``{0:factor}``
    the same for an operand of ``*`` or ``/``
``{type}``
    the type of the result; ``{lanes}`` is how many lanes that has
``{lane}``
    the word of ``Forms.lane_words`` for a native's constant operand, as gathers have one
``{sampler}``
    the sampler of a texture operand

Forms are for pieces of a line. What a whole file looks like is said by skeletons in Jinja2
(``skeleton.j2``), which get the finished pieces.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from ...support.frozen import frozen

ACCUMULATED: Mapping[str, str] = MappingProxyType(
    {"add": "{name} += {value};", "mul": "{name} *= {value};"}
)


@frozen
class Forms:
    """Expressions and statements that are not calls of builtins. The defaults are C-like.

    ``{typed}`` is a declaration as ``TypeNames.declaration`` writes it. ``form_fields.py`` lists
    the fields that each form can have; a form that it does not list is a plain text, in which no
    brace is doubled.
    """

    # Statements.
    let: str = "{typed} = {value};"
    """A statement that gives a value a name: also has ``{name}``."""
    constant_array: str = "const {typed} = {value};"
    variable: str = "{typed};"
    variable_set: str = "{typed} = {value};"
    assign: str = "{name} = {value};"
    accumulate: Mapping[str, str] = ACCUMULATED
    """An assignment that combines the variable with a value, for some natives. For others, the
    operation and the assignment are written out."""
    if_: str = "if ({condition}) {{"
    else_: str = "} else {"
    else_if: str = "}} else if ({condition}) {{"
    end: str = "}"
    """Closes what ``if_``, ``else_``, ``loop`` and ``loop_while`` open."""
    loop: str = "for ({index_typed} = {zero}; {index} < {count}; {index}++) {{"
    """A loop of ``{count}`` iterations. If the language wants a constant number, the loop has
    ``{bound}``, the largest possible count, and ``enough`` leaves the loop."""
    enough: str = ""
    """The first line in a loop of ``{bound}`` iterations: leaves the loop after ``{count}`` of
    them."""
    loop_while: str = "for ({index_typed} = {zero}; {index} < {count} && {going:and}; {index}++) {{"
    """A loop that also ends when ``going`` is false; empty if ``leave`` has to end it."""
    leave: str = "if (!{going:p}) {{ break; }}"
    """Leaves a loop in the middle of its body when ``going`` is false."""
    return_: str = "return {value};"
    discard: str = "discard;"
    """Discards the fragment."""
    deliver: str = "{name} = {value};"
    """Assigns the value of an emitted vertex to an output."""
    deliver_position: str = ""
    """Assigns the clip-space position of an emitted vertex."""
    position: str = ""
    """The variable that ``deliver_position`` assigns."""
    deliver_layer: str = ""
    """Assigns the layer of the render targets to which an emitted vertex belongs."""
    store_texel: str = ""
    """Writes a texel of the image ``{name}`` at the ``{place}``, an ``ivec2``."""
    emit_vertex: str = ""
    end_strip: str = ""

    # Declarations.
    function: str = "{type} {name}({parameters}) {{"
    parameter: str = "{typed}"
    block_argument: str = "{type} {name}"
    """A uniform block as a parameter, where ``Language.resource_arguments`` makes it one."""
    buffer_argument: str = "{type} {name}"
    """A storage buffer as a parameter, with the ``{type}`` of its elements."""
    written_argument: str = "{type} {name}"
    """A storage buffer that a kernel writes, as a parameter."""
    atomic: str = "{type}"
    """The type of an element that a kernel scatters to, whose plain type is ``{type}``."""
    scatter: str = "{function}({place}, {value});"
    """Combines a ``{value}`` with the element at a ``{place}`` by one of ``Language.atomics``."""
    shared: str = ""
    """A variable that the invocations of a work group share."""
    shared_argument: str = ""
    """A shared variable of a ``{type}`` as a parameter of a function; empty if such variables are
    global."""
    barrier: str = ""
    """A barrier: waits until all invocations of a work group have reached it, and see the values
    that the others have written to shared variables."""
    member_end: str = ";"
    """Ends a member of a struct or block."""
    struct_end: str = "};"

    # Expressions.
    select: str = ""
    """``select({otherwise}, {then}, {condition})``; empty for ``?:``."""
    at_most: str = "min({value}, {bound})"
    """The smaller of two integers."""
    constructor: str = "{type}({parts})"
    """A vector from its lanes and from shorter vectors, or a constant from its lanes."""
    splat: str = "{type}({value})"
    """A scalar in every lane; ``{value:p}.{lanes}`` where that is a swizzle."""
    splat_constant: bool = True
    """True if a constant whose lanes are equal is written with one of them."""
    matrix: str = "{type}({columns})"
    """A matrix from its ``{columns}``, which ``{transposed}`` would take for rows."""
    matrix_by_rows: bool = False
    """True if a constant matrix lists its lanes row by row."""
    product_of_stored: str = ""
    """A stored ``{matrix}`` times a ``{vector}``, where it is written as a square one: ``{zeros}``
    are the lanes that the vector has not got."""
    product_of_columns: str = ""
    """A matrix from its ``{columns}`` times a ``{vector}``, if that is shorter than ``matrix``."""
    lane: str = "{vector:p}.{lanes}"
    """One lane of a vector."""
    swizzle: str = "{vector:p}.{lanes}"
    """Several lanes of a vector, as a vector of the plain ``{type}``."""
    element: str = "{aggregate:p}[{position}]"
    """An element of an array, or a computed lane of a vector."""
    column: str = "{matrix:p}[{position}]"
    array: str = "{type}({elements})"
    """An array from its elements; empty where each element has to be assigned."""
    array_of_block: bool = True
    """True if an array can also be made of all members of a block, in their order."""
    member: str = "{name}"
    """A parameter: ``{name}``, or ``{block}.{name}`` where a block is a variable."""
    stored: str = "{value}"
    """A member of a block of one of the types in ``TypeNames.stored``, as the plain ``{type}``."""
    texture: str = "{texture}"
    """A texture read by its sampler, called ``{sampler}``; ``{type}`` is that of both in one."""
    input: str = "{name}"
    """A stage's input: a global variable, or ``input.{name}``."""
    corner: str = "{name}[{corner}]"
    """An input of one corner, in a stage that gets whole primitives."""
    of_patch: str = "{name}"
    """An input that is the same for a whole patch, read at a vertex of the divided patch."""
    edge_level: str = ""
    """The place to which a control stage writes the level of an edge, by its ``{number}``."""
    inner_level: str = ""
    """The place to which a control stage writes an inner level, by its ``{number}``."""
    lanes: str = "xyzw"
    """The letters of the lanes."""
    lane_words: tuple[str, ...] = ()
    """The texts that replace ``{lane}``, one for each of the four lanes."""
