// How the vertex inputs of a mesh lie in its buffers.
/** The buffers that a shader reads vertex inputs of. */
export function interleaved({ vertex_inputs: inputs }) {
    const found = ["vertex", "instance"].map((step) => {
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
