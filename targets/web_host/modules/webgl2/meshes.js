// Brings meshes to WebGL 2.
import { interleaved } from "./vertices.js";
/** What draws each topology, and how many vertices its primitives have. */
export const MODES = {
    point: ["POINTS", 1], line: ["LINES", 2], triangle: ["TRIANGLES", 3],
};
export const topologyOf = ({ draw }) => (draw?.topology ?? "triangle");
export function uploadMesh(gl, program, reflection, mesh) {
    const vertices = gl.createVertexArray();
    gl.bindVertexArray(vertices);
    const buffers = interleaved(reflection).map(({ step, stride, members }) => {
        const data = step === "vertex" ? mesh.vertices : mesh.instances;
        const buffer = filled(gl, gl.ARRAY_BUFFER, data);
        for (const { input: { name, representation }, lanes, offset } of members) {
            const location = program.inputs.get(name);
            if (location === undefined)
                continue; // not read, so left out by the linker
            gl.enableVertexAttribArray(location);
            gl.vertexAttribDivisor(location, step === "instance" ? 1 : 0);
            const kind = { i: gl.INT, u: gl.UNSIGNED_INT }[representation[0]];
            if (kind)
                gl.vertexAttribIPointer(location, lanes, kind, stride, offset);
            else
                gl.vertexAttribPointer(location, lanes, gl.FLOAT, false, stride, offset);
        }
        return buffer;
    });
    const indices = mesh.indices
        ? new Uint32Array(mesh.indices.buffer)
        : Uint32Array.from({ length: mesh.count }, (_, at) => at);
    const [, corners] = MODES[topologyOf(reflection)];
    const turned = firstVertexLast(indices, corners);
    const elements = filled(gl, gl.ELEMENT_ARRAY_BUFFER, turned);
    gl.bindVertexArray(null);
    return { vertices, buffers: [...buffers, elements], count: turned.length };
}
export function freeMesh(gl, { vertices, buffers }) {
    gl.deleteVertexArray(vertices);
    buffers.forEach((each) => gl.deleteBuffer(each));
}
function filled(gl, kind, data) {
    const buffer = gl.createBuffer();
    gl.bindBuffer(kind, buffer);
    gl.bufferData(kind, data, gl.STATIC_DRAW);
    return buffer;
}
/** The same primitives, with the first vertex of each moved to the end: a flat varying has its
 * value at the first one, but in WebGL at the last. */
function firstVertexLast(indices, corners) {
    const turned = new Uint32Array(Math.floor(indices.length / corners) * corners);
    for (let at = 0; at < turned.length; at += corners) {
        turned.set(indices.subarray(at + 1, at + corners), at);
        turned[at + corners - 1] = indices[at];
    }
    return turned;
}
