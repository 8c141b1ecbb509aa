#version 450

layout(std140, set = 0, binding = 0) uniform View {
    mat4 view_projection;
    vec3 eye;
};
layout(std140, set = 2, binding = 0) uniform Material {
    vec3 base;
    vec3 sheen;
    float strand_length;
    float droop;
    float frizz;
    float number;
};
layout(std140, set = 2, binding = 1) uniform MaterialDerived {
    float strands;
};

layout(isolines, equal_spacing) in;

layout(location = 1) in vec3 place[];
layout(location = 2) in vec3 normal[];
layout(location = 0) patch in uint edge;

layout(location = 0) out vec4 strand_and_light;
layout(location = 1) out vec3 view;

uint twisted(uint x, uint factor) {
    return (x ^ (x >> 15u)) * factor;
}

vec4 chance_of(uint number) {
    uint bits = twisted(twisted(number, 2146121005u), 2221713035u);
    return vec4(uvec4(bits, bits >> 8u, bits >> 16u, bits >> 24u) & uvec4(255u)) / 255.0;
}

void main() {
    float along = gl_TessCoord.x;
    float across = gl_TessCoord.y;
    uint row = uint(clamp(roundEven(across * strands), 0.0, 4294967000.0));
    vec4 chance = chance_of(32u * edge + row);

    vec3 growth = normalize(mix(normal[0], normal[1], across) + frizz * (2.0 * chance.xyz - 1.0));
    vec3 fall = vec3(0.0, -droop, 0.0);
    vec3 root = mix(place[0], place[1], across);
    vec3 at = root + along * strand_length * (0.5 + chance.w) * (growth + along * fall);

    strand_and_light = vec4(growth + 2.0 * along * fall, 0.3 + 0.7 * along);
    view = eye - at;
    gl_Position = view_projection * vec4(at, 1.0);
}
