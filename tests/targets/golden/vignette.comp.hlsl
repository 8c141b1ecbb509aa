// Vignette: compute shader, by Burnish.
// Darkens the corners of a picture.

cbuffer Draw : register(b0, space3) {
    float strength;
};

[[vk::image_format("rgba16f")]] [[spv::format_rgba16f]]
RWTexture2D<float4> dark : register(u2, space3);
[[vk::image_format("r32f")]] [[spv::format_r32f]]
RWTexture2D<float4> light_ : register(u3, space3);
Texture2D<float4> picture : register(t4, space3);

int2 texture_size(Texture2D<float4> texels, int level) {
    uint width, height, levels;
    texels.GetDimensions(level, width, height, levels);
    return int2(width, height);
}

struct ComputeInput {
    uint2 texel : SV_DispatchThreadID;
};

[numthreads(8, 8, 1)]
void main(ComputeInput input) {
    int2 texel = int2(input.texel);
    int2 place_texture_size = texture_size(picture, 0);
    float2 place = (2.0 * float2(texel) + 1.0) / float2(place_texture_size) - 1.0;
    float light = 1.0 - strength * dot(place, place);
    dark[texel] = float4(
        picture.Load(int3(clamp(texel, int2(0, 0), place_texture_size - 1), 0)).xyz * light, light
    );
    light_[texel] = float4(light, 0.0, 0.0, 1.0);
}
