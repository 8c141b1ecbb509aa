#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
// Vignette: fragment shader, by Burnish.
// Darkens the corners of a picture.

layout(std140) uniform Draw {
    float strength;
};

uniform sampler2D picture;
uniform float viewport_height;

layout(location = 0) out vec4 out_dark;  /// The picture, and in its alpha how dark it became.
layout(location = 1) out float out_light_;

void main() {
    ivec2 texel = ivec2(vec4(gl_FragCoord.x, viewport_height - gl_FragCoord.y, gl_FragCoord.zw).xy);
    ivec2 place_texture_size = textureSize(picture, 0);
    vec2 place = (2.0 * vec2(texel) + 1.0) / vec2(place_texture_size) - 1.0;
    float light = 1.0 - strength * dot(place, place);
    out_dark = vec4(
        texelFetch(picture, clamp(texel, ivec2(0), place_texture_size - 1), 0).xyz * light, light
    );
    out_light_ = light;
}
