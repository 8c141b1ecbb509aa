// Opens a context of WebGL 2, and asks it for errors.

/** @typedef {WebGL2RenderingContext} Gl */

/**
 * The extensions that frames use. Without the first one, a context cannot draw to floats and is
 * refused; a frame that needs another one which is missing gets an error.
 */
const EXTENSIONS = /** @type {const} */ ([
  "EXT_color_buffer_float", "EXT_float_blend", "OES_texture_float_linear",
  "OES_draw_buffers_indexed", "EXT_polygon_offset_clamp",
]);

export class Context {
  /** @type {Map<string, unknown>} */
  #found;

  /** @readonly */
  gl;

  /**
   * @private
   * @param {Gl} gl
   */
  constructor(gl) {
    this.gl = gl;
    this.#found = new Map(EXTENSIONS.map((name) => [name, gl.getExtension(name)]));
  }

  /**
   * A context that draws to a canvas; frames of a context without a canvas can only be read.
   * @param {HTMLCanvasElement | OffscreenCanvas | null} canvas
   * @returns {Context}
   */
  static open(canvas) {
    const drawn = canvas ?? new OffscreenCanvas(1, 1);
    const wanted = { alpha: false, antialias: false, depth: false, stencil: false };
    const gl = /** @type {Gl | null} */ (drawn.getContext("webgl2", wanted));
    if (!gl) throw new Error("this browser, or this canvas, offers no WebGL 2");
    return new Context(gl);
  }

  /**
   * @param {(typeof EXTENSIONS)[number]} extension
   * @returns {boolean}
   */
  has(extension) {
    return Boolean(this.#found.get(extension));
  }

  /**
   * An extension that `what` cannot do without.
   * @param {(typeof EXTENSIONS)[number]} name
   * @param {string} what
   * @returns {unknown}
   */
  need(name, what) {
    if (!this.has(name)) throw new Error(`this device cannot ${what}: it lacks ${name}`);
    return this.#found.get(name);
  }

  /** Throws an error that lists the errors of the context since the last call. */
  check() {
    const { gl } = this;
    if (gl.isContextLost()) throw new Error("the WebGL context was lost");
    /** @type {Set<number>} */
    const found = new Set();
    for (let code = gl.getError(); code !== gl.NO_ERROR && !found.has(code); code = gl.getError()) {
      found.add(code);
    }
    const names = [...found].map((code) => ERRORS[code] ?? `error ${code}`);
    if (names.length) throw new Error(`WebGL reports ${names.join(", ")}`);
  }
}

/** @type {Record<number, string>} */
const ERRORS = {
  0x0500: "INVALID_ENUM", 0x0501: "INVALID_VALUE", 0x0502: "INVALID_OPERATION",
  0x0505: "OUT_OF_MEMORY", 0x0506: "INVALID_FRAMEBUFFER_OPERATION", 0x9242: "CONTEXT_LOST_WEBGL",
};
