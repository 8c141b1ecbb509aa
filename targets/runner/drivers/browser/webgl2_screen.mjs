// The framebuffer of a draw.

import { base64, Refusal } from "./answers.mjs";

const STORAGE = {
  "r8unorm": "R8",
  "rg8unorm": "RG8",
  "rgba8unorm": "RGBA8",
  "rgba8unorm-srgb": "SRGB8_ALPHA8",
  "r16float": "R16F",
  "rg16float": "RG16F",
  "rgba16float": "RGBA16F",
  "r32float": "R32F",
  "rg32float": "RG32F",
  "rgba32float": "RGBA32F",
};

// Of alpha, a factor of a colour is its alpha.
const FACTORS = {
  zero: "ZERO",
  one: "ONE",
  src: "SRC_COLOR",
  one_minus_src: "ONE_MINUS_SRC_COLOR",
  src_alpha: "SRC_ALPHA",
  one_minus_src_alpha: "ONE_MINUS_SRC_ALPHA",
  dst: "DST_COLOR",
  one_minus_dst: "ONE_MINUS_DST_COLOR",
  dst_alpha: "DST_ALPHA",
  one_minus_dst_alpha: "ONE_MINUS_DST_ALPHA",
  src_alpha_saturated: "SRC_ALPHA_SATURATE",
  constant: "CONSTANT_COLOR",
  one_minus_constant: "ONE_MINUS_CONSTANT_COLOR",
};

const OPERATIONS = {
  add: "FUNC_ADD",
  subtract: "FUNC_SUBTRACT",
  reverse_subtract: "FUNC_REVERSE_SUBTRACT",
  min: "MIN",
  max: "MAX",
};

/** A framebuffer, which is bound, and its renderbuffers. Their texels have as many samples as those
 * of the job, or one to which others are resolved. */
export function makeScreen(gl, { targets, stencil, samples }, size, isResolved = false) {
  const framebuffer = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  const count = isResolved ? 1 : samples;
  const buffers = targets.map(({ format }, at) =>
    attach(gl, gl.COLOR_ATTACHMENT0 + at, STORAGE[format], size, count),
  );
  const [point, depths] = stencil
    ? [gl.DEPTH_STENCIL_ATTACHMENT, "DEPTH32F_STENCIL8"]
    : [gl.DEPTH_ATTACHMENT, "DEPTH_COMPONENT32F"];
  if (!isResolved) buffers.push(attach(gl, point, depths, size, count));
  gl.drawBuffers(targets.map((_, at) => gl.COLOR_ATTACHMENT0 + at));
  if (gl.checkFramebufferStatus(gl.FRAMEBUFFER) !== gl.FRAMEBUFFER_COMPLETE) {
    const formats = targets.map(({ format }) => format).join(", ");
    throw new Refusal(`WebGL cannot draw ${size.join(" x ")} pixels to ${formats}`);
  }
  gl.viewport(0, 0, ...size);
  return { framebuffer, buffers };
}

function attach(gl, attachment, storage, size, samples) {
  const format = gl[storage];
  const counts = gl.getInternalformatParameter(gl.RENDERBUFFER, format, gl.SAMPLES);
  if (samples > 1 && !counts.includes(samples)) {
    throw new Refusal(`WebGL has no ${samples} samples of ${storage} here`);
  }
  const buffer = gl.createRenderbuffer();
  gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
  // WebGL counts none where there is one.
  const stored = samples > 1 ? samples : 0;
  gl.renderbufferStorageMultisample(gl.RENDERBUFFER, stored, format, ...size);
  gl.framebufferRenderbuffer(gl.FRAMEBUFFER, attachment, gl.RENDERBUFFER, buffer);
  return buffer;
}

export function deleteScreen(gl, { framebuffer, buffers }) {
  buffers.forEach((buffer) => gl.deleteRenderbuffer(buffer));
  gl.deleteFramebuffer(framebuffer);
}

/** Write the mean of each pixel's samples to another screen, which is bound then. */
export function resolve(gl, { targets }, from, to, [width, height]) {
  gl.bindFramebuffer(gl.READ_FRAMEBUFFER, from.framebuffer);
  gl.bindFramebuffer(gl.DRAW_FRAMEBUFFER, to.framebuffer);
  targets.forEach((_, at) => {
    const point = gl.COLOR_ATTACHMENT0 + at;
    gl.readBuffer(point);
    gl.drawBuffers([...Array(at).fill(gl.NONE), point]);
    gl.blitFramebuffer(
      0, 0, width, height, 0, 0, width, height, gl.COLOR_BUFFER_BIT, gl.NEAREST,
    );
  });
  gl.bindFramebuffer(gl.FRAMEBUFFER, to.framebuffer);
}

/** Clear everything; what is cleared obeys the masks. */
export function clear(gl, { stencil }, draw) {
  gl.colorMask(true, true, true, true);
  draw.clear.forEach((color, at) => gl.clearBufferfv(gl.COLOR, at, color));
  gl.depthMask(true);
  gl.clearBufferfv(gl.DEPTH, 0, [draw.clear_depth]);
  if (!stencil) return;
  gl.stencilMask(0xff);
  gl.clearBufferiv(gl.STENCIL, 0, [0]);
}

/** Set how each target is blended, which lanes are written, and what `constant` means. */
export function setBlending(gl, { OES_draw_buffers_indexed: indexed }, targets, constant) {
  gl.blendColor(...constant);
  targets.forEach(({ blend, mask }, at) => {
    const isWritten = [..."rgba"].map((lane) => mask !== "none" && mask.includes(lane));
    indexed.colorMaskiOES(at, ...isWritten);
    if (!blend) return indexed.disableiOES(gl.BLEND, at);
    const { color, alpha } = blend;
    const operations = [color, alpha].map(({ operation }) => gl[OPERATIONS[operation]]);
    const factors = [color, alpha].flatMap(({ source, destination }) => [source, destination]);
    indexed.enableiOES(gl.BLEND, at);
    indexed.blendEquationSeparateiOES(at, ...operations);
    indexed.blendFuncSeparateiOES(at, ...factors.map((factor) => gl[FACTORS[factor]]));
  });
}

/** A target's texels. WebGL only guarantees to read RGBA; it fills missing lanes. */
export function readTarget(gl, at, format, [width, height]) {
  gl.readBuffer(gl.COLOR_ATTACHMENT0 + at);
  const isFloat = format.endsWith("float");
  const lanes = new (isFloat ? Float32Array : Uint8Array)(4 * width * height);
  gl.readPixels(0, 0, width, height, gl.RGBA, isFloat ? gl.FLOAT : gl.UNSIGNED_BYTE, lanes);
  const srgb = format.endsWith("srgb") ? "-srgb" : "";
  return {
    format: isFloat ? "rgba32float" : `rgba8unorm${srgb}`,
    texels: base64(new Uint8Array(lanes.buffer)),
  };
}
