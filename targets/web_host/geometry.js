// The geometry of a draw call: see `draw`, "Expansions" and "Patches" in docs/reflection.md.

import { bytesOf } from "./bytes.js";
import { present } from "./present.js";

/**
 * @import { GeometryRow, PackagedShader, Reflection } from "./generated/documents.js"
 * @import { Values } from "./values.js"
 */

/** @typedef {ReturnType<typeof unpacked>} Mesh */

/**
 * The geometry of a package, decoded from base64 to bytes. Without indices, the vertices are drawn
 * in order.
 * @param {GeometryRow} geometry
 */
export function unpacked({ count, instance_count, ...packed }) {
  return {
    count,
    instance_count,
    vertices: bytesOf(packed.vertices),
    instances: bytesOf(packed.instances),
    indices: packed.indices === null ? null : bytesOf(packed.indices),
    /** The storage buffers that hold vertex inputs, by name. */
    elements: packed.elements.map(({ name, data }) => ({ name, bytes: bytesOf(data) })),
  };
}

/**
 * A mesh of `count` vertices in order that have no inputs but their numbers. If primitives are
 * instances, the numbers are vertex inputs.
 * @param {Reflection} reflection
 * @param {number} count
 * @returns {Mesh}
 */
export function bareMesh({ draw, vertex_inputs: inputs }, count) {
  const none = new Uint8Array(0);
  const mesh = { vertices: none, instances: none, indices: null, elements: [] };
  if (!draw?.expanded_by) return { ...mesh, count, instance_count: 1 };
  const primitives = Math.floor(count / draw.corners);
  const numbers = Uint32Array.from({ length: primitives * inputs.length }, (_, at) => {
    const { corner, name } = present(inputs[at % inputs.length].mesh);
    const primitive = Math.floor(at / inputs.length);
    if (corner !== null) return primitive * draw.corners + corner;
    return name === "instance_index" ? 0 : primitive;
  });
  const instances = new Uint8Array(numbers.buffer);
  return { ...mesh, instances, count: present(draw.vertices), instance_count: primitives };
}

/**
 * Throws an error if patches are to be divided into other levels than the package was made for.
 * @param {PackagedShader} shader
 * @param {Values} values
 */
export function checkLevels({ reflection, levels: packaged }, values) {
  if (!packaged) return;
  const { edges, inside } = present(reflection.draw.tessellation?.levels);
  const levels = [...edges, ...inside].map((steps) =>
    Math.fround(/** @type {number[]} */ (values.evaluated(steps))[0]),
  );
  if (levels.some((level, at) => level !== packaged[at])) {
    throw new Error(
      `${reflection.material} was packaged with patches of the levels ${packaged.join(", ")}, ` +
        `and its values say ${levels.join(", ")}: make the package anew`,
    );
  }
}
