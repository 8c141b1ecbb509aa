"""Frames in bindings: the steps of a plan as typed calls of what the user's engine implements.

A frame becomes three things, which each language prints:

1. ``Frame.parameters``: a ``Block`` that no shader reads. It is printed like all blocks, with
   defaults and ranges, and has the frame's parameters, those of its lights, and the sizes of the
   host's textures that something is computed of.
2. ``Frame.numbers``: a derived ``Block`` that is computed of the parameters, and of nothing else.
   It is printed like all derived blocks, with its function ``derive``. All numbers of the frame are
   in it: inputs of shaders, sizes of textures, clear values, counts of vertices and work groups.
3. ``Frame.steps``: what the function ``draw`` does, in this order.

Blocks are in ``Binding.blocks`` already. **What a printer of a language has to add:**

- for each material, a type with all of its blocks (``writing.blocks_of`` names it), which computes
  the derived ones of the others: ``Plastic Blocks``;
- for each frame, a table (``writing.table_of``) of its ``textures``, ``buffers``, ``kept``,
  ``outputs`` and ``plan.models``;
- for each frame, a function ``draw SHADOWS(host, parameters)`` (``writing.drawing``) which calls an
  interface that the engine implements, with the language's own spelling of these functions:

  - ``begin(frame, sizes, counts) -> bool``: the textures, with their sizes, and the buffers, with
    their numbers of elements, have to be there from here on. Returns true if the results of the
    last frame are: all kept ones are as large as before. ``is_first`` is the opposite of it.
  - ``begin_pass(pass)``: the attachments with their load, clear and resolve, the viewport, the
    scissor and the blend constant; barriers for APIs that need them are in ``Pass.row``.
  - ``draw_models(tag, uses)``: each model with this tag, in the order of the scene, by the use for
    its material. ``fill(use, vertices)``: as many vertices without vertex inputs.
  - ``end_pass()``, ``dispatch(use, groups, images, buffers)``, ``copy(source, target)``.
  - ``end(frame)``: the textures and buffers of each row of ``kept`` are exchanged.

A use is a shader, one of the binding's materials, and a function ``give``, which sets the fields of
the shader's blocks that the frame decides (``Use.gives``), and ``reads``, the textures and buffers
that the frame decides. The host sets all others before ``give``: camera, model, material. It
computes the derived blocks behind it.

``Place.way`` of a give has ``None`` where the number of the light stands, if ``Drawn.light`` is an
array: ``draw_models`` and ``fill`` are called in a loop over the lights then. ``Pass.layers`` is
the number of passes with the layers 0, 1 …, one after the other, if it is not 1; the field
``Use.layer`` is set to the layer. Steps with ``only_first`` are done if ``is_first``, and
``initially`` is given and read then instead (``Frame.asks_for_first`` tells if that matters).

``typescript/frames.py`` and ``typescript/frames.ts.j2`` show all of it.
"""
