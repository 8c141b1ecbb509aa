// The picture: a frame of the host on the canvas, drawn when something has changed, or again and
// again while time goes on.

import { openFrame } from "../web_host/host.js";
import { Development } from "./development.js";
import { Orbit } from "./orbit.js";
import { layoutOf } from "./records.js";

/**
 * @import { Api, Frame, FramePackage, Value } from "../web_host/host.js"
 * @import { Drawable } from "./documents.js"
 * @import { OrbitRow } from "./orbit.js"
 * @import { Layout } from "./records.js"
 */

/** The weight of earlier measurements in the number of frames per second. */
const SMOOTHING = 0.9;
/** A longer time between two frames, in seconds, is a pause, and not measured. */
const LONGEST = 0.5;
/** The largest width and height of a picture in pixels. */
const LARGEST = 4096;

/**
 * The size and the speed of the picture that was drawn.
 * @typedef {object} Status
 * @property {number} width
 * @property {number} height
 * @property {number} magnified The width of a pixel of the picture in pixels of the screen.
 * @property {number | null} rate
 */

/**
 * The functions that are called when something happens to the picture.
 * @typedef {object} Watcher
 * @property {(text: string) => void} problem Something could not be drawn; an empty text if it can
 *   be again.
 * @property {(status: Status) => void} drawn A picture was drawn.
 * @property {(layout: Layout, bytes: Uint8Array) => void} written A buffer was written.
 * @property {() => boolean} runs True if a number runs with the time.
 * @property {(seconds: number) => void} elapsed Time has gone by.
 */

export class Screen {
  /** @type {Orbit | null} */
  orbit = null;
  playing = true;
  /** The share of the screen's pixels that a picture has on each side. */
  scale = 1;
  /** @type {Frame | null} */
  #frame = null;
  /** @type {Development | null} */
  #development = null;
  /** @type {FramePackage | null} */
  #package = null;
  /** @type {OrbitRow | null} */
  #start = null;
  #output = "";
  /** The layout of the output's elements, if it is a buffer. @type {Layout | null} */
  #layout = null;
  #reading = false;
  #readsAgain = false;
  #waiting = 0;
  #before = 0;
  /** @type {number | null} */
  #rate = null;

  #canvas;
  #api;
  #watcher;

  /**
   * @param {HTMLCanvasElement} canvas
   * @param {Api} api
   * @param {Watcher} watcher
   */
  constructor(canvas, api, watcher) {
    this.#canvas = canvas;
    this.#api = api;
    this.#watcher = watcher;
    new ResizeObserver(() => this.request()).observe(canvas);
  }

  /**
   * True if each picture is computed from the last one.
   * @returns {boolean}
   */
  get evolves() {
    return (this.#package?.plan.kept.length ?? 0) > 0;
  }

  /**
   * True if pictures are drawn one after the other.
   * @returns {boolean}
   */
  get #goesOn() {
    return this.playing && (this.evolves || this.#watcher.runs());
  }

  /**
   * Show another document. What was shown before stays until it is ready, and for good if it cannot
   * be opened. The camera stays where it is, unless it starts from another place than before.
   * `values` has those of all controls that somebody has set.
   * @param {Drawable} document
   * @param {Map<string, Value>} values
   * @param {string} output
   * @returns {Promise<void>}
   */
  async open({ package: opened, development: developing, orbit: start, controls }, values, output) {
    const frame = await openFrame(this.#canvas, opened, this.#api);
    const development = await Development.open(this.#canvas, developing, this.#api);
    for (const { name, value } of controls) development.takes(name, value);
    for (const [name, value] of values) {
      if (!development.takes(name, value)) frame.set(name, value);
    }
    this.#frame?.dispose();
    this.#development?.dispose();
    [this.#frame, this.#development] = [frame, development];
    this.#package = opened;
    if (JSON.stringify(start) !== JSON.stringify(this.#start)) this.orbit = new Orbit(start);
    this.#start = start;
    this.#choose(output);
    this.#draw();
    if (this.#goesOn) this.request();
    // An API reports errors later.
    frame.finished().catch((/** @type {Error} */ error) => {
      if (this.#frame === frame) this.#watcher.problem(error.message);
    });
  }

  /**
   * @param {string} name
   * @param {Value} value
   */
  set(name, value) {
    this.#attempt(() => {
      if (!this.#development?.takes(name, value)) this.#frame?.set(name, value);
    });
    this.request();
  }

  /** @param {string} output */
  show(output) {
    this.#choose(output);
    this.request();
  }

  /**
   * True if the output is a buffer, and no picture.
   * @returns {boolean}
   */
  get showsBuffer() {
    return this.#layout !== null;
  }

  /** @param {string} output */
  #choose(output) {
    this.#output = output;
    this.#layout = this.#package && layoutOf(this.#package, output);
    this.#canvas.classList.toggle("covered", this.showsBuffer);
  }

  resetCamera() {
    if (this.#start) this.orbit = new Orbit(this.#start);
    this.request();
  }

  /** Draw soon. */
  request() {
    this.#waiting ||= requestAnimationFrame((now) => this.#tick(now));
  }

  /** Draw one picture now, also while time stands still. */
  step() {
    this.#draw();
  }

  /**
   * The picture as a file.
   * @returns {Promise<Blob>}
   */
  async picture() {
    // A canvas can only be read until the browser shows it, so it is drawn again.
    this.#present();
    /** @type {Blob | null} */
    const found = await new Promise((done) => this.#canvas.toBlob(done, "image/png"));
    if (!found) throw new Error("The browser made no picture of the canvas.");
    return found;
  }

  // --- drawing -----------------------------------------------------------------------------------

  /** @param {number} now */
  #tick(now) {
    this.#waiting = 0;
    const seconds = (now - this.#before) / 1000;
    const follows = this.#before > 0 && seconds < LONGEST;
    this.#before = now;
    const goesOn = this.#goesOn;
    if (goesOn && follows) this.#watcher.elapsed(seconds);
    if (goesOn && follows && seconds > 0) {
      const rate = 1 / seconds;
      this.#rate = this.#rate === null ? rate : SMOOTHING * this.#rate + (1 - SMOOTHING) * rate;
    }
    if (!goesOn) this.#rate = null;
    if (!this.playing && this.evolves) this.#present();
    else this.#draw();
    if (goesOn) this.request();
  }

  #draw() {
    this.#attempt(() => {
      if (!this.#frame || !this.#fit()) return;
      this.#frame.draw();
      this.#present();
    });
  }

  #present() {
    const frame = this.#frame;
    const canvas = this.#canvas;
    if (!frame) return;
    if (this.#layout) {
      void this.#readElements();
      return;
    }
    // The canvas has the pixels of the output, and the browser brings it to the size of its place.
    const [width, height] = frame.sizeOf(this.#output);
    if (canvas.width !== width || canvas.height !== height) {
      [canvas.width, canvas.height] = [width, height];
    }
    const magnified = devicePixelRatio *
      Math.min(canvas.clientWidth / width, canvas.clientHeight / height);
    const [wide, high] = this.#size();
    const isOwn = width !== wide || height !== high;
    canvas.classList.toggle("crisp", isOwn && magnified > 1);
    this.#development?.show(frame, this.#output);
    this.#watcher.drawn({ width, height, magnified: isOwn ? magnified : 1, rate: this.#rate });
  }

  /**
   * Read the buffer for the watcher; one reading at a time, and one more if frames were drawn in
   * the meantime.
   * @returns {Promise<void>}
   */
  async #readElements() {
    this.#readsAgain = true;
    if (this.#reading) return;
    this.#reading = true;
    while (this.#readsAgain && this.#frame && this.#layout) {
      this.#readsAgain = false;
      const frame = this.#frame;
      const layout = this.#layout;
      try {
        const bytes = await frame.readElements(this.#output);
        if (frame === this.#frame && layout === this.#layout) this.#watcher.written(layout, bytes);
      } catch (error) {
        if (frame === this.#frame) this.#watcher.problem(/** @type {Error} */ (error).message);
      }
    }
    this.#reading = false;
  }

  /**
   * The pixels of a picture that covers the canvas.
   * @returns {[number, number]}
   */
  #size() {
    const factor = this.scale * devicePixelRatio;
    const { clientWidth, clientHeight } = this.#canvas;
    const [width, height] = [clientWidth, clientHeight].map((side) =>
      Math.min(Math.round(side * factor), LARGEST),
    );
    return [width, height];
  }

  /**
   * Give the frame its size and camera. Returns false if no pixel of the canvas is visible.
   * @returns {boolean}
   */
  #fit() {
    const frame = this.#frame;
    const { orbit } = this;
    const [width, height] = this.#size();
    if (!frame || !orbit || width < 1 || height < 1) return false;
    frame.resize(width, height);
    const widening = Math.max(1, height / width);
    frame.setCamera({ view_projection: orbit.viewProjection(widening), eye: orbit.eye });
    return true;
  }

  /** @param {() => void} act */
  #attempt(act) {
    try {
      act();
      this.#watcher.problem("");
    } catch (error) {
      this.#watcher.problem(error instanceof Error ? error.message : String(error));
    }
  }
}
