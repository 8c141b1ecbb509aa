#version 450

layout(std140, set = 0, binding = 1) uniform Camera {
    mat4 world_to_clip;
};

layout(quads, equal_spacing, cw) in;

layout(location = 0) in vec2 uv_of_point[];
layout(location = 1) patch in float bump_of_patch;

layout(location = 0) out vec3 color_at_vertex;

void main() {
    float u = gl_TessCoord.x, v = gl_TessCoord.y;
    vec4 weights = vec4((1.0 - u) * (1.0 - v), u * (1.0 - v), u * v, (1.0 - u) * v);
    vec4 place = vec4(0.0);
    float across = 0.0;
    for (int point = 0; point < 4; point++) {
        place += weights[point] * gl_in[point].gl_Position;
        across += weights[point] * uv_of_point[point].y;
    }
    float bump = bump_of_patch * (u - u * u);
    place.z += bump;
    gl_Position = world_to_clip * place;
    color_at_vertex = vec3(bump, u, across);
}
