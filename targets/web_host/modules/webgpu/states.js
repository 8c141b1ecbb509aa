// What reflections say of the fixed functions of a pipeline, in the words of WebGPU.
import { hasStencil } from "../bytes.js";
/** A word of a reflection as WebGPU writes it. */
const word = (text) => text.replaceAll("_", "-");
/** How a target is blended, and which of its lanes are written. */
export function colorTarget({ blend, mask }, format) {
    const lanes = mask === "none" ? [] : [...mask];
    const writeMask = lanes.reduce((bits, lane) => bits | (1 << "rgba".indexOf(lane)), 0);
    if (!blend)
        return { format, writeMask };
    const equations = { color: component(blend.color), alpha: component(blend.alpha) };
    return { format, writeMask, blend: equations };
}
const component = ({ source, destination, operation }) => ({
    operation: word(operation), srcFactor: word(source), dstFactor: word(destination),
});
/** Depth test, bias and stencil test. Lines of a mesh are never moved by a bias. */
export function depthStencil({ depth, stencil }, format, topology) {
    return {
        format,
        depthWriteEnabled: depth.write,
        depthCompare: word(depth.compare),
        ...(depth.bias && topology === "triangle" && {
            depthBias: depth.bias.constant,
            depthBiasSlopeScale: depth.bias.slope,
            depthBiasClamp: depth.bias.clamp,
        }),
        ...(stencil && hasStencil(format) && {
            stencilFront: stencilSide(stencil.front),
            stencilBack: stencilSide(stencil.back),
            stencilReadMask: stencil.read_mask,
            stencilWriteMask: stencil.write_mask,
        }),
    };
}
const stencilSide = ({ compare, fail, depth_fail, pass }) => ({
    compare: word(compare), failOp: word(fail), depthFailOp: word(depth_fail), passOp: word(pass),
});
/** One buffer for the inputs of vertices and one for those of instances, as `interleaved` makes
 * them. */
export function vertexBuffers({ vertex_inputs: inputs }) {
    return ["vertex", "instance"].flatMap((stepMode) => {
        const members = inputs.filter((each) => each.step === stepMode && !each.buffer);
        let arrayStride = 0;
        const attributes = members.map(({ representation, location }) => {
            const lanes = Number(/\d$/.exec(representation)?.[0] ?? 1);
            const offset = arrayStride;
            arrayStride += 4 * lanes;
            return { format: vertexFormat(representation, lanes), offset, shaderLocation: location };
        });
        return members.length ? [{ arrayStride, stepMode, attributes }] : [];
    });
}
function vertexFormat(representation, lanes) {
    const type = { u: "uint32", i: "sint32" }[representation[0]] ?? "float32";
    return (lanes > 1 ? `${type}x${lanes}` : type);
}
