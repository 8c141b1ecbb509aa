// Never compiled by Apple's compiler: only type-checked by clang.
// Compile it without fast maths (-fno-fast-math), which would do away with infinities.
#include <metal_stdlib>
using namespace metal;
// Vignette: compute shader, by Burnish.
// Darkens the corners of a picture.

struct Draw {
    float strength;
};

int2 texture_size(texture2d<float> texels, int level) {
    return int2(int(texels.get_width(uint(level))), int(texels.get_height(uint(level))));
}

kernel void cs_main(
    uint2 texel [[thread_position_in_grid]], constant Draw& draw [[buffer(8)]],
    texture2d<float, access::write> dark [[texture(0)]],
    texture2d<float, access::write> light_ [[texture(1)]], texture2d<float> picture [[texture(2)]]
) {
    const int2 texel_2 = int2(texel);
    const int2 place_texture_size = texture_size(picture, 0);
    const float2 place = (2.0f * float2(texel_2) + 1.0f) / float2(place_texture_size) - 1.0f;
    const float light = 1.0f - draw.strength * dot(place, place);
    dark.write(
        float4(
            picture.read(uint2(clamp(texel_2, int2(0), place_texture_size - 1)), uint(0)).xyz * light, light
        ),
        uint2(texel_2)
    );
    light_.write(float4(light, 0.0f, 0.0f, 1.0f), uint2(texel_2));
}
