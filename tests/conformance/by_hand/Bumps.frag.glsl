#version 450

layout(location = 0) in vec3 color_at_vertex;

layout(location = 0) out vec4 color;

void main() {
    color = vec4(color_at_vertex, 1.0);
}
