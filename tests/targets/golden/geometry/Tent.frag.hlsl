// Tent: fragment shader, by Burnish.
// A roof over each triangle, walls around it, and a flag on every third one.

struct FragmentInput {
    [[vk::location(0)]] float2 uv : TEXCOORD0;
    [[vk::location(1)]] nointerpolation int part : TEXCOORD1;
};

float4 main(FragmentInput input) : SV_Target0 {
    float3 color = float3(input.uv, float(input.part));
    return float4(color, 1.0);
}
