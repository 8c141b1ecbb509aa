// What a draw call gets of a mesh: see `draw`, "Expansions" and "Patches" in docs/reflection.md.

import { bytesOf, wordsOf } from "./bytes.js";
import { write, type Values } from "./values.js";
import type { BufferRow, Mesh, PackagedShader, Primitives, Stream, VertexInput } from "./types.js";

/** The numbers of a vertex input, one after the other for each vertex or instance. */
export interface Attribute {
  input: VertexInput;
  type: Stream["type"];
  lanes: number;
  words: Uint32Array;
}

export interface Geometry {
  attributes: Attribute[];
  /** Null where vertices are drawn one after the other. */
  indices: Uint32Array<ArrayBuffer> | null;
  count: number;
  instances: number;
  /** Elements of storage buffers that stand for vertex inputs, by the buffer's name. */
  elements: Map<string, Uint8Array<ArrayBuffer>>;
}

/** Vertices that have nothing but their numbers. */
export function bareGeometry({ reflection }: PackagedShader, count: number): Geometry {
  const draw = reflection.draw!;
  if (draw.expanded_by === null) {
    return { attributes: [], indices: null, count, instances: 1, elements: new Map() };
  }
  const whole = Math.floor(count / draw.corners) * draw.corners;
  const indices = Uint32Array.from({ length: whole }, (_, at) => at);
  const none = { vertices: {}, instances: {}, instance_count: 1, primitives: [] };
  return gathered(reflection.vertex_inputs, reflection.buffers, none, draw.corners, indices, {
    indices: null, count: draw.vertices!,
  });
}

/** What a shader draws of a mesh. */
export function geometryOf(shader: PackagedShader, mesh: Mesh, primitives: Primitives): Geometry {
  const { draw, vertex_inputs: inputs, buffers } = shader.reflection;
  const corners = wordsOf(primitives.indices);
  if (draw!.tessellation || draw!.expanded_by === "instances") {
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

type Vertices = Pick<Geometry, "indices" | "count"> & { pattern?: Pattern };

interface Pattern {
  places: Stream;
  /** For each vertex of the draw the cell that it is a corner of. */
  cells: Uint32Array | null;
  corners: number;
}

/** An error if patches are to be divided in another way than the package has been made for. */
export function checkLevels({ reflection, pattern }: PackagedShader, values: Values): void {
  if (!pattern) return;
  const none = () => {
    throw new Error(`the levels of ${reflection.material} depend on the size of a texture`);
  };
  const { edges, inside } = reflection.draw!.tessellation!.levels!;
  const levels = [...edges, ...inside].map((steps) => Math.fround((values.evaluated(steps, none) as number[])[0]));
  if (levels.some((level, at) => level !== pattern.levels[at])) {
    throw new Error(
      `${reflection.material} was packaged with patches of the levels ${pattern.levels.join(", ")}, and ` +
        `its values say ${levels.join(", ")}: make the package anew`,
    );
  }
}

/** The vertices of a patch, as the host has divided it. */
function patternOf({ reflection, pattern }: PackagedShader): Vertices {
  const { vertices } = reflection.draw!;
  if (!pattern) return { indices: null, count: vertices! };
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
function gathered(
  inputs: VertexInput[], buffers: BufferRow[], mesh: Mesh, corners: number, indices: Uint32Array, vertices: Vertices,
): Geometry {
  const count = indices.length / corners;
  const instances = mesh.instance_count * count;
  const all = inputs.map((input) =>
    attribute(
      input,
      input.mesh!.is_of_pattern
        ? ofPattern(input, vertices)
        : ofPrimitives(input, mesh, corners, indices, count, instances),
    ),
  );
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
function ofPrimitives(
  input: VertexInput, mesh: Mesh, corners: number, indices: Uint32Array, count: number, instances: number,
): Words {
  const { name, corner, is_number } = input.mesh!;
  const numbers = Uint32Array.from({ length: instances }, (_, at) => {
    if (corner !== null) return indices[(at % count) * corners + corner];
    return is_number && name !== "instance_index" ? at % count : Math.floor(at / count);
  });
  if (is_number) return { type: typeOf(input.representation), lanes: 1, words: numbers };
  return picked(streamOf(mesh, corner === null ? "instance" : "vertex", input.representation, name), numbers);
}

function ofPattern(input: VertexInput, { count, pattern }: Vertices): Words {
  const { places, cells, corners } = pattern!;
  const words = wordsOf(places.data);
  if (!cells) return { ...places, words };
  const perCell = count / (cells.length / corners);
  const numbers = Uint32Array.from(
    { length: count },
    (_, at) => cells[Math.floor(at / perCell) * corners + input.mesh!.corner!],
  );
  return picked({ ...places, words }, numbers);
}

interface Words {
  type: Stream["type"];
  lanes: number;
  words: Uint32Array;
}

/** The values of some vertices, in their order. */
function picked({ type, lanes, words }: Words, numbers: Uint32Array): Words {
  const found = new Uint32Array(numbers.length * lanes);
  numbers.forEach((number, at) => found.set(words.subarray(number * lanes, (number + 1) * lanes), at * lanes));
  return { type, lanes, words: found };
}

function streamOf(mesh: Mesh, step: string, representation: string, name: string): Words {
  const stream = (step === "instance" ? mesh.instances : mesh.vertices)[`${representation} ${name}`];
  if (!stream) throw new Error(`a mesh has no \`${name}\` (${representation}) for each ${step}`);
  return { type: stream.type, lanes: stream.lanes, words: new Uint32Array(bytesOf(stream.data).buffer) };
}

const typeOf = (representation: string): Stream["type"] =>
  representation.startsWith("u") ? "uint" : representation.startsWith("i") ? "int" : "float";

const attribute = (input: VertexInput, words: Words): Attribute => ({ input, ...words });

/** The elements of the storage buffers that inputs are members of. */
function elementsOf(attributes: Attribute[], buffers: BufferRow[], count: number): Geometry["elements"] {
  const found: Geometry["elements"] = new Map();
  for (const { input, type, lanes, words } of attributes) {
    const { name, member } = input.buffer!;
    const row = buffers.find((each) => each.name === name)!;
    if (!found.has(name)) found.set(name, new Uint8Array(count * row.stride));
    const view = new DataView(found.get(name)!.buffer);
    const numbers = type === "float" ? new Float32Array(words.buffer) : words;
    const place = row.members!.find((each) => each.name === member)!;
    for (let at = 0; at < count; at++) {
      write(view, at * row.stride + place.offset, place, [...numbers.subarray(at * lanes, (at + 1) * lanes)]);
    }
  }
  return found;
}

/** The attributes that step alike, as one buffer: WebGPU guarantees 16 attributes, but only 8
 * buffers. */
export function interleaved(attributes: Attribute[], step: "vertex" | "instance"): Interleaved | null {
  const members = attributes.filter(({ input }) => input.step === step);
  if (!members.length) return null;
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

export interface Interleaved {
  step: "vertex" | "instance";
  stride: number;
  members: { attribute: Attribute; offset: number }[];
  data: Uint32Array<ArrayBuffer>;
}
