#version 450 core
// Toy: fragment shader, by Burnish.

layout(location = 0) in vec4 v_varying;

layout(location = 0) out vec4 out_color;

void main() {
    out_color = v_varying;
}
