#version 450

layout(std140, set = 0, binding = 0) uniform View {
    mat4 view_projection;
    vec3 eye;
};
layout(std140, set = 3, binding = 0) uniform Draw {
    mat4 object_to_world;
};
layout(std140, set = 3, binding = 1) uniform DrawDerived {
    mat3x4 normal_matrix;
};

layout(quads, fractional_odd_spacing, cw) in;

layout(location = 0) in vec3 place[];
layout(location = 1) in vec3 normal[];
layout(location = 2) in vec2 uv[];

layout(location = 0) out vec2 uv_of_hills;

vec3 mixed(vec3 a, vec3 b, vec3 c, vec3 d) {
    return mix(mix(a, b, gl_TessCoord.x), mix(d, c, gl_TessCoord.x), gl_TessCoord.y);
}

float ripple(float x) {
    return 8.0 * x * x * (x * x - 1.0) + 1.0;
}

void main() {
    vec3 world = (object_to_world * vec4(mixed(place[0], place[1], place[2], place[3]), 1.0)).xyz;
    vec2 at = mix(
        mix(uv[0], uv[1], gl_TessCoord.x), mix(uv[3], uv[2], gl_TessCoord.x), gl_TessCoord.y
    );
    vec2 twice = 2.0 * at - 1.0;
    float hill = 0.12 * ripple(twice.x) * ripple(twice.y);

    vec3 upright = (normal_matrix * mixed(normal[0], normal[1], normal[2], normal[3])).xyz;
    vec3 n = upright * inversesqrt(max(dot(upright, upright), 1.1754944e-38));
    uv_of_hills = at;
    gl_Position = view_projection * vec4(world + hill * n, 1.0);
}
