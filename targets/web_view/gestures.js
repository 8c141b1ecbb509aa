// Turns gestures of mouse, fingers and keys on the picture into movements of the camera.

/** @import { Orbit } from "./orbit.js" */

const KEY_TURN = Math.PI / 36;
const KEY_PAN = 0.05;
const KEY_ZOOM = 1.1;
const WHEEL_ZOOM = 0.0015;
/** A wheel's units, pixel, line and page, in pixels. */
const WHEEL_UNITS = [1, 16, 400];

/** @typedef {{ x: number, y: number }} Place */

/**
 * Follow gestures on an element. `orbit` gives the camera, which changes with what is shown;
 * `moved` is called after each movement.
 * @param {HTMLElement} element
 * @param {() => Orbit | null} orbit
 * @param {() => void} moved
 */
export function follow(element, orbit, moved) {
  /** @type {Map<number, Place>} */
  const held = new Map();

  /** @type {(movement: (camera: Orbit) => void) => void} */
  const act = (movement) => {
    const camera = orbit();
    if (!camera) return;
    movement(camera);
    moved();
  };

  element.addEventListener("pointerdown", (event) => {
    element.setPointerCapture(event.pointerId);
    held.set(event.pointerId, { x: event.clientX, y: event.clientY });
    element.focus({ preventScroll: true });
  });
  for (const name of /** @type {const} */ (["pointerup", "pointercancel"])) {
    element.addEventListener(name, (event) => held.delete(event.pointerId));
  }
  element.addEventListener("contextmenu", (event) => event.preventDefault());

  element.addEventListener("pointermove", (event) => {
    const before = held.get(event.pointerId);
    if (!before) return;
    const now = { x: event.clientX, y: event.clientY };
    const other = [...held].find(([id]) => id !== event.pointerId)?.[1];
    held.set(event.pointerId, now);
    const high = element.clientHeight || 1;
    const [right, down] = [(now.x - before.x) / high, (now.y - before.y) / high];
    act((camera) => {
      if (other) {
        camera.zoom(distance(before, other) / Math.max(distance(now, other), 1));
        camera.pan(-right / 2, down / 2);
      } else if (event.shiftKey || event.buttons & 6) {
        camera.pan(-right, down);
      } else {
        camera.turn(-Math.PI * right, Math.PI * down);
      }
    });
  });

  element.addEventListener("wheel", (event) => {
    event.preventDefault();
    const pixels = event.deltaY * WHEEL_UNITS[event.deltaMode];
    act((camera) => camera.zoom(Math.exp(pixels * WHEEL_ZOOM)));
  }, { passive: false });

  element.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    const step = KEYS[event.key];
    if (!step) return;
    event.preventDefault();
    act((camera) => {
      if (step.zoom) camera.zoom(step.zoom);
      else if (event.shiftKey) camera.pan(KEY_PAN * step.right, KEY_PAN * step.up);
      else camera.turn(KEY_TURN * step.right, KEY_TURN * step.up);
    });
  });
}

/**
 * The movement of each key: a direction, or a factor of the distance.
 * @type {Record<string, { right: number, up: number, zoom?: number }>}
 */
const KEYS = {
  ArrowLeft: { right: -1, up: 0 },
  ArrowRight: { right: 1, up: 0 },
  ArrowUp: { right: 0, up: 1 },
  ArrowDown: { right: 0, up: -1 },
  "+": { right: 0, up: 0, zoom: 1 / KEY_ZOOM },
  "=": { right: 0, up: 0, zoom: 1 / KEY_ZOOM },
  "-": { right: 0, up: 0, zoom: KEY_ZOOM },
};

/**
 * @param {Place} a
 * @param {Place} b
 * @returns {number}
 */
function distance(a, b) {
  return Math.hypot(a.x - b.x, a.y - b.y);
}
