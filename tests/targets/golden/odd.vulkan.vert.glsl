#version 450
// Odd: vertex shader, by Burnish.

layout(location = 0) flat out uint v_id;

void main() {
    v_id = uint(gl_InstanceIndex) + 7u;
    gl_Position = vec4(float(uint(gl_VertexIndex)), -0.5, 1e-7, 1.0);
}
