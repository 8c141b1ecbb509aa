// Graded: fragment shader, by Burnish.
// Colours that an affine transform corrects, seen along a plane.

cbuffer Draw : register(b0, space3) {
    column_major float4x4 object_to_world;
    column_major float4x4 grade;
    column_major float4x2 tilt;
};

struct FragmentInput {
    [[vk::location(0)]] float3 normal : TEXCOORD0;
    [[vk::location(1)]] float2 uv : TEXCOORD1;
};

float2x4 product(float2x3 m, float3x4 n) {
    return transpose(
        float4x2(
            mul(m, transpose(n)[0]), mul(m, transpose(n)[1]), mul(m, transpose(n)[2]), mul(m, transpose(n)[3])
        )
    );
}

float4 main(FragmentInput input) : SV_Target0 {
    // Zero stays zero.
    float3 normal = input.normal * rsqrt(max(dot(input.normal, input.normal), 1.1754944e-38));
    float3 graded = mul(grade, float4(normal, 1.0)).xyz;
    float2x3 own = transpose(float3x2(input.uv, input.uv.yx, float2(1.0, input.uv.x)));
    float2 slope = mul(transpose(transpose(float2x3(transpose(tilt)[0].xyz, transpose(tilt)[1].xyz))), graded)
        + transpose(
            product(
                own,
                transpose(
                    float4x3(
                        transpose(grade)[0].xyz, transpose(grade)[1].xyz, transpose(grade)[2].xyz,
                        transpose(grade)[3].xyz
                    )
                )
            )
        )[3];
    float3 color = graded + mul(tilt, slope).xyz;
    return float4(color, 1.0);
}
