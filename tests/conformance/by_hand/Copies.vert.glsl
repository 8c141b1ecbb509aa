#version 450

layout(location = 0) in vec3 place;
layout(location = 2) in vec2 uv;

layout(location = 0) out vec2 uv_of_corner;

void main() {
    gl_Position = vec4(place, 1.0);
    uv_of_corner = uv;
}
