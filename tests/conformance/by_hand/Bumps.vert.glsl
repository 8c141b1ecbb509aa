#version 450

layout(std140, set = 3, binding = 0) uniform Object {
    mat4 object_to_world;
};

layout(location = 0) in vec3 place;
layout(location = 2) in vec2 uv;

layout(location = 0) out vec2 uv_of_corner;

void main() {
    gl_Position = object_to_world * vec4(place, 1.0);
    uv_of_corner = uv;
}
