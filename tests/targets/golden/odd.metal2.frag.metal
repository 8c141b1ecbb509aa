// Never compiled by Apple's compiler: only type-checked by clang.
// Compile it without fast maths (-fno-fast-math), which would do away with infinities.
#include <metal_stdlib>
using namespace metal;
// Odd: fragment shader, by Burnish.

struct Material {
    float threshold;
    uint texture;
    float pad_0;
    float pad_1;
    array<float4, 3> turn;
};

struct FragmentInput {
    uint id [[user(location0), flat]];
};

struct FragmentOutput {
    float4 color [[color(0)]];
    float2 motion [[color(1)]];
};

fragment FragmentOutput fs_main(
    FragmentInput input [[stage_in]], float4 frag_coord [[position]], bool front_facing [[front_facing]],
    constant Material& material [[buffer(3)]]
) {
    const float3x3 turn = float3x3(material.turn[0].xyz, material.turn[1].xyz, material.turn[2].xyz);
    const float3 turned = turn * frag_coord.xyz;
    float3 result;
    if (front_facing) {
        float inner;
        if (material.texture == 4294967295u && (front_facing || material.texture == 4294967295u)) {
            inner = turned.x;
        } else {
            inner = float(-2147483647 - 1) * 0.1f;
        }
        result = float3(inner);
    } else {
        const float3 column = turn[1];
        result = column;
    }
    const float3 final_ = precise::pow(clamp(result, float3(0.0f), float3(material.threshold)), float3(2.0f));
    FragmentOutput output;
    output.color = float4((-1.0f * turn) * final_, float(input.id));
    output.motion = float2(0.25f);
    if (turned.x < material.threshold) {
        discard_fragment();
    }
    return output;
}
