// Pipelines of WebGPU, each made once when a frame is opened.
import { formatOf, hasStencil } from "../bytes.js";
import { ShaderStage } from "./device.js";
export const PROFILE = "wgsl:webgpu";
const keyOf = (shader, { targets, depth }) => [shader, ...targets, depth].join(" ");
/** All pipelines of a frame, by shader and the formats of what it draws to. */
export class Pipelines {
    device;
    made = new Map();
    constructor(device) {
        this.device = device;
    }
    static async of(device, { plan, shaders }) {
        const found = new Pipelines(device);
        const wanted = new Map();
        const want = (shader, formats) => wanted.set(keyOf(shader, formats), [shader, formats]);
        const format = ({ texture }) => formatOf(plan.textures[texture].format);
        for (const step of plan.steps) {
            if (step.kind === "draw") {
                const formats = { targets: step.targets.map(format), depth: step.depth && format(step.depth) };
                step.draws.forEach(({ uses }) => uses.forEach(({ shader }) => want(shader, formats)));
            }
            else if (step.kind === "run") {
                const drawn = "fragment" in shaders[step.shader].texts[PROFILE];
                want(step.shader, { targets: drawn ? step.images.map(format) : [], depth: null });
            }
        }
        await Promise.all([...wanted].map(async ([key, [shader, formats]]) => {
            found.made.set(key, await found.make(shaders[shader], formats));
        }));
        device.check();
        return found;
    }
    get(shader, targets, depth) {
        return this.made.get(keyOf(shader, { targets, depth }));
    }
    async make({ reflection, texts }, formats) {
        const { compute, vertex, fragment } = texts[PROFILE] ?? {};
        if (!compute && !vertex)
            throw new Error(`${reflection.material} has no text for ${PROFILE}`);
        const { gpu } = this.device;
        const layouts = slotsOf(reflection).map((slots) => gpu.createBindGroupLayout({
            entries: slots.map((slot) => layoutEntry(reflection, slot, compute ? ShaderStage.COMPUTE : ShaderStage.DRAWN)),
        }));
        const layout = gpu.createPipelineLayout({ bindGroupLayouts: layouts });
        if (compute) {
            const stage = await this.stage(reflection, compute);
            return { layouts, compute: await gpu.createComputePipelineAsync({ layout, compute: stage }) };
        }
        const { backends, draw, render_state: state } = reflection;
        if (state.fill === "lines")
            throw new Error(`WebGPU cannot draw the edges of triangles, as ${reflection.material} asks`);
        const render = await gpu.createRenderPipelineAsync({
            layout,
            vertex: { ...(await this.stage(reflection, vertex)), buffers: vertexBuffers(reflection) },
            fragment: { ...(await this.stage(reflection, fragment)), targets: this.targets(reflection, formats.targets) },
            primitive: {
                topology: `${draw?.topology ?? "triangle"}-list`,
                cullMode: state.cull,
                frontFace: backends[PROFILE].front_face,
            },
            ...(formats.depth && { depthStencil: depthStencil(state, formats.depth, draw?.topology) }),
        });
        return { layouts, render };
    }
    async stage({ material }, { text, entry }) {
        const module = this.device.gpu.createShaderModule({ code: text });
        const { messages } = await module.getCompilationInfo();
        const wrong = messages.filter(({ type }) => type === "error");
        if (wrong.length) {
            const lines = wrong.map(({ lineNum, linePos, message }) => `${lineNum}:${linePos}: ${message}`);
            throw new Error(`the browser refuses a text of ${material}:\n${lines.join("\n")}`);
        }
        return { module, entryPoint: entry };
    }
    targets({ targets, material }, formats) {
        return formats.map((format, at) => {
            const { blend, mask } = targets[at];
            if (blend && /32float/.test(format) && !this.device.gpu.features.has("float32-blendable")) {
                throw new Error(`this device cannot blend ${format}, which ${material} does: it lacks float32-blendable`);
            }
            const writeMask = [..."rgba"].reduce((bits, lane, at) => bits | (written(mask, lane) ? 1 << at : 0), 0);
            if (!blend)
                return { format, writeMask };
            return { format, writeMask, blend: { color: component(blend.color), alpha: component(blend.alpha) } };
        });
    }
}
function depthStencil({ depth, stencil }, format, topology = "triangle") {
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
/** A word of a reflection as WebGPU writes it. */
const word = (text) => text.replaceAll("_", "-");
const written = (mask, lane) => mask !== "none" && mask.includes(lane);
const component = ({ source, destination, operation }) => ({
    operation: word(operation), srcFactor: word(source), dstFactor: word(destination),
});
/** One buffer for the inputs of vertices and one for those of instances, as `interleaved` makes
 * them. */
function vertexBuffers({ vertex_inputs: inputs }) {
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
    const type = representation.startsWith("u") ? "uint32" : representation.startsWith("i") ? "sint32" : "float32";
    return (lanes > 1 ? `${type}x${lanes}` : type);
}
/** What a shader reads and writes, by group; a group that is not used is empty. */
export function slotsOf(reflection) {
    const { blocks, buffers, images, textures, samplers } = reflection.backends[PROFILE];
    const found = [];
    const add = ({ group, binding }, slot) => {
        while (found.length <= group)
            found.push([]);
        found[group].push({ ...slot, binding });
    };
    for (const { name } of reflection.blocks)
        add(blocks[name], { kind: "block", name });
    for (const [written, rows] of [[false, reflection.buffers], [true, reflection.results]]) {
        for (const { name } of rows)
            if (buffers[name])
                add(buffers[name], { kind: "buffer", name, written });
    }
    reflection.targets.forEach(({ name }, number) => {
        if (images[name])
            add(images[name], { kind: "image", number });
    });
    for (const { name } of reflection.textures) {
        if (textures[name])
            add(textures[name], { kind: "texture", name });
        if (samplers[name])
            add(samplers[name], { kind: "sampler", name });
    }
    return found;
}
// The layout that WebGPU infers would leave out bindings that a text does not use.
function layoutEntry(reflection, slot, visibility) {
    const entry = { binding: slot.binding, visibility };
    switch (slot.kind) {
        case "block":
            return { ...entry, buffer: {} };
        case "buffer":
            return { ...entry, buffer: { type: slot.written ? "storage" : "read-only-storage" } };
        case "image": {
            const format = formatOf(reflection.targets[slot.number].format);
            return { ...entry, storageTexture: { format } };
        }
    }
    const { layout } = reflection.textures.find(({ name }) => name === slot.name);
    const { viewDimension, sampleType, sampler } = layout;
    if (slot.kind === "sampler")
        return { ...entry, sampler: { type: sampler } };
    return { ...entry, texture: { viewDimension, sampleType } };
}
