// Develops the light of a picture to what the screen shows: an exposure, and a tone mapping. A
// frame of its own does it, which the server has made of the curves of the library.

import { openFrame } from "../web_host/host.js";

/** @import { Api, Frame, FramePackage, Value } from "../web_host/host.js" */

/** The controls, by which the frame's parameters are set. */
const EXPOSURE = "--exposure";
const TONE = "--tone";

export class Development {
  #stops = 0;
  #tone = 0;

  #frame;
  #tones;

  /**
   * @private
   * @param {Frame} frame
   * @param {string[]} tones
   */
  constructor(frame, tones) {
    this.#frame = frame;
    this.#tones = tones;
  }

  /**
   * Opens the frame on the canvas of what it develops. `tones` are the words of its curves; the
   * first one changes nothing.
   * @param {HTMLCanvasElement} canvas
   * @param {{ package: FramePackage, tones: string[] }} from
   * @param {Api} api
   * @returns {Promise<Development>}
   */
  static async open(canvas, from, api) {
    return new Development(await openFrame(canvas, from.package, api), from.tones);
  }

  /**
   * Takes the value of a control; returns false if it is none of its own.
   * @param {string} name
   * @param {Value} value
   * @returns {boolean}
   */
  takes(name, value) {
    if (name === EXPOSURE) this.#stops = Number(value);
    else if (name === TONE) this.#tone = this.#tones.indexOf(String(value));
    else return false;
    return true;
  }

  /**
   * Shows an output of a frame. What is no light is shown as it is: numbers of a single lane, and
   * what has layers.
   * @param {Frame} frame
   * @param {string} output
   */
  show(frame, output) {
    if ((!this.#stops && !this.#tone) || !isLight(frame, output)) {
      frame.show(output);
      return;
    }
    this.#frame.give("light", frame, output);
    this.#frame.set("stops", this.#stops);
    this.#frame.set("tone", this.#tone);
    this.#frame.draw();
    this.#frame.show();
  }

  dispose() {
    this.#frame.dispose();
  }
}

/**
 * @param {Frame} frame
 * @param {string} output
 * @returns {boolean}
 */
function isLight({ plan }, output) {
  const row = plan.outputs.find(({ name }) => name === output);
  const texture = plan.textures[row?.texture ?? -1];
  return texture?.dimension === "2d" && !/^(r\d|depth)/.test(texture.format);
}
