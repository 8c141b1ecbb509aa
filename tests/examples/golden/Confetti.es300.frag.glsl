#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
// Confetti: fragment shader, by Burnish.
// Paper that somebody has strewn with squares.

layout(std140) uniform Material {
    vec3 paper;
    int cells;  /// Squares across
    uint seed;
};

layout(std140) uniform MaterialDerived {
    float place_to_float;
    uint drawn_shift_left;
};

in vec2 v_place;

layout(location = 0) out vec4 out_color;

vec4 safe_unpack_unorm4x8(uint p) {
    return vec4(uvec4(p, p >> 8u, p >> 16u, p >> 24u) & uvec4(255u)) / 255.0;
}

void main() {
    // Clamped to the floats that an `int` holds.
    int column = int(clamp(floor(v_place.x), -2147483600.0, 2147483500.0));
    // Clamped to the floats that an `int` holds.
    int row = int(clamp(floor(v_place.y), -2147483600.0, 2147483500.0));
    uint drawn_bit_xor = uint((column & 255) | ((row & 255) << 8u)) ^ drawn_shift_left;
    uint drawn_twisted = (drawn_bit_xor ^ (drawn_bit_xor >> 15u)) * 2146121005u;
    uint drawn = (drawn_twisted ^ (drawn_twisted >> 15u)) * 2221713035u;
    vec4 chance = safe_unpack_unorm4x8(drawn);
    vec2 centre = mix(vec2(0.25), vec2(0.75), chance.xy);
    bool inside = all(lessThan(abs(fract(v_place) - centre), vec2(0.08 + 0.14 * chance.z)));
    uint tint_twisted = (drawn ^ (drawn >> 15u)) * 2146121005u;
    vec3 tint = safe_unpack_unorm4x8((tint_twisted ^ (tint_twisted >> 15u)) * 2221713035u).xyz;
    vec3 color = inside && chance.w > 0.3 ? tint * tint : paper;
    out_color = vec4(color, 1.0);
}
