// Draws jobs with WebGL 2. A job and its pictures are those of draw_job.py, as JSON.

import { answer, LostBrowser, Refusal } from "./answers.mjs";
import { captureVertices } from "./webgl2_capture.mjs";
import { drawPicture } from "./webgl2_draw.mjs";
import { linkProgram } from "./webgl2_program.mjs";

export { frames } from "./frames.mjs";

// Needed to draw to, blend and filter floats, and to blend each target separately.
const EXTENSIONS = [
  "EXT_color_buffer_float",
  "EXT_float_blend",
  "OES_texture_float_linear",
  "OES_draw_buffers_indexed",
];

// Few pictures need these.
const OPTIONAL = ["EXT_polygon_offset_clamp"];

const NEWS_DELAY = 100; // milliseconds

let context = null;

/** The page's context, a new one if it was lost, and its extensions by name. */
function theContext() {
  if (!context || context.gl.isContextLost()) {
    const gl = new OffscreenCanvas(1, 1).getContext("webgl2");
    if (!gl) throw new LostBrowser("chromium offers no WebGL 2");
    const extensions = [
      ...EXTENSIONS.map((name) => [name, get(gl, name)]),
      ...OPTIONAL.map((name) => [name, gl.getExtension(name)]),
    ];
    context = { gl, extensions: Object.fromEntries(extensions) };
  }
  return context;
}

function get(gl, name) {
  const extension = gl.getExtension(name);
  if (!extension) throw new LostBrowser(`chromium's WebGL 2 has no ${name}`);
  return extension;
}

export function device() {
  return answer(() => {
    const { gl } = theContext();
    const { UNMASKED_RENDERER_WEBGL } = get(gl, "WEBGL_debug_renderer_info");
    return {
      name: gl.getParameter(UNMASKED_RENDERER_WEBGL),
      subpixel_bits: gl.getParameter(gl.SUBPIXEL_BITS),
    };
  });
}

export function draw(job) {
  return withContext((gl, extensions) => ({
    pictures: eachDraw(gl, job, (program, draw) =>
      drawPicture(gl, extensions, program, job.pipeline, draw),
    ),
  }));
}

export function capture(job) {
  return withContext((gl) => ({
    captured: eachDraw(gl, job, (program, draw, at) =>
      captureVertices(gl, program, job.pipeline, draw, job.most[at]),
    ),
  }));
}

/** The answer that `work` makes with the context. */
function withContext(work) {
  return answer(async () => {
    const { gl, extensions } = theContext();
    takeErrors(gl); // of a job that broke off
    try {
      return work(gl, extensions);
    } catch (error) {
      // The reason may be a lost context, which the page only learns when it is idle.
      await new Promise((resolve) => setTimeout(resolve, NEWS_DELAY));
      throw gl.isContextLost() ? new Refusal("the WebGL context was lost") : error;
    }
  });
}

/** What `run` makes of each draw of a job, with the job's program. */
function eachDraw(gl, job, run) {
  const program = linkProgram(gl, job.pipeline);
  try {
    return job.draws.map((draw, at) => {
      const made = run(program, draw, at);
      refuseErrors(gl);
      return made;
    });
  } finally {
    gl.deleteProgram(program);
  }
}

function refuseErrors(gl) {
  const names = takeErrors(gl);
  if (names.length) throw new Refusal(`WebGL reports ${names.join(", ")}`);
}

function takeErrors(gl) {
  const names = [];
  for (let code = gl.getError(); code !== gl.NO_ERROR; code = gl.getError()) {
    names.push(nameOf(gl, code));
    if (code === gl.CONTEXT_LOST_WEBGL) break; // which has no end
  }
  return names;
}

function nameOf(gl, code) {
  for (const name in gl) {
    if (gl[name] === code) return name;
  }
  return String(code);
}
