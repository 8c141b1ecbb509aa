// Toy: fragment shader, by Burnish.

struct FragmentInput {
    [[vk::location(0)]] float4 varying : TEXCOORD0;
};

float4 main(FragmentInput input) : SV_Target0 {
    return input.varying;
}
