// A camera that turns around a point. World space is right-handed with y upwards, and z of clip
// space goes from 0 to w.

export type Vector = [number, number, number];

/** Where the camera begins: what `orbit.py` makes. */
export interface OrbitRow {
  eye: Vector;
  target: Vector;
  up: Vector;
  /** The angle of view from bottom to top in radians; null without perspective. */
  fov: number | null;
  /** Without perspective: how much it sees from bottom to top. */
  height: number;
  near: number;
  /** Null means that it sees everything behind `near`. */
  far: number | null;
}

const STEEPEST = Math.PI / 2 - 0.001;
const NEAREST = 1e-3;
const FURTHEST = 1e4;

export class Orbit {
  private target: Vector;
  private yaw: number;
  private pitch: number;
  /** How far away the eye is, as a multiple of where it began. */
  private zoomed = 1;
  private readonly distance: number;

  constructor(private readonly start: OrbitRow) {
    this.target = [...start.target];
    const [x, y, z] = minus(start.eye, start.target);
    this.distance = Math.hypot(x, y, z);
    this.yaw = Math.atan2(x, z);
    this.pitch = Math.asin(y / this.distance);
  }

  /** Turn by angles, to the right and upwards. */
  turn(yaw: number, pitch: number): void {
    this.yaw += yaw;
    this.pitch = Math.min(Math.max(this.pitch + pitch, -STEEPEST), STEEPEST);
  }

  /** Move sideways, by shares of the picture's height. */
  pan(right: number, up: number): void {
    const [x, y] = this.axes();
    const { fov, height } = this.start;
    const whole = this.zoomed * (fov === null ? height : 2 * this.distance * Math.tan(fov / 2));
    this.target = this.target.map(
      (lane, i) => lane + whole * (right * x[i]! + up * y[i]!),
    ) as Vector;
  }

  /** Go so many times as far away. */
  zoom(factor: number): void {
    this.zoomed = Math.min(Math.max(this.zoomed * factor, NEAREST), FURTHEST);
  }

  get eye(): Vector {
    const [, , back] = this.axes();
    const away = this.distance * this.zoomed;
    return this.target.map((lane, i) => lane + away * back[i]!) as Vector;
  }

  /** World space to the clip space of a square picture, as four columns. `widening` is how many
   * times as much is seen as usual: for pictures that are higher than wide. */
  viewProjection(widening = 1): number[][] {
    const eye = this.eye;
    const rows = this.axes().map((axis) => [...axis, -dot(axis, eye)]) as number[][];
    const [right, up, back] = rows as [number[], number[], number[]];
    const { fov, height } = this.start;
    const near = this.start.near * Math.min(this.zoomed, 1);
    const far = this.start.far === null ? Infinity : this.start.far * Math.max(this.zoomed, 1);
    const infinite = far === Infinity;
    let x: number[], z: number[], w: number[], y: number[];
    if (fov === null) {
      const scale = 2 / (height * widening * this.zoomed);
      const depth = 1 / (near - far);
      [x, y] = [scaled(right, scale), scaled(up, scale)];
      z = scaled(back, depth);
      z[3] = z[3]! + near * depth;
      w = [0, 0, 0, 1];
    } else {
      const scale = 1 / (Math.tan(fov / 2) * widening);
      const depth = infinite ? -1 : far / (near - far);
      [x, y] = [scaled(right, scale), scaled(up, scale)];
      z = scaled(back, depth);
      z[3] = z[3]! + near * depth;
      w = scaled(back, -1);
    }
    return [0, 1, 2, 3].map((column) => [x[column]!, y[column]!, z[column]!, w[column]!]);
  }

  /** To the right, upwards and back towards the eye. */
  private axes(): [Vector, Vector, Vector] {
    const [sy, cy] = [Math.sin(this.yaw), Math.cos(this.yaw)];
    const [sp, cp] = [Math.sin(this.pitch), Math.cos(this.pitch)];
    return [
      [cy, 0, -sy],
      [-sy * sp, cp, -cy * sp],
      [sy * cp, sp, cy * cp],
    ];
  }
}

function minus(a: Vector, b: Vector): Vector {
  return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}

function dot(a: Vector, b: Vector): number {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

function scaled(row: number[], factor: number): number[] {
  return row.map((lane) => lane * factor);
}
