// What a draw call gets of a mesh: see `draw`, "Expansions" and "Patches" in docs/reflection.md.
import { bytesOf, wordsOf } from "./bytes.js";
import { write } from "./values.js";
/** Vertices that have nothing but their numbers. */
export function bareGeometry({ reflection }, count) {
    const draw = reflection.draw;
    if (draw.expanded_by === null) {
        return { attributes: [], indices: null, count, instances: 1, elements: new Map() };
    }
    const whole = Math.floor(count / draw.corners) * draw.corners;
    const indices = Uint32Array.from({ length: whole }, (_, at) => at);
    const none = { vertices: {}, instances: {}, instance_count: 1, primitives: [] };
    return gathered(reflection.vertex_inputs, reflection.buffers, none, draw.corners, indices, {
        indices: null, count: draw.vertices,
    });
}
/** What a shader draws of a mesh. */
export function geometryOf(shader, mesh, primitives) {
    const { draw, vertex_inputs: inputs, buffers } = shader.reflection;
    const corners = wordsOf(primitives.indices);
    if (draw.tessellation || draw.expanded_by === "instances") {
        return gathered(inputs, buffers, mesh, primitives.corners, corners, patternOf(shader));
    }
    return {
        attributes: inputs.map((input) => attribute(input, streamOf(mesh, input.step, input.representation, input.name))),
        indices: corners,
        count: corners.length,
        instances: mesh.instance_count,
        elements: new Map(),
    };
}
/** An error if patches are to be divided in another way than the package has been made for. */
export function checkLevels({ reflection, pattern }, values) {
    if (!pattern)
        return;
    const none = () => {
        throw new Error(`the levels of ${reflection.material} depend on the size of a texture`);
    };
    const { edges, inside } = reflection.draw.tessellation.levels;
    const levels = [...edges, ...inside].map((steps) => Math.fround(values.evaluated(steps, none)[0]));
    if (levels.some((level, at) => level !== pattern.levels[at])) {
        throw new Error(`${reflection.material} was packaged with patches of the levels ${pattern.levels.join(", ")}, and ` +
            `its values say ${levels.join(", ")}: make the package anew`);
    }
}
/** The vertices of a patch, as the host has divided it. */
function patternOf({ reflection, pattern }) {
    const { vertices } = reflection.draw;
    if (!pattern)
        return { indices: null, count: vertices };
    const cells = wordsOf(pattern.cells.indices);
    const { places } = pattern;
    if (vertices === null) {
        return { indices: cells, count: cells.length, pattern: { places, cells: null, corners: 1 } };
    }
    // Each vertex that a cell turns into gets where all corners of the cell lie.
    const { corners } = pattern.cells;
    return { indices: null, count: (cells.length / corners) * vertices, pattern: { places, cells, corners } };
}
/** Primitives or patches that are instances: each of these has all its inputs' values. */
function gathered(inputs, buffers, mesh, corners, indices, vertices) {
    const count = indices.length / corners;
    const instances = mesh.instance_count * count;
    const all = inputs.map((input) => attribute(input, input.mesh.is_of_pattern
        ? ofPattern(input, vertices)
        : ofPrimitives(input, mesh, corners, indices, count, instances)));
    const inBuffers = all.filter(({ input }) => input.buffer);
    return {
        attributes: all.filter(({ input }) => !input.buffer),
        indices: vertices.indices,
        count: vertices.count,
        instances,
        elements: elementsOf(inBuffers, buffers, instances),
    };
}
/** The values of an input for each primitive of each instance of the mesh. */
function ofPrimitives(input, mesh, corners, indices, count, instances) {
    const { name, corner, is_number } = input.mesh;
    const numbers = Uint32Array.from({ length: instances }, (_, at) => {
        if (corner !== null)
            return indices[(at % count) * corners + corner];
        return is_number && name !== "instance_index" ? at % count : Math.floor(at / count);
    });
    if (is_number)
        return { type: typeOf(input.representation), lanes: 1, words: numbers };
    return picked(streamOf(mesh, corner === null ? "instance" : "vertex", input.representation, name), numbers);
}
function ofPattern(input, { count, pattern }) {
    const { places, cells, corners } = pattern;
    const words = wordsOf(places.data);
    if (!cells)
        return { ...places, words };
    const perCell = count / (cells.length / corners);
    const numbers = Uint32Array.from({ length: count }, (_, at) => cells[Math.floor(at / perCell) * corners + input.mesh.corner]);
    return picked({ ...places, words }, numbers);
}
/** The values of some vertices, in their order. */
function picked({ type, lanes, words }, numbers) {
    const found = new Uint32Array(numbers.length * lanes);
    numbers.forEach((number, at) => found.set(words.subarray(number * lanes, (number + 1) * lanes), at * lanes));
    return { type, lanes, words: found };
}
function streamOf(mesh, step, representation, name) {
    const stream = (step === "instance" ? mesh.instances : mesh.vertices)[`${representation} ${name}`];
    if (!stream)
        throw new Error(`a mesh has no \`${name}\` (${representation}) for each ${step}`);
    return { type: stream.type, lanes: stream.lanes, words: new Uint32Array(bytesOf(stream.data).buffer) };
}
const typeOf = (representation) => representation.startsWith("u") ? "uint" : representation.startsWith("i") ? "int" : "float";
const attribute = (input, words) => ({ input, ...words });
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
            write(view, at * row.stride + place.offset, place, [...numbers.subarray(at * lanes, (at + 1) * lanes)]);
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
    const whole = new Uint32Array(count * words);
    let first = 0;
    const placed = members.map((each) => {
        for (let at = 0; at < count; at++) {
            whole.set(each.words.subarray(at * each.lanes, (at + 1) * each.lanes), at * words + first);
        }
        first += each.lanes;
        return { attribute: each, offset: 4 * (first - each.lanes) };
    });
    return { step, stride: 4 * words, members: placed, data: whole };
}
