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

in vec2 v_place;

layout(location = 0) out vec4 out_color;

/// Mixes the bits of a number until each depends on all of them.
uint scattered(uint n) {
    uint twisted = (n ^ (n >> 15u)) * 2146121005u;
    return (twisted ^ (twisted >> 15u)) * 2221713035u;
}

vec4 safe_unpack_unorm4x8(uint p) {
    return vec4(uvec4(p, p >> 8u, p >> 16u, p >> 24u) & uvec4(255u)) / 255.0;
}

void main() {
    // Clamped to the floats that an `int` holds.
    int column = int(clamp(floor(v_place.x), -2147483600.0, 2147483500.0));
    // Clamped to the floats that an `int` holds.
    int row = int(clamp(floor(v_place.y), -2147483600.0, 2147483500.0));
    uint drawn = scattered(uint((column & 255) | ((row & 255) << 8u)) ^ (seed << 16u));
    vec4 chance = safe_unpack_unorm4x8(drawn);
    vec2 centre = mix(vec2(0.25), vec2(0.75), chance.xy);
    bool inside = all(lessThan(abs(fract(v_place) - centre), vec2(0.08 + 0.14 * chance.z)));
    vec3 color;
    if (inside && chance.w > 0.3) {
        vec3 tint = safe_unpack_unorm4x8(scattered(drawn)).xyz;
        color = tint * tint;
    } else {
        color = paper;
    }
    out_color = vec4(color, 1.0);
}
