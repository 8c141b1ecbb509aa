#version 450

layout(std140, set = 0, binding = 0) uniform View {
    mat4 view_projection;
    vec3 eye;
};
layout(std140, set = 2, binding = 0) uniform Material {
    float depth;
};
layout(std140, set = 3, binding = 0) uniform Draw {
    mat4 object_to_world;
};
layout(std140, set = 3, binding = 1) uniform DrawDerived {
    mat3x4 normal_matrix;
};

layout(triangles, fractional_odd_spacing, cw) in;

layout(location = 0) in vec3 place[];
layout(location = 1) in vec3 normal[];
layout(location = 3) in vec2 uv[];

layout(location = 0) out vec2 uv_of_dents;

vec3 mixed(vec3 a, vec3 b, vec3 c) {
    return gl_TessCoord.x * a + gl_TessCoord.y * b + gl_TessCoord.z * c;
}

float wave(float x) {
    return 2.0 * x * x - 1.0;
}

void main() {
    vec3 world = (object_to_world * vec4(mixed(place[0], place[1], place[2]), 1.0)).xyz;
    vec2 at = gl_TessCoord.x * uv[0] + gl_TessCoord.y * uv[1] + gl_TessCoord.z * uv[2];
    vec2 twice = 2.0 * at - 1.0;
    float dented = wave(wave(wave(twice.x))) * wave(wave(twice.y));

    vec3 upright = (normal_matrix * mixed(normal[0], normal[1], normal[2])).xyz;
    vec3 n = upright * inversesqrt(max(dot(upright, upright), 1.1754944e-38));
    uv_of_dents = at;
    gl_Position = view_projection * vec4(world - depth * dented * n, 1.0);
}
