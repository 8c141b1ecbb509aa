// A camera that turns around a point. World space is right-handed with y upwards, and z of clip
// space goes from 0 to w.

/** @typedef {[number, number, number]} Vector */

/**
 * The camera's first position, from `orbit.py`.
 * @typedef {object} OrbitRow
 * @property {Vector} eye
 * @property {Vector} target
 * @property {Vector} up
 * @property {number | null} fov The angle of view from bottom to top in radians; null without
 *   perspective.
 * @property {number} height Without perspective: the height of the view in world space.
 * @property {number} near
 * @property {number | null} far Null means that it sees everything behind `near`.
 */

const STEEPEST = Math.PI / 2 - 0.001;
const NEAREST = 1e-3;
const FURTHEST = 1e4;

export class Orbit {
  /** @type {Vector} */
  #target;
  /** @type {number} */
  #yaw;
  /** @type {number} */
  #pitch;
  /** The distance of the eye, as a multiple of its first one. */
  #zoomed = 1;
  /** @type {number} */
  #distance;

  #start;

  /** @param {OrbitRow} start */
  constructor(start) {
    this.#start = start;
    this.#target = [...start.target];
    const [x, y, z] = minus(start.eye, start.target);
    this.#distance = Math.hypot(x, y, z);
    this.#yaw = Math.atan2(x, z);
    this.#pitch = Math.asin(y / this.#distance);
  }

  /**
   * Turn by angles, to the right and upwards.
   * @param {number} yaw
   * @param {number} pitch
   */
  turn(yaw, pitch) {
    this.#yaw += yaw;
    this.#pitch = Math.min(Math.max(this.#pitch + pitch, -STEEPEST), STEEPEST);
  }

  /**
   * Move sideways, by shares of the picture's height.
   * @param {number} right
   * @param {number} up
   */
  pan(right, up) {
    const [x, y] = this.#axes();
    const { fov, height } = this.#start;
    const whole = this.#zoomed * (fov === null ? height : 2 * this.#distance * Math.tan(fov / 2));
    const moved = this.#target.map((lane, i) => lane + whole * (right * x[i] + up * y[i]));
    this.#target = /** @type {Vector} */ (moved);
  }

  /**
   * Multiply the distance of the eye by a factor.
   * @param {number} factor
   */
  zoom(factor) {
    this.#zoomed = Math.min(Math.max(this.#zoomed * factor, NEAREST), FURTHEST);
  }

  /** @returns {Vector} */
  get eye() {
    const [, , back] = this.#axes();
    const away = this.#distance * this.#zoomed;
    return /** @type {Vector} */ (this.#target.map((lane, i) => lane + away * back[i]));
  }

  /**
   * World space to the clip space of a square picture, as four columns. `widening` is a
   * factor of the view's size: above 1 for pictures that are higher than wide.
   * @returns {number[][]}
   */
  viewProjection(widening = 1) {
    const { eye } = this;
    const [right, up, back] = this.#axes().map((axis) => [...axis, -dot(axis, eye)]);
    const { fov, height } = this.#start;
    const near = this.#start.near * Math.min(this.#zoomed, 1);
    const far = this.#start.far === null ? Infinity : this.#start.far * Math.max(this.#zoomed, 1);
    const isFlat = fov === null;
    const half = isFlat ? (height * this.#zoomed) / 2 : Math.tan(fov / 2);
    const scale = 1 / (half * widening);
    const depth = isFlat ? 1 / (near - far) : far === Infinity ? -1 : far / (near - far);
    const [x, y, z] = [scaled(right, scale), scaled(up, scale), scaled(back, depth)];
    z[3] += near * depth;
    const w = isFlat ? [0, 0, 0, 1] : scaled(back, -1);
    return [0, 1, 2, 3].map((column) => [x[column], y[column], z[column], w[column]]);
  }

  /**
   * The camera's axes: to the right, upwards, and back towards the eye.
   * @returns {[Vector, Vector, Vector]}
   */
  #axes() {
    const [sy, cy] = [Math.sin(this.#yaw), Math.cos(this.#yaw)];
    const [sp, cp] = [Math.sin(this.#pitch), Math.cos(this.#pitch)];
    return [
      [cy, 0, -sy],
      [-sy * sp, cp, -cy * sp],
      [sy * cp, sp, cy * cp],
    ];
  }
}

/**
 * @param {Vector} a
 * @param {Vector} b
 * @returns {Vector}
 */
function minus(a, b) {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

/**
 * @param {Vector} a
 * @param {Vector} b
 * @returns {number}
 */
function dot(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/**
 * @param {number[]} row
 * @param {number} factor
 * @returns {number[]}
 */
function scaled(row, factor) {
  return row.map((lane) => lane * factor);
}
