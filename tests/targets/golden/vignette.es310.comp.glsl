#version 310 es
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp image2D;
// Vignette: compute shader, by Burnish.
// Darkens the corners of a picture.

layout(std140, binding = 8) uniform Draw {
    float strength;
};

layout(rgba16f, binding = 0) writeonly uniform image2D dark;
layout(r32f, binding = 1) writeonly uniform image2D light_;
layout(binding = 2) uniform sampler2D picture;

layout(local_size_x = 8, local_size_y = 8) in;

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 place_texture_size = textureSize(picture, 0);
    vec2 place = (2.0 * vec2(texel) + 1.0) / vec2(place_texture_size) - 1.0;
    float light = 1.0 - strength * dot(place, place);
    imageStore(
        dark, texel,
        vec4(texelFetch(picture, clamp(texel, ivec2(0), place_texture_size - 1), 0).xyz * light, light)
    );
    imageStore(light_, texel, vec4(light, 0.0, 0.0, 1.0));
}
