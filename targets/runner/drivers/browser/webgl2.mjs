// Draws with WebGL 2: packages of frames, and frame jobs.

import { answer, LostBrowser, news, Refusal } from "./answers.mjs";
import { Context } from "./host/webgl2/context.js";
import { WebGl2Renderer } from "./host/webgl2/renderer.js";
import { found } from "./jobs.mjs";

export { frames } from "./frames.mjs";

let opened = null;

/** The page's context, or a new one if it was lost. */
function theContext() {
  if (opened && !opened.gl.isContextLost()) return opened;
  try {
    opened = Context.open(null);
  } catch (error) {
    throw new LostBrowser(error.message);
  }
  return opened;
}

export function device() {
  return answer(() => {
    const { gl } = theContext();
    const { UNMASKED_RENDERER_WEBGL } = gl.getExtension("WEBGL_debug_renderer_info");
    return {
      name: gl.getParameter(UNMASKED_RENDERER_WEBGL),
      subpixel_bits: gl.getParameter(gl.SUBPIXEL_BITS),
      most_groups: 0,
    };
  });
}

/** Executes a frame job, and answers with the contents that it reads back. */
export function job(given) {
  return answer(async () => {
    const context = theContext();
    const { gl } = context;
    // A job that broke off may have left errors, which are not this job's.
    while (gl.getError() !== gl.NO_ERROR && !gl.isContextLost());
    try {
      return await found(WebGl2Renderer.open(given, null, context), given);
    } catch (error) {
      await news(); // The reason may be a lost context.
      throw gl.isContextLost() ? new Refusal("the WebGL context was lost") : error;
    }
  });
}
