// Tent: geometry shader, by Burnish.
// A roof over each triangle, walls around it, and a flag on every third one.

cbuffer View : register(b1, space0) {
    column_major float4x4 view_projection;  /// World to clip space
    float3 eye;  /// Where the viewer stands
};

cbuffer Material : register(b0, space2) {
    int walls;
    float wind;
};

struct GeometryInput {
    [[vk::location(0)]] float3 shift : TEXCOORD0;
    [[vk::location(1)]] float3 position : TEXCOORD1;
    [[vk::location(2)]] float3 normal : TEXCOORD2;
    [[vk::location(3)]] float2 uv_2 : TEXCOORD3;
};

struct GeometryOutput {
    [[vk::location(0)]] float2 uv : TEXCOORD0;
    [[vk::location(1)]] nointerpolation int part : TEXCOORD1;
    float4 clip_position : SV_Position;
};

[maxvertexcount(18)]
void main(
    triangle GeometryInput input[3], uint primitive_index : SV_PrimitiveID,
    inout TriangleStream<GeometryOutput> stream
) {
    GeometryOutput output;
    for (int i = 0; i < 3; i++) {
        float3 position = input[i].position + input[i].normal + input[0].shift;
        output.clip_position = mul(view_projection, float4(position, 1.0));
        output.uv = input[i].uv_2;
        output.part = 0;
        stream.Append(output);
    }
    stream.RestartStrip();
    for (int wall = 0; wall < min(walls, 3); wall++) {
        for (int i_ = 0; i_ < 4; i_++) {
            int uv_remainder = (wall + i_ % 2) % 3;
            float3 position = input[uv_remainder].position + float(i_ / 2) * input[uv_remainder].normal;
            output.clip_position = mul(view_projection, float4(position, 1.0));
            output.uv = input[uv_remainder].uv_2;
            output.part = 1;
            stream.Append(output);
        }
        stream.RestartStrip();
    }
    if (primitive_index % 3u == 0u) {
        for (int i_ = 0; i_ < 3; i_++) {
            float3 position = input[0].position + wind * float3(float(i_ % 2), float(i_), 0.0);
            output.clip_position = mul(view_projection, float4(position, 1.0));
            output.uv = input[i_].uv_2;
            output.part = 2;
            stream.Append(output);
        }
        stream.RestartStrip();
    }
}
