#version 310 es
precision highp float;
precision highp int;
precision highp sampler2D;
// Odd: vertex shader, by Burnish.

layout(location = 0) flat out uint v_id;

void main() {
    v_id = uint(gl_InstanceID) + 7u;
    gl_Position = vec4(float(uint(gl_VertexID)), -0.5, 1e-7, 1.0);
    gl_Position.z = 2.0 * gl_Position.z - gl_Position.w;
}
