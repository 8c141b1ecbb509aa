// Shows what kernels write to buffers: a plot of one column, and a table of the first elements.

import { drawPlot, orbitAround, plotsOf, TITLES, type Plot } from "./charts.js";
import { element, make } from "./elements.js";
import { follow } from "./gestures.js";
import type { Orbit } from "./orbit.js";
import { Elements, type Column, type Layout } from "./records.js";

/** So many elements are in the table. */
const LISTED = 100;

const place = element("buffer", HTMLElement);
const canvas = element("plot", HTMLCanvasElement);
const columns = element("column", HTMLSelectElement);
const plots = element("plotted-as", HTMLSelectElement);
const about = element("elements-about", HTMLElement);
const table = element("elements", HTMLTableElement);

export class BufferView {
  private elements: Elements | null = null;
  private orbit: Orbit | null = null;
  private waiting = 0;
  /** Tells one buffer from another: for a new one, the camera and the plot begin anew. */
  private shown = "";

  constructor() {
    new ResizeObserver(() => this.request()).observe(canvas);
    follow(canvas, () => this.orbit, () => this.request());
    columns.addEventListener("change", () => this.choose());
    plots.addEventListener("change", () => this.request());
  }

  hide(): void {
    place.hidden = true;
  }

  /** Show what is in a buffer now. */
  show(layout: Layout, bytes: Uint8Array): void {
    place.hidden = false;
    this.elements = new Elements(layout, bytes);
    const key = JSON.stringify(layout);
    if (key !== this.shown) {
      columns.replaceChildren(
        ...layout.columns.map(({ name }, at) => make("option", { value: at }, name || layout.type)),
      );
      columns.closest("label")!.hidden = layout.columns.length < 2;
      // Points say most.
      const best = layout.columns.findIndex((column) => plotsOf(column)[0] === "points");
      columns.value = String(Math.max(best, 0));
      this.choose();
    }
    this.shown = key;
    const { count } = this.elements;
    about.textContent = count
      ? `${count} × ${layout.type}, ${layout.stride} bytes each`
      : "No elements: the kernel runs over nothing, or its own buffers have none.";
    this.list();
    this.request();
  }

  /** Back to the first view. */
  home(): void {
    this.orbit = null;
    this.request();
  }

  /** The plot as a file. */
  async picture(): Promise<Blob> {
    const found = await new Promise<Blob | null>((done) => canvas.toBlob(done, "image/png"));
    if (!found) throw new Error("The browser made no picture of the plot.");
    return found;
  }

  private get column(): Column | undefined {
    return this.elements?.layout.columns[Number(columns.value)];
  }

  private choose(): void {
    const { column } = this;
    if (!column) return;
    const known = plotsOf(column);
    plots.replaceChildren(...known.map((plot) => make("option", { value: plot }, TITLES[plot])));
    plots.closest("label")!.hidden = known.length < 2;
    this.home();
  }

  private request(): void {
    this.waiting ||= requestAnimationFrame(() => {
      this.waiting = 0;
      this.draw();
    });
  }

  private draw(): void {
    const { elements, column } = this;
    canvas.hidden = !elements?.count;
    if (!elements?.count || !column || place.hidden) return;
    this.orbit ??= orbitAround(elements, column);
    const plot = plots.value as Plot;
    canvas.classList.toggle("turns", plot === "points");
    drawPlot(canvas, plot, elements, column, this.orbit);
    canvas.setAttribute("aria-label", `${TITLES[plot]}: ${column.name || elements.layout.type}`);
  }

  private list(): void {
    const { layout, count } = this.elements!;
    const head = layout.columns.map(({ name, type }) =>
      make("th", { title: type }, name || layout.type),
    );
    const rows = Array.from({ length: Math.min(count, LISTED) }, (_, number) =>
      make("tr", {}, make("th", {}, String(number)),
        ...layout.columns.map((column) => make("td", {}, this.elements!.text(column, number)))),
    );
    const more = count > LISTED ? [make("caption", {}, `The first ${LISTED} of ${count}.`)] : [];
    table.replaceChildren(...more,
      make("thead", {}, make("tr", {}, make("th", {}, "#"), ...head)), make("tbody", {}, ...rows));
    table.parentElement!.hidden = !count;
  }
}
