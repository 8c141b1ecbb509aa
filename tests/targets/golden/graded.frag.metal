// Never compiled by Apple's compiler: only type-checked by clang.
// Compile it without fast maths (-fno-fast-math), which would do away with infinities.
#include <metal_stdlib>
using namespace metal;
// Graded: fragment shader, by Burnish.
// Colours that an affine transform corrects, seen along a plane.

struct Draw {
    float4x4 object_to_world;
    float4x4 grade;
    float2x4 tilt;
};

struct FragmentInput {
    float3 normal [[user(location0)]];
    float2 uv [[user(location1)]];
};

struct FragmentOutput {
    float4 color [[color(0)]];
};

fragment FragmentOutput fs_main(FragmentInput input [[stage_in]], constant Draw& draw [[buffer(8)]]) {
    // Zero stays zero.
    const float3 normal = input.normal * precise::rsqrt(max(dot(input.normal, input.normal), 1.1754944e-38f));
    const float3 graded = (draw.grade * float4(normal, 1.0f)).xyz;
    const float3x2 own = float3x2(input.uv, input.uv.yx, float2(1.0f, input.uv.x));
    const float2 slope = transpose(float2x3(draw.tilt[0].xyz, draw.tilt[1].xyz)) * graded
        + (own * float4x3(draw.grade[0].xyz, draw.grade[1].xyz, draw.grade[2].xyz, draw.grade[3].xyz))[3];
    const float3 color = graded + (draw.tilt * slope).xyz;
    FragmentOutput output;
    output.color = float4(color, 1.0f);
    return output;
}
