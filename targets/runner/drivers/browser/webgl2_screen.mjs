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

/** A framebuffer, which is bound, and its renderbuffers. */
export function makeScreen(gl, { targets, stencil, samples }, size) {
  const screen = withTargets(gl, targets, size, samples);
  const depth = stencil
    ? [gl.DEPTH_STENCIL_ATTACHMENT, gl.DEPTH32F_STENCIL8]
    : [gl.DEPTH_ATTACHMENT, gl.DEPTH_COMPONENT32F];
  screen.buffers.push(attach(gl, ...depth, size, samples));
  if (gl.checkFramebufferStatus(gl.FRAMEBUFFER) !== gl.FRAMEBUFFER_COMPLETE) {
    const formats = targets.map(({ format }) => format).join(", ");
    throw new Refusal(`WebGL cannot draw ${size.join(" x ")} pixels to ${formats}`);
  }
  gl.viewport(0, 0, ...size);
  return screen;
}

/** A framebuffer with a renderbuffer for each target. */
function withTargets(gl, targets, size, samples) {
  const framebuffer = gl.createFramebuffer();
  gl.bindFramebuffer(gl.FRAMEBUFFER, framebuffer);
  const buffers = targets.map(({ format }, at) =>
    attach(gl, gl.COLOR_ATTACHMENT0 + at, gl[STORAGE[format]], size, samples),
  );
  gl.drawBuffers(points(gl, targets));
  return { framebuffer, buffers };
}

const points = (gl, targets) => targets.map((_, at) => gl.COLOR_ATTACHMENT0 + at);

function attach(gl, attachment, storage, size, samples) {
  const buffer = gl.createRenderbuffer();
  gl.bindRenderbuffer(gl.RENDERBUFFER, buffer);
  // With 0, pixels are not divided; with 1, WebGL may give them several samples.
  gl.renderbufferStorageMultisample(gl.RENDERBUFFER, samples > 1 ? samples : 0, storage, ...size);
  gl.framebufferRenderbuffer(gl.FRAMEBUFFER, attachment, gl.RENDERBUFFER, buffer);
  return buffer;
}

/** Calls `read` while what can be read is bound: the targets of a screen, or the means of their
 * samples. */
export function whileReadable(gl, screen, { targets, samples }, size, read) {
  if (samples === 1) return read();
  const means = withTargets(gl, targets, size, 1);
  try {
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, screen.framebuffer);
    points(gl, targets).forEach((point, number, all) => {
      gl.readBuffer(point);
      gl.drawBuffers(all.map((each) => (each === point ? point : gl.NONE)));
      const area = [0, 0, ...size];
      gl.blitFramebuffer(...area, ...area, gl.COLOR_BUFFER_BIT, gl.NEAREST);
    });
    gl.bindFramebuffer(gl.READ_FRAMEBUFFER, means.framebuffer);
    return read();
  } finally {
    deleteScreen(gl, means);
  }
}

export function deleteScreen(gl, { framebuffer, buffers }) {
  buffers.forEach((buffer) => gl.deleteRenderbuffer(buffer));
  gl.deleteFramebuffer(framebuffer);
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
