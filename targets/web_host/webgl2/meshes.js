// Brings meshes to WebGL 2.

import { interleaved } from "./vertices.js";

/**
 * @import { Reflection } from "../generated/documents.js"
 * @import { Mesh } from "../geometry.js"
 * @import { Gl } from "./context.js"
 * @import { Program } from "./programs.js"
 */

/**
 * The objects of WebGL with which one program draws a mesh.
 * @typedef {object} Uploaded
 * @property {WebGLVertexArrayObject} vertices
 * @property {WebGLBuffer[]} buffers
 * @property {number} count
 */

/** The mode of WebGL that draws each topology, and the number of vertices of its primitives. */
export const MODES = /** @type {const} */ ({
  "point-list": ["POINTS", 1], "line-list": ["LINES", 2], "triangle-list": ["TRIANGLES", 3],
});

/** @type {(reflection: Reflection) => keyof typeof MODES} */
export const topologyOf = ({ draw }) =>
  /** @type {keyof typeof MODES} */ (draw?.topology ?? "triangle-list");

/**
 * @param {Gl} gl
 * @param {Program} program
 * @param {Reflection} reflection
 * @param {Mesh} mesh
 * @returns {Uploaded}
 */
export function uploadMesh(gl, program, reflection, mesh) {
  const vertices = gl.createVertexArray();
  gl.bindVertexArray(vertices);
  const buffers = interleaved(reflection).map(({ step, stride, members }) => {
    const data = step === "vertex" ? mesh.vertices : mesh.instances;
    const buffer = filled(gl, gl.ARRAY_BUFFER, data);
    for (const { input: { name, representation }, lanes, offset } of members) {
      const location = program.inputs.get(name);
      if (location === undefined) continue; // not read, so left out by the linker
      gl.enableVertexAttribArray(location);
      gl.vertexAttribDivisor(location, step === "instance" ? 1 : 0);
      const kind = { i: gl.INT, u: gl.UNSIGNED_INT }[representation[0]];
      if (kind) gl.vertexAttribIPointer(location, lanes, kind, stride, offset);
      else gl.vertexAttribPointer(location, lanes, gl.FLOAT, false, stride, offset);
    }
    return buffer;
  });
  const indices = mesh.indices
    ? new Uint32Array(mesh.indices.buffer)
    : Uint32Array.from({ length: mesh.count }, (_, at) => at);
  const [, corners] = MODES[topologyOf(reflection)];
  const turned = firstVertexLast(indices, corners);
  const elements = filled(gl, gl.ELEMENT_ARRAY_BUFFER, turned);
  gl.bindVertexArray(null);
  return { vertices, buffers: [...buffers, elements], count: turned.length };
}

/**
 * @param {Gl} gl
 * @param {Uploaded} uploaded
 */
export function freeMesh(gl, { vertices, buffers }) {
  gl.deleteVertexArray(vertices);
  buffers.forEach((each) => gl.deleteBuffer(each));
}

/**
 * @param {Gl} gl
 * @param {number} kind
 * @param {AllowSharedBufferSource} data
 * @returns {WebGLBuffer}
 */
function filled(gl, kind, data) {
  const buffer = gl.createBuffer();
  gl.bindBuffer(kind, buffer);
  gl.bufferData(kind, data, gl.STATIC_DRAW);
  return buffer;
}

/**
 * The same primitives, with the first vertex of each moved to the end: a flat varying has its
 * value at the first one, but in WebGL at the last.
 * @param {Uint32Array} indices
 * @param {number} corners
 * @returns {Uint32Array<ArrayBuffer>}
 */
function firstVertexLast(indices, corners) {
  const turned = new Uint32Array(Math.floor(indices.length / corners) * corners);
  for (let at = 0; at < turned.length; at += corners) {
    turned.set(indices.subarray(at + 1, at + corners), at);
    turned[at + corners - 1] = indices[at];
  }
  return turned;
}
