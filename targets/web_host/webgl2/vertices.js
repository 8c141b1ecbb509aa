// The layout of the vertex inputs of a mesh in its buffers.

/** @import { Reflection, VertexInputRow } from "../generated/documents.js" */

/**
 * The layout of the inputs with one step: all of one vertex, or of one instance, after the other.
 * @typedef {object} Interleaved
 * @property {VertexInputRow["step"]} step
 * @property {number} stride
 * @property {{ input: VertexInputRow, lanes: number, offset: number }[]} members
 */

/**
 * The buffers from which a shader reads its vertex inputs.
 * @param {Reflection} reflection
 * @returns {Interleaved[]}
 */
export function interleaved({ vertex_inputs: inputs }) {
  const found = /** @type {const} */ (["vertex", "instance"]).map((step) => {
    let stride = 0;
    const members = inputs
      .filter((each) => each.step === step && !each.buffer)
      .map((input) => {
        const lanes = Number(/\d$/.exec(input.representation)?.[0] ?? 1);
        stride += 4 * lanes;
        return { input, lanes, offset: stride - 4 * lanes };
      });
    return { step, stride, members };
  });
  return found.filter(({ members }) => members.length);
}
