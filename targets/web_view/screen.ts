// The picture: a frame of the host on the canvas, drawn when something has changed, or again and
// again while time goes on.

import {
  openFrame, type Api, type Frame, type FramePackage, type Value,
} from "../web_host/host.js";
import { Orbit, type OrbitRow } from "./orbit.js";
import { layoutOf, type Layout } from "./records.js";

/** How much of the last measurements counts for the number of frames per second. */
const SMOOTHING = 0.9;
/** The longest time between two frames that counts as such, in seconds. */
const LONGEST = 0.5;
/** A picture has no more pixels on a side than this. */
const LARGEST = 4096;

/** What was drawn. */
export interface Status {
  width: number;
  height: number;
  /** How many pixels of the screen one of the picture has on a side. */
  magnified: number;
  rate: number | null;
}

export interface Watcher {
  /** Something could not be drawn; an empty text if it can be again. */
  problem(text: string): void;
  /** A picture was drawn. */
  drawn(status: Status): void;
  /** A buffer was written. */
  written(layout: Layout, bytes: Uint8Array): void;
  /** Whether anything runs with the time. */
  runs(): boolean;
  /** So many seconds have gone by. */
  elapsed(seconds: number): void;
}

export class Screen {
  orbit: Orbit | null = null;
  playing = true;
  /** The share of the screen's pixels that a picture has on each side. */
  scale = 1;
  private frame: Frame | null = null;
  private package: FramePackage | null = null;
  private start: OrbitRow | null = null;
  private output = "";
  /** How the elements of the output lie, if it is a buffer. */
  private layout: Layout | null = null;
  private reading = false;
  private readsAgain = false;
  private waiting = 0;
  private before = 0;
  private rate: number | null = null;

  constructor(
    private readonly canvas: HTMLCanvasElement,
    private readonly api: Api,
    private readonly watcher: Watcher,
  ) {
    new ResizeObserver(() => this.request()).observe(canvas);
  }

  /** Whether each picture goes on from the last one. */
  get evolves(): boolean {
    return (this.package?.plan.kept.length ?? 0) > 0;
  }

  /** Whether there is another picture to draw after each. */
  private get goesOn(): boolean {
    return this.playing && (this.evolves || this.watcher.runs());
  }

  /** Show another package. What was shown before stays until it is ready, and for good if it cannot
   * be opened. The camera stays where it is, unless `start` is another one than before. */
  async open(
    opened: FramePackage, start: OrbitRow, values: Map<string, Value>, output: string,
  ): Promise<void> {
    const frame = await openFrame(this.canvas, opened, this.api);
    for (const [name, value] of values) frame.set(name, value);
    this.frame?.dispose();
    this.frame = frame;
    this.package = opened;
    if (JSON.stringify(start) !== JSON.stringify(this.start)) this.orbit = new Orbit(start);
    this.start = start;
    this.choose(output);
    this.draw();
    if (this.goesOn) this.request();
    // What the API refuses it tells later.
    frame.finished().catch((error: Error) => {
      if (this.frame === frame) this.watcher.problem(error.message);
    });
  }

  set(name: string, value: Value): void {
    this.attempt(() => this.frame?.set(name, value));
    this.request();
  }

  show(output: string): void {
    this.choose(output);
    this.request();
  }

  /** Whether a buffer is shown, and no picture. */
  get showsBuffer(): boolean {
    return this.layout !== null;
  }

  private choose(output: string): void {
    this.output = output;
    this.layout = this.package && layoutOf(this.package, output);
    this.canvas.classList.toggle("covered", this.showsBuffer);
  }

  resetCamera(): void {
    if (this.start) this.orbit = new Orbit(this.start);
    this.request();
  }

  /** Draw soon. */
  request(): void {
    this.waiting ||= requestAnimationFrame((now) => this.tick(now));
  }

  /** Draw one picture now, also while time stands still. */
  step(): void {
    this.draw();
  }

  /** The picture as a file. */
  async picture(): Promise<Blob> {
    // What is on a canvas can be read until the browser shows it.
    this.present();
    const found = await new Promise<Blob | null>((done) => this.canvas.toBlob(done, "image/png"));
    if (!found) throw new Error("The browser made no picture of the canvas.");
    return found;
  }

  // --- drawing -----------------------------------------------------------------------------------

  private tick(now: number): void {
    this.waiting = 0;
    const seconds = (now - this.before) / 1000;
    const follows = this.before > 0 && seconds < LONGEST;
    this.before = now;
    const { goesOn } = this;
    if (goesOn && follows) this.watcher.elapsed(seconds);
    if (goesOn && follows && seconds > 0) {
      const rate = 1 / seconds;
      this.rate = this.rate === null ? rate : SMOOTHING * this.rate + (1 - SMOOTHING) * rate;
    }
    if (!goesOn) this.rate = null;
    if (!this.playing && this.evolves) this.present();
    else this.draw();
    if (goesOn) this.request();
  }

  private draw(): void {
    this.attempt(() => {
      if (!this.frame || !this.fit()) return;
      this.frame.draw();
      this.present();
    });
  }

  private present(): void {
    const { frame, canvas } = this;
    if (!frame) return;
    if (this.layout) {
      void this.readElements();
      return;
    }
    // The canvas has the pixels of the output, and the browser brings it to the size of its place.
    const [width, height] = frame.sizeOf(this.output);
    if (canvas.width !== width || canvas.height !== height) {
      [canvas.width, canvas.height] = [width, height];
    }
    const magnified = devicePixelRatio *
      Math.min(canvas.clientWidth / width, canvas.clientHeight / height);
    const [wide, high] = this.size();
    const isOwn = width !== wide || height !== high;
    canvas.classList.toggle("crisp", isOwn && magnified > 1);
    frame.show(this.output);
    this.watcher.drawn({ width, height, magnified: isOwn ? magnified : 1, rate: this.rate });
  }

  /** Tell what is in the buffer; one reading at a time, and once more for what was drawn in the
   * meantime. */
  private async readElements(): Promise<void> {
    this.readsAgain = true;
    if (this.reading) return;
    this.reading = true;
    while (this.readsAgain && this.frame && this.layout) {
      this.readsAgain = false;
      const { frame, layout } = this;
      try {
        const bytes = await frame.readElements(this.output);
        if (frame === this.frame && layout === this.layout) this.watcher.written(layout, bytes);
      } catch (error) {
        if (frame === this.frame) this.watcher.problem((error as Error).message);
      }
    }
    this.reading = false;
  }

  /** The pixels of a picture that covers the canvas. */
  private size(): [number, number] {
    const factor = this.scale * devicePixelRatio;
    const { clientWidth, clientHeight } = this.canvas;
    const [width, height] = [clientWidth, clientHeight].map((side) =>
      Math.min(Math.round(side * factor), LARGEST),
    );
    return [width, height];
  }

  /** Give the frame its size and camera. Returns whether there is anything to see. */
  private fit(): boolean {
    const { frame, orbit } = this;
    const [width, height] = this.size();
    if (!frame || !orbit || width < 1 || height < 1) return false;
    frame.resize(width, height);
    const widening = Math.max(1, height / width);
    frame.setCamera({ view_projection: orbit.viewProjection(widening), eye: orbit.eye });
    return true;
  }

  private attempt(act: () => void): void {
    try {
      act();
      this.watcher.problem("");
    } catch (error) {
      this.watcher.problem(error instanceof Error ? error.message : String(error));
    }
  }
}
