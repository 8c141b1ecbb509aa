// What a draw call gets of a mesh: see `draw`, "Expansions" and "Patches" in docs/reflection.md.
import { bytesOf, wordsOf } from "./bytes.js";
import { write } from "./values.js";
const NONE = { vertices: {}, instances: {}, instance_count: 1, primitives: [] };
/** So many vertices one after the other, which have nothing but their numbers. */
export function bareGeometry(shader, count) {
    const { expanded_by, corners } = shader.reflection.draw ?? { expanded_by: null, corners: 3 };
    if (expanded_by === null) {
        return { attributes: [], indices: null, count, instances: 1, elements: new Map() };
    }
    const whole = Uint32Array.from({ length: count - (count % corners) }, (_, at) => at);
    return gathered(shader, NONE, corners, whole);
}
/** What a shader draws of some primitives of a mesh. */
export function geometryOf(shader, mesh, number) {
    const { draw, vertex_inputs: inputs } = shader.reflection;
    const { corners, indices: text } = mesh.primitives[number];
    const indices = wordsOf(text);
    if (draw.tessellation || draw.expanded_by)
        return gathered(shader, mesh, corners, indices);
    return {
        attributes: inputs.map((input) => streamOf(input, mesh, input.step, input.name)),
        indices,
        count: indices.length,
        instances: mesh.instance_count,
        elements: new Map(),
    };
}
/** An error if patches are to be divided in another way than the package has been made for. */
export function checkLevels({ reflection, pattern }, values) {
    if (!pattern)
        return;
    const { edges, inside } = reflection.draw.tessellation.levels;
    const levels = [...edges, ...inside].map((steps) => Math.fround(values.number(steps)));
    if (levels.some((level, at) => level !== pattern.levels[at])) {
        throw new Error(`${reflection.material} was packaged with patches of the levels ` +
            `${pattern.levels.join(", ")}, and its values say ${levels.join(", ")}: ` +
            "make the package anew");
    }
}
/** Primitives or patches that are instances: each of these has the values of all its corners. */
function gathered({ reflection, pattern }, mesh, corners, indices) {
    const count = indices.length / corners;
    const instances = mesh.instance_count * count;
    const all = reflection.vertex_inputs.map((input) => {
        const { name, corner, is_number, is_of_pattern } = input.mesh;
        if (is_of_pattern)
            return decoded(input, pattern.vertices[input.name]);
        const numbers = Uint32Array.from({ length: instances }, (_, at) => {
            if (corner !== null)
                return indices[(at % count) * corners + corner];
            return is_number && name !== "instance_index" ? at % count : Math.floor(at / count);
        });
        const type = input.representation.startsWith("u") ? "uint" : "int";
        if (is_number)
            return { input, type, lanes: 1, words: numbers };
        return picked(streamOf(input, mesh, corner === null ? "instance" : "vertex", name), numbers);
    });
    const drawn = pattern && wordsOf(pattern.indices);
    return {
        attributes: all.filter(({ input }) => !input.buffer),
        indices: drawn,
        count: drawn?.length ?? reflection.draw.vertices,
        instances,
        elements: elementsOf(all.filter(({ input }) => input.buffer), reflection.buffers, instances),
    };
}
/** The values of some vertices, in their order. */
function picked({ words, lanes, ...further }, numbers) {
    const found = new Uint32Array(numbers.length * lanes);
    numbers.forEach((number, at) => {
        found.set(words.subarray(number * lanes, (number + 1) * lanes), at * lanes);
    });
    return { ...further, lanes, words: found };
}
function streamOf(input, mesh, step, name) {
    const streams = step === "instance" ? mesh.instances : mesh.vertices;
    const stream = streams[`${input.representation} ${name}`];
    if (!stream) {
        throw new Error(`a mesh has no \`${name}\` (${input.representation}) for each ${step}`);
    }
    return decoded(input, stream);
}
function decoded(input, { type, lanes, data }) {
    return { input, type, lanes, words: new Uint32Array(bytesOf(data).buffer) };
}
/** The elements of the storage buffers that inputs are members of. */
function elementsOf(attributes, buffers, count) {
    const found = new Map();
    for (const { input, type, lanes, words } of attributes) {
        const { name, member } = input.buffer;
        const row = buffers.find((each) => each.name === name);
        if (!found.has(name))
            found.set(name, new Uint8Array(count * row.stride));
        const view = new DataView(found.get(name).buffer);
        const numbers = type === "float" ? new Float32Array(words.buffer) : words;
        const place = row.members.find((each) => each.name === member);
        for (let at = 0; at < count; at++) {
            const value = [...numbers.subarray(at * lanes, (at + 1) * lanes)];
            write(view, at * row.stride + place.offset, place, value);
        }
    }
    return found;
}
/** The attributes that step alike, as one buffer: WebGPU guarantees 16 attributes, but only 8
 * buffers. */
export function interleaved(attributes, step) {
    const members = attributes.filter(({ input }) => input.step === step);
    if (!members.length)
        return null;
    const words = members.reduce((sum, each) => sum + each.lanes, 0);
    const count = members[0].words.length / members[0].lanes;
    const data = new Uint32Array(count * words);
    let first = 0;
    const placed = members.map((attribute) => {
        const { lanes } = attribute;
        for (let at = 0; at < count; at++) {
            data.set(attribute.words.subarray(at * lanes, (at + 1) * lanes), at * words + first);
        }
        first += lanes;
        return { attribute, offset: 4 * (first - lanes) };
    });
    return { stride: 4 * words, members: placed, data };
}
