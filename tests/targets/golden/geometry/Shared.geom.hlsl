// Shared: geometry shader, by Burnish.
// Fins on some triangles, and some more on all.

cbuffer View : register(b1, space0) {
    column_major float4x4 view_projection;  /// World to clip space
    float3 eye;  /// Where the viewer stands
};

cbuffer Material : register(b0, space2) {
    int fins;
};

struct GeometryInput {
    [[vk::location(0)]] float3 normal : TEXCOORD0;
    [[vk::location(1)]] float3 position : TEXCOORD1;
};

struct GeometryOutput {
    float4 clip_position : SV_Position;
};

[maxvertexcount(21)]
void main(triangle GeometryInput input[3], inout TriangleStream<GeometryOutput> stream) {
    GeometryOutput output;
    if (dot(input[0].normal, input[1].normal) > 0.0) {
        float3 position_cross = cross(input[0].normal, input[1].normal);
        for (int i = 0; i < 3; i++) {
            output.clip_position = mul(view_projection, float4(input[i].position, 1.0));
            stream.Append(output);
        }
        stream.RestartStrip();
        for (int fin = 0; fin < min(fins, 4); fin++) {
            for (int i_ = 0; i_ < 3; i_++) {
                float3 position = input[i_].position + float(i_ + fin) * position_cross;
                output.clip_position = mul(view_projection, float4(position, 1.0));
                stream.Append(output);
            }
            stream.RestartStrip();
        }
        for (int fin_ = 0; fin_ < 2; fin_++) {
            for (int i_ = 0; i_ < 3; i_++) {
                float3 position = input[i_].position - float(i_ + fin_) * position_cross;
                output.clip_position = mul(view_projection, float4(position, 1.0));
                stream.Append(output);
            }
            stream.RestartStrip();
        }
    }
}
