// What reflections say of the fixed functions of a pipeline, in the words of WebGPU.
import { hasStencil } from "../bytes.js";
import { interleaved } from "../geometry.js";
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
export function vertexBuffers(reflection) {
    return interleaved(reflection).map(({ step, stride, members }) => ({
        arrayStride: stride,
        stepMode: step,
        attributes: members.map(({ input, lanes, offset }) => {
            const type = { u: "uint32", i: "sint32" }[input.representation[0]] ?? "float32";
            const format = (lanes > 1 ? `${type}x${lanes}` : type);
            return { format, offset, shaderLocation: input.location };
        }),
    }));
}
