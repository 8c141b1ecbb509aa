// Odd: vertex and fragment shaders, by Burnish.

cbuffer Material : register(b0, space2) {
    float threshold;
    uint texture_;
    float pad_0;
    float pad_1;
    float4 turn[3];
};

struct VertexInput {
    uint vertex_index : SV_VertexID;
    uint instance_index : SV_InstanceID;
};

struct VertexOutput {
    [[vk::location(0)]] nointerpolation uint id : TEXCOORD0;
    float4 clip_position : SV_Position;
};

VertexOutput vs_main(VertexInput input) {
    VertexOutput output;
    output.id = input.instance_index + 7u;
    output.clip_position = float4(float(input.vertex_index), -0.5, 1e-7, 1.0);
    return output;
}

struct FragmentInput {
    [[vk::location(0)]] nointerpolation uint id : TEXCOORD0;
    float4 frag_coord : SV_Position;
    bool front_facing : SV_IsFrontFace;
};

struct FragmentOutput {
    [[vk::location(0)]] float4 color : SV_Target0;
    [[vk::location(1)]] float2 motion : SV_Target1;
};

FragmentOutput fs_main(FragmentInput input) {
    float3x3 turn_ = transpose(float3x3(turn[0].xyz, turn[1].xyz, turn[2].xyz));
    float3 turned = mul(turn_, float4(input.frag_coord.xyz, 1.0 / input.frag_coord.w).xyz);
    float3 result;
    if (input.front_facing) {
        float inner;
        if (texture_ == 4294967295u && (input.front_facing || texture_ == 4294967295u)) {
            inner = turned.x;
        } else {
            inner = float(-2147483647 - 1) * 0.1;
        }
        result = inner.xxx;
    } else {
        float3 column = transpose(turn_)[1];
        result = column;
    }
    float3 final = pow(clamp(result, 0.0, threshold), 2.0);
    FragmentOutput output;
    output.color = float4(mul(-turn_, final), float(input.id));
    output.motion = float2(0.25, 0.25);
    if (turned.x < threshold) {
        discard;
    }
    return output;
}
