#version 450 core
// Odd: vertex shader, by Burnish.

layout(location = 0) flat out uint v_id;

void main() {
    v_id = uint(gl_InstanceID) + 7u;
    gl_Position = vec4(float(uint(gl_VertexID)), -0.5, 1e-7, 1.0);
}
