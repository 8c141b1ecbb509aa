// A camera that turns around a point. World space is right-handed with y upwards, and z of clip
// space goes from 0 to w.
const STEEPEST = Math.PI / 2 - 0.001;
const NEAREST = 1e-3;
const FURTHEST = 1e4;
export class Orbit {
    start;
    target;
    yaw;
    pitch;
    /** How far away the eye is, as a multiple of where it began. */
    zoomed = 1;
    distance;
    constructor(start) {
        this.start = start;
        this.target = [...start.target];
        const [x, y, z] = minus(start.eye, start.target);
        this.distance = Math.hypot(x, y, z);
        this.yaw = Math.atan2(x, z);
        this.pitch = Math.asin(y / this.distance);
    }
    /** Turn by angles, to the right and upwards. */
    turn(yaw, pitch) {
        this.yaw += yaw;
        this.pitch = Math.min(Math.max(this.pitch + pitch, -STEEPEST), STEEPEST);
    }
    /** Move sideways, by shares of the picture's height. */
    pan(right, up) {
        const [x, y] = this.axes();
        const { fov, height } = this.start;
        const whole = this.zoomed * (fov === null ? height : 2 * this.distance * Math.tan(fov / 2));
        this.target = this.target.map((lane, i) => lane + whole * (right * x[i] + up * y[i]));
    }
    /** Go so many times as far away. */
    zoom(factor) {
        this.zoomed = Math.min(Math.max(this.zoomed * factor, NEAREST), FURTHEST);
    }
    get eye() {
        const [, , back] = this.axes();
        const away = this.distance * this.zoomed;
        return this.target.map((lane, i) => lane + away * back[i]);
    }
    /** World space to the clip space of a square picture, as four columns. `widening` is how many
     * times as much is seen as usual: for pictures that are higher than wide. */
    viewProjection(widening = 1) {
        const eye = this.eye;
        const rows = this.axes().map((axis) => [...axis, -dot(axis, eye)]);
        const [right, up, back] = rows;
        const { fov, height } = this.start;
        const near = this.start.near * Math.min(this.zoomed, 1);
        const far = this.start.far === null ? Infinity : this.start.far * Math.max(this.zoomed, 1);
        const infinite = far === Infinity;
        let x, z, w, y;
        if (fov === null) {
            const scale = 2 / (height * widening * this.zoomed);
            const depth = 1 / (near - far);
            [x, y] = [scaled(right, scale), scaled(up, scale)];
            z = scaled(back, depth);
            z[3] = z[3] + near * depth;
            w = [0, 0, 0, 1];
        }
        else {
            const scale = 1 / (Math.tan(fov / 2) * widening);
            const depth = infinite ? -1 : far / (near - far);
            [x, y] = [scaled(right, scale), scaled(up, scale)];
            z = scaled(back, depth);
            z[3] = z[3] + near * depth;
            w = scaled(back, -1);
        }
        return [0, 1, 2, 3].map((column) => [x[column], y[column], z[column], w[column]]);
    }
    /** To the right, upwards and back towards the eye. */
    axes() {
        const [sy, cy] = [Math.sin(this.yaw), Math.cos(this.yaw)];
        const [sp, cp] = [Math.sin(this.pitch), Math.cos(this.pitch)];
        return [
            [cy, 0, -sy],
            [-sy * sp, cp, -cy * sp],
            [sy * cp, sp, cy * cp],
        ];
    }
}
function minus(a, b) {
    return [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
}
function dot(a, b) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
function scaled(row, factor) {
    return row.map((lane) => lane * factor);
}
