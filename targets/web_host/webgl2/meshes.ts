// Brings meshes to WebGL 2.

import type { Reflection } from "../generated/documents.js";
import type { Mesh } from "../geometry.js";
import type { Gl } from "./context.js";
import type { Program } from "./programs.js";
import { interleaved } from "./vertices.js";

/** What is drawn of a mesh by one program. */
export interface Uploaded {
  vertices: WebGLVertexArrayObject;
  buffers: WebGLBuffer[];
  count: number;
}

/** What draws each topology, and how many vertices its primitives have. */
export const MODES = {
  point: ["POINTS", 1], line: ["LINES", 2], triangle: ["TRIANGLES", 3],
} as const;

export const topologyOf = ({ draw }: Reflection) =>
  (draw?.topology ?? "triangle") as keyof typeof MODES;

export function uploadMesh(
  gl: Gl, program: Program, reflection: Reflection, mesh: Mesh,
): Uploaded {
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

export function freeMesh(gl: Gl, { vertices, buffers }: Uploaded): void {
  gl.deleteVertexArray(vertices);
  buffers.forEach((each) => gl.deleteBuffer(each));
}

function filled(gl: Gl, kind: number, data: AllowSharedBufferSource): WebGLBuffer {
  const buffer = gl.createBuffer();
  gl.bindBuffer(kind, buffer);
  gl.bufferData(kind, data, gl.STATIC_DRAW);
  return buffer;
}

/** The same primitives, with the first vertex of each moved to the end: a flat varying has its
 * value at the first one, but in WebGL at the last. */
function firstVertexLast(indices: Uint32Array, corners: number): Uint32Array<ArrayBuffer> {
  const turned = new Uint32Array(Math.floor(indices.length / corners) * corners);
  for (let at = 0; at < turned.length; at += corners) {
    turned.set(indices.subarray(at + 1, at + corners), at);
    turned[at + corners - 1] = indices[at];
  }
  return turned;
}
