#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
// Confetti: vertex shader, by Burnish.
// Paper that somebody has strewn with squares.

layout(std140) uniform View {
    mat4 view_projection;  /// World to clip space
    vec3 eye;  /// Where the viewer stands
};

layout(std140) uniform Material {
    vec3 paper;
    int cells;  /// Squares across
    uint seed;
};

layout(std140) uniform Draw {
    mat4 object_to_world;
};

layout(location = 0) in vec3 vertex_position;
layout(location = 2) in vec2 vertex_uv;

out vec2 v_place;

void main() {
    vec3 position = (object_to_world * vec4(vertex_position, 1.0)).xyz;
    v_place = vertex_uv * float(cells);
    gl_Position = view_projection * vec4(position, 1.0);
    gl_Position.z = 2.0 * gl_Position.z - gl_Position.w;
}
