// Shows what kernels write to buffers: a plot of one column, and a table of the first elements.

import { present } from "../web_host/present.js";
import { drawPlot, orbitAround, plotsOf, TITLES } from "./charts.js";
import { element, make } from "./elements.js";
import { follow } from "./gestures.js";
import { Elements } from "./records.js";

/**
 * @import { Plot } from "./charts.js"
 * @import { Orbit } from "./orbit.js"
 * @import { Column, Layout } from "./records.js"
 */

/** The number of elements in the table. */
const LISTED = 100;

const place = element("buffer", HTMLElement);
const canvas = element("plot", HTMLCanvasElement);
const columns = element("column", HTMLSelectElement);
const plots = element("plotted-as", HTMLSelectElement);
const about = element("elements-about", HTMLElement);
const table = element("elements", HTMLTableElement);

export class BufferView {
  /** @type {Elements | null} */
  #elements = null;
  /** @type {Orbit | null} */
  #orbit = null;
  #waiting = 0;
  /** Identifies the buffer that is shown: for another one, the camera and the plot begin anew. */
  #shown = "";

  constructor() {
    new ResizeObserver(() => this.#request()).observe(canvas);
    follow(canvas, () => this.#orbit, () => this.#request());
    columns.addEventListener("change", () => this.#choose());
    plots.addEventListener("change", () => this.#request());
  }

  hide() {
    place.hidden = true;
  }

  /**
   * Show what is in a buffer now.
   * @param {Layout} layout
   * @param {Uint8Array} bytes
   */
  show(layout, bytes) {
    place.hidden = false;
    this.#elements = new Elements(layout, bytes);
    const key = JSON.stringify(layout);
    if (key !== this.#shown) {
      columns.replaceChildren(
        ...layout.columns.map(({ name }, at) => make("option", { value: at }, name || layout.type)),
      );
      present(columns.closest("label")).hidden = layout.columns.length < 2;
      // Points in space say more than a plot of lanes.
      const best = layout.columns.findIndex((column) => plotsOf(column)[0] === "points");
      columns.value = String(Math.max(best, 0));
      this.#choose();
    }
    this.#shown = key;
    const { count } = this.#elements;
    about.textContent = count
      ? `${count} × ${layout.type}, ${layout.stride} bytes each`
      : "No elements: the kernel runs over nothing, or its own buffers have none.";
    this.#list();
    this.#request();
  }

  /** Return the camera to its first view. */
  home() {
    this.#orbit = null;
    this.#request();
  }

  /**
   * The plot as a file.
   * @returns {Promise<Blob>}
   */
  async picture() {
    /** @type {Blob | null} */
    const found = await new Promise((done) => canvas.toBlob(done, "image/png"));
    if (!found) throw new Error("The browser made no picture of the plot.");
    return found;
  }

  /** @returns {Column | undefined} */
  get #column() {
    return this.#elements?.layout.columns[Number(columns.value)];
  }

  #choose() {
    const column = this.#column;
    if (!column) return;
    const known = plotsOf(column);
    plots.replaceChildren(...known.map((plot) => make("option", { value: plot }, TITLES[plot])));
    present(plots.closest("label")).hidden = known.length < 2;
    this.home();
  }

  #request() {
    this.#waiting ||= requestAnimationFrame(() => {
      this.#waiting = 0;
      this.#draw();
    });
  }

  #draw() {
    const elements = this.#elements;
    const column = this.#column;
    canvas.hidden = !elements?.count;
    if (!elements?.count || !column || place.hidden) return;
    this.#orbit ??= orbitAround(elements, column);
    const plot = /** @type {Plot} */ (plots.value);
    canvas.classList.toggle("turns", plot === "points");
    drawPlot(canvas, plot, elements, column, this.#orbit);
    canvas.setAttribute("aria-label", `${TITLES[plot]}: ${column.name || elements.layout.type}`);
  }

  #list() {
    const elements = present(this.#elements);
    const { layout, count } = elements;
    const head = layout.columns.map(({ name, type }) =>
      make("th", { title: type }, name || layout.type),
    );
    const rows = Array.from({ length: Math.min(count, LISTED) }, (_, number) =>
      make("tr", {}, make("th", {}, String(number)),
        ...layout.columns.map((column) => make("td", {}, elements.text(column, number)))),
    );
    const more = count > LISTED ? [make("caption", {}, `The first ${LISTED} of ${count}.`)] : [];
    table.replaceChildren(...more,
      make("thead", {}, make("tr", {}, make("th", {}, "#"), ...head)), make("tbody", {}, ...rows));
    present(table.parentElement).hidden = !count;
  }
}
