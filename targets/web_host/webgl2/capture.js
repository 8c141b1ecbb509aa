// Captures the vertices of a draw by transform feedback, as a pass with `capture` asks.

import { interleaved } from "./vertices.js";

/**
 * @import { Reflection } from "../generated/documents.js"
 * @import { Mesh } from "../geometry.js"
 * @import { Gl } from "./context.js"
 */

/**
 * The same mesh without indices, its vertices in their order: ES 3.00 draws no indexed vertices
 * while it captures.
 * @param {Reflection} reflection
 * @param {Mesh} mesh
 * @returns {Mesh}
 */
export function inOrder(reflection, mesh) {
  const [found] = interleaved(reflection);
  if (!mesh.indices || found?.step !== "vertex") return { ...mesh, indices: null };
  const { stride } = found;
  const numbers = new Uint32Array(mesh.indices.buffer);
  const vertices = new Uint8Array(numbers.length * stride);
  numbers.forEach((number, at) => {
    vertices.set(mesh.vertices.subarray(number * stride, (number + 1) * stride), at * stride);
  });
  return { ...mesh, vertices, indices: null };
}

/**
 * The values that the program in use captures from the bound vertices: all values of a vertex one
 * behind the other, without gaps. `mode` is the topology, as WebGL numbers it.
 * @param {Gl} gl
 * @param {number} mode
 * @param {Mesh} mesh
 * @param {number} stride
 */
export function captured(gl, mode, mesh, stride) {
  const { count, instance_count: instances } = mesh;
  const bytes = new Uint8Array(count * instances * stride);
  if (!bytes.length) return bytes;
  const buffer = gl.createBuffer();
  gl.bindBuffer(gl.TRANSFORM_FEEDBACK_BUFFER, buffer);
  gl.bufferData(gl.TRANSFORM_FEEDBACK_BUFFER, bytes.length, gl.STREAM_READ);
  gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, buffer);
  // WebGL wants a complete framebuffer, although nothing is drawn to it.
  gl.bindFramebuffer(gl.FRAMEBUFFER, null);
  gl.enable(gl.RASTERIZER_DISCARD);
  gl.beginTransformFeedback(mode);
  gl.drawArraysInstanced(mode, 0, count, instances);
  gl.endTransformFeedback();
  gl.disable(gl.RASTERIZER_DISCARD);
  gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, null);
  gl.bindBuffer(gl.TRANSFORM_FEEDBACK_BUFFER, buffer);
  gl.getBufferSubData(gl.TRANSFORM_FEEDBACK_BUFFER, 0, bytes);
  gl.deleteBuffer(buffer);
  return bytes;
}
