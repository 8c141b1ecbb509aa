// Odd: vertex shader, by Burnish.

struct VertexInput {
    uint vertex_index : SV_VertexID;
    uint instance_index : SV_InstanceID;
};

struct VertexOutput {
    [[vk::location(0)]] nointerpolation uint id : TEXCOORD0;
    float4 clip_position : SV_Position;
};

VertexOutput main(VertexInput input) {
    VertexOutput output;
    output.id = input.instance_index + 7u;
    output.clip_position = float4(float(input.vertex_index), -0.5, 1e-7, 1.0);
    return output;
}
