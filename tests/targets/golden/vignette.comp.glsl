#version 450
#extension GL_EXT_samplerless_texture_functions : require
// Vignette: compute shader, by Burnish.
// Darkens the corners of a picture.

layout(std140, set = 3, binding = 0) uniform Draw {
    float strength;
};

layout(rgba16f, set = 3, binding = 2) writeonly uniform image2D dark;
layout(r32f, set = 3, binding = 3) writeonly uniform image2D light_;
layout(set = 3, binding = 4) uniform texture2D picture;

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
