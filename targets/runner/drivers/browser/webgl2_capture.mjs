// Captures the vertices of one draw by WebGL 2's transform feedback.

import { base64, bytes, Refusal } from "./answers.mjs";
import { withMesh } from "./webgl2_draw.mjs";

const LANE = 4; // bytes

/** The number of captured vertices, and their bytes. */
export function captureVertices(gl, program, job, draw, most) {
  const indices = new Uint32Array(bytes(draw.indices).buffer);
  const count = indices.length * draw.instance_count;
  if (count > most) throw new Refusal(`${count} vertices are captured, with room for ${most}`);
  const target = gl.createBuffer();
  try {
    return captured(gl, program, job, draw, { indices, count, most, target });
  } finally {
    gl.disable(gl.RASTERIZER_DISCARD);
    gl.deleteBuffer(target);
  }
}

/** The vertices of a draw, written into the buffer `target`, which has room for `most` of them. */
function captured(gl, program, job, draw, { indices, count, most, target }) {
  const { stride, primitive } = job.stream_output;
  gl.bindBuffer(gl.TRANSFORM_FEEDBACK_BUFFER, target);
  gl.bufferData(gl.TRANSFORM_FEEDBACK_BUFFER, Math.max(most, 1) * stride, gl.STREAM_READ);
  gl.enable(gl.RASTERIZER_DISCARD);
  withMesh(gl, program, job, repeated(job, draw, indices), () => {
    const mode = primitive === "point" ? gl.POINTS : gl.TRIANGLES;
    gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, target);
    gl.beginTransformFeedback(mode);
    gl.drawArraysInstanced(mode, 0, indices.length, draw.instance_count);
    gl.endTransformFeedback();
    gl.bindBufferBase(gl.TRANSFORM_FEEDBACK_BUFFER, 0, null);
  });
  const data = new Uint8Array(count * stride);
  gl.bindBuffer(gl.TRANSFORM_FEEDBACK_BUFFER, target);
  gl.getBufferSubData(gl.TRANSFORM_FEEDBACK_BUFFER, 0, data);
  return { count, data: base64(data) };
}

/** The same draw with the vertices in the order of the indices: ES 3.00 draws none by their indices
 * while it captures. */
function repeated(job, draw, indices) {
  const vertices = job.inputs.map((slot, at) => {
    if (slot.step === "instance") return draw.vertices[at];
    const size = LANE * Number(slot.format.split("x")[1] ?? "1");
    const given = bytes(draw.vertices[at]);
    const made = new Uint8Array(indices.length * size);
    indices.forEach((number, place) => {
      made.set(given.subarray(number * size, (number + 1) * size), place * size);
    });
    return base64(made);
  });
  return { ...draw, vertices };
}
