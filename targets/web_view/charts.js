// Draws the elements of a buffer: numbers in their order or counted, and points in space.

import { Orbit } from "./orbit.js";

/**
 * @import { Vector } from "./orbit.js"
 * @import { Column, Elements } from "./records.js"
 */

/** The plot of a column. @typedef {"points" | "values" | "histogram"} Plot */

/** @type {Record<Plot, string>} */
export const TITLES = {
  points: "Points in space", values: "Values in order", histogram: "How often each value is there",
};

/**
 * The plots of a column, the best one first.
 * @param {Column} column
 * @returns {Plot[]}
 */
export function plotsOf(column) {
  const lanes = column.places.length;
  if (lanes === 1) return column.kind === "bool" ? ["histogram"] : ["values", "histogram"];
  return lanes <= 3 ? ["points", "values"] : ["values"];
}

/**
 * A canvas to plot on, its size in pixels, and its colours.
 * @typedef {object} Paper
 * @property {CanvasRenderingContext2D} ink
 * @property {number} width
 * @property {number} height
 * @property {number} scale Pixels of the canvas for each of the page.
 * @property {{ main: string, lanes: string[], line: string, text: string }} colors
 */

/** Lines for the lanes of a vector: x, y, z, w. */
const LANES = ["#d0463b", "#3d9a50", "#4a7fd6", "#9a6fc4"];
const MARGIN = { left: 64, right: 20, top: 16, bottom: 26 };
const MOST_BARS = 64;
/** More points than these are drawn smaller. */
const MANY = 5000;
/** Of more primitives than this, some are left out, evenly: nobody could tell them apart. */
const MOST_POINTS = 100_000;

/**
 * @param {HTMLCanvasElement} canvas
 * @returns {Paper | null}
 */
export function paperOf(canvas) {
  const scale = devicePixelRatio;
  const [width, height] = [canvas.clientWidth, canvas.clientHeight].map((side) =>
    Math.round(side * scale),
  );
  const ink = canvas.getContext("2d");
  if (!ink || width < 1 || height < 1) return null;
  [canvas.width, canvas.height] = [width, height];
  const style = getComputedStyle(canvas);
  /** @type {(name: string) => string} */
  const named = (name) => style.getPropertyValue(name);
  ink.font = `${11 * scale}px ${style.fontFamily}`;
  ink.lineWidth = scale;
  const colors = {
    main: style.color, lanes: LANES, line: style.borderColor, text: named("accent-color"),
  };
  return { ink, width, height, scale, colors };
}

/**
 * Draw a column. `orbit` is the camera for points.
 * @param {HTMLCanvasElement} canvas
 * @param {Plot} plot
 * @param {Elements} elements
 * @param {Column} column
 * @param {Orbit} orbit
 */
export function drawPlot(canvas, plot, elements, column, orbit) {
  const paper = paperOf(canvas);
  if (!paper || !elements.count) return;
  if (plot === "points") drawPoints(paper, elements, column, orbit);
  else if (plot === "values") drawValues(paper, elements, column);
  else drawHistogram(paper, elements, column);
}

// --- numbers -------------------------------------------------------------------------------------

/**
 * Functions from a diagram's coordinates to pixels.
 * @typedef {object} Axes
 * @property {(share: number) => number} x
 * @property {(value: number) => number} y
 */

/**
 * The frame of a diagram with the ends of its axes; an axis of numbers has a line at 0.
 * @param {Paper} paper
 * @param {[number, number]} range
 * @param {[string, string]} ends
 * @returns {Axes}
 */
function drawAxes(paper, [low, high], ends) {
  const { ink, width, height, scale, colors } = paper;
  const [left, right] = [MARGIN.left * scale, width - MARGIN.right * scale];
  const [top, bottom] = [MARGIN.top * scale, height - MARGIN.bottom * scale];
  /** @type {(value: number) => number} */
  const y = (value) => bottom - ((value - low) / (high - low || 1)) * (bottom - top);
  ink.strokeStyle = colors.line;
  ink.fillStyle = colors.text;
  ink.textBaseline = "middle";
  ink.textAlign = "right";
  const marks = new Set([low, high, ...(low < 0 && high > 0 ? [0] : [])]);
  for (const value of marks) {
    ink.beginPath();
    ink.moveTo(left, y(value));
    ink.lineTo(right, y(value));
    ink.stroke();
    ink.fillText(String(Number(value.toPrecision(4))), left - 8 * scale, y(value));
  }
  ink.textBaseline = "top";
  ink.textAlign = "left";
  ink.fillText(ends[0], left, bottom + 8 * scale);
  ink.textAlign = "right";
  ink.fillText(ends[1], right, bottom + 8 * scale);
  return { x: (share) => left + share * (right - left), y };
}

/**
 * Draw each lane in the order of the elements. If several elements share a column of pixels, its
 * line goes from the least to the greatest of them.
 * @param {Paper} paper
 * @param {Elements} elements
 * @param {Column} column
 */
function drawValues(paper, elements, column) {
  const { ink, width, scale, colors } = paper;
  const [low, high] = endsOf(elements, column);
  /** @type {[number, number]} */
  const ends = [Math.min(low, 0), Math.max(high, low < 0 ? 0 : low || 1)];
  const { x, y } = drawAxes(paper, ends, ["0", String(elements.count - 1)]);
  const columns = Math.min(elements.count, Math.floor(width / 2));
  const wide = (x(1) - x(0)) / columns;
  const isBars = column.places.length === 1;
  column.places.forEach((_, lane) => {
    ink.fillStyle = isBars ? colors.main : colors.lanes[lane % colors.lanes.length];
    for (let at = 0; at < columns; at++) {
      const first = Math.floor((at * elements.count) / columns);
      const last = Math.max(first + 1, Math.floor(((at + 1) * elements.count) / columns));
      let [least, greatest] = isBars ? [0, 0] : [Infinity, -Infinity];
      for (let number = first; number < last; number++) {
        const value = elements.get(column, lane, number);
        if (!Number.isFinite(value)) continue;
        least = Math.min(least, value);
        greatest = Math.max(greatest, value);
      }
      if (greatest < least) continue;
      const gap = isBars && wide > 4 * scale ? scale : 0;
      const high = Math.max(y(least) - y(greatest), 1.5 * scale);
      ink.fillRect(x(at / columns), y(greatest), Math.max(wide - gap, 1), high);
    }
  });
}

/**
 * Draw the number of elements with each value, or with a value in each of several ranges.
 * @param {Paper} paper
 * @param {Elements} elements
 * @param {Column} column
 */
function drawHistogram(paper, elements, column) {
  const { ink, scale, colors } = paper;
  let [low, high] = endsOf(elements, column);
  const isWhole = column.kind !== "float";
  const bars = isWhole ? Math.min(high - low + 1, MOST_BARS) : MOST_BARS;
  if (isWhole) high += 1;
  /** @type {number[]} */
  const counts = new Array(bars).fill(0);
  for (let number = 0; number < elements.count; number++) {
    const value = elements.get(column, 0, number);
    if (!Number.isFinite(value)) continue;
    const bar = Math.floor(((value - low) / (high - low || 1)) * bars);
    counts[Math.min(bar, bars - 1)] += 1;
  }
  /** @type {(value: number) => string} */
  const shown = (value) =>
    column.kind === "bool" ? String(Boolean(value)) : String(Number(value.toPrecision(4)));
  /** @type {[string, string]} */
  const ends = [shown(low), shown(isWhole ? high - 1 : high)];
  const { x, y } = drawAxes(paper, [0, Math.max(...counts, 1)], ends);
  ink.fillStyle = colors.main;
  counts.forEach((count, bar) => {
    const wide = (x(1) - x(0)) / bars;
    if (count) ink.fillRect(x(bar / bars), y(count), Math.max(wide - scale, 1), y(0) - y(count));
  });
}

/**
 * The least and the greatest finite number of all lanes.
 * @param {Elements} elements
 * @param {Column} column
 * @returns {[number, number]}
 */
function endsOf(elements, column) {
  let [low, high] = [Infinity, -Infinity];
  column.places.forEach((_, lane) => {
    for (let number = 0; number < elements.count; number++) {
      const value = elements.get(column, lane, number);
      if (!Number.isFinite(value)) continue;
      low = Math.min(low, value);
      high = Math.max(high, value);
    }
  });
  return low <= high ? [low, high] : [0, 1];
}

// --- points --------------------------------------------------------------------------------------

/**
 * A camera that sees all points of a column from the front; from the side and above, if they lie
 * in space.
 * @param {Elements} elements
 * @param {Column} column
 * @returns {Orbit}
 */
export function orbitAround(elements, column) {
  /** @type {number[]} */
  const lows = [0, 0, 0];
  /** @type {number[]} */
  const highs = [0, 0, 0];
  column.places.forEach((place, lane) => {
    [lows[lane], highs[lane]] = endsOf(elements, { ...column, places: [place] });
  });
  const target = /** @type {Vector} */ (lows.map((low, lane) => (low + highs[lane]) / 2));
  const radius = Math.hypot(...lows.map((low, lane) => highs[lane] - low)) / 2 || 1;
  const distance = 2.7 * radius;
  const way = column.places.length === 3 ? [0.45, 0.35, 0.82] : [0, 0, 1];
  const eye = /** @type {Vector} */ (target.map((lane, axis) => lane + distance * way[axis]));
  return new Orbit({
    eye, target, up: [0, 1, 0], fov: 0.78, height: 1, near: 0.01 * radius, far: null,
  });
}

/**
 * Draw points, or the lines and triangles whose corners they are.
 * @param {Paper} paper
 * @param {Elements} elements
 * @param {Column} column
 * @param {Orbit} orbit
 */
function drawPoints(paper, elements, column, orbit) {
  const { ink, width, height, scale, colors } = paper;
  const matrix = orbit.viewProjection(Math.max(1, height / width));
  const side = (elements.count > MANY ? 1.5 : 3) * scale;
  /** @type {(number: number) => [number, number] | null} */
  const place = (number) => {
    const at = column.places.map((_, lane) => elements.get(column, lane, number));
    const [x, y, , w] = [0, 1, 2, 3].map((row) =>
      matrix[3][row] + at.reduce((sum, lane, axis) => sum + matrix[axis][row] * lane, 0),
    );
    if (!(w > 0)) return null;
    return [(0.5 + (0.5 * x * height) / width / w) * width, (0.5 - (0.5 * y) / w) * height];
  };
  ink.fillStyle = ink.strokeStyle = colors.main;
  const { corners } = elements.layout;
  const step = corners * Math.ceil(elements.count / corners / MOST_POINTS);
  if (corners > 1) {
    ink.lineWidth = 0.75 * scale;
    ink.beginPath();
    for (let first = 0; first + corners <= elements.count; first += step) {
      const places = Array.from({ length: corners }, (_, corner) => place(first + corner));
      const ends = places.filter((end) => end !== null);
      if (ends.length < corners) continue;
      ends.forEach((end, corner) => (corner ? ink.lineTo(...end) : ink.moveTo(...end)));
      ink.closePath();
    }
    ink.stroke();
    return;
  }
  for (let number = 0; number < elements.count; number += step) {
    const found = place(number);
    if (found) ink.fillRect(found[0] - side / 2, found[1] - side / 2, side, side);
  }
}
