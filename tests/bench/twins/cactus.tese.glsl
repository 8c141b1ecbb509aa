#version 450

layout(std140, set = 2, binding = 0) uniform Material {
    int ribs;
    float depth;
    float thorn_length;
};
layout(std140, set = 2, binding = 1) uniform MaterialDerived {
    float ribs_in_radians;
};
layout(std140, set = 3, binding = 0) uniform Draw {
    mat4 object_to_world;
};
layout(std140, set = 3, binding = 1) uniform DrawDerived {
    mat3x4 normal_matrix;
};

layout(triangles, equal_spacing, cw) in;

layout(location = 0) in vec3 place[];
layout(location = 1) in vec3 normal[];
layout(location = 2) in vec2 uv[];

layout(location = 0) out vec4 place_and_rib;
layout(location = 1) out vec4 direction_and_phase;
layout(location = 2) out vec3 normal_of_cactus;

vec3 mixed(vec3 a, vec3 b, vec3 c) {
    return gl_TessCoord.x * a + gl_TessCoord.y * b + gl_TessCoord.z * c;
}

void main() {
    vec3 world = (object_to_world * vec4(mixed(place[0], place[1], place[2]), 1.0)).xyz;
    float phase = ribs_in_radians * dot(gl_TessCoord, vec3(uv[0].x, uv[1].x, uv[2].x));
    float rib = 0.5 + 0.5 * cos(phase);

    vec3 upright = (normal_matrix * mixed(normal[0], normal[1], normal[2])).xyz;
    vec3 n = upright * inversesqrt(max(dot(upright, upright), 1.1754944e-38));
    place_and_rib = vec4(world - depth * (1.0 - rib) * n, rib);
    direction_and_phase = vec4(n, phase);
    normal_of_cactus = upright;
}
