// How the vertex inputs of a mesh lie in its buffers.

import type { Reflection, VertexInputRow } from "../generated/documents.js";

/** Where the inputs lie that step alike: all of one vertex, or of one instance, after the other. */
export interface Interleaved {
  step: VertexInputRow["step"];
  stride: number;
  members: { input: VertexInputRow; lanes: number; offset: number }[];
}

/** The buffers that a shader reads vertex inputs of. */
export function interleaved({ vertex_inputs: inputs }: Reflection): Interleaved[] {
  const found = (["vertex", "instance"] as const).map((step) => {
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
