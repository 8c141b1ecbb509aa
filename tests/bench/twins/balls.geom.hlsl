cbuffer View : register(b0, space0) {
    column_major float4x4 view_projection;
    float3 eye;
};
cbuffer Material : register(b0, space2) {
    float size;
    uint sprites_step;
};

struct Point {
    [[vk::location(0)]] float4 place_and_v : TEXCOORD0;
};
struct Corner {
    [[vk::location(0)]] float3 square_and_v : TEXCOORD0;
    float4 position : SV_Position;
};

[maxvertexcount(4)]
void main(point Point points[1], uint number : SV_PrimitiveID, inout TriangleStream<Corner> square) {
    if (number % sprites_step != 0u) return;
    float3 place = points[0].place_and_v.xyz;
    float3 ahead = eye - place;
    float3 right = normalize(cross(float3(0.0, 1.0, 0.0), ahead));
    float3 above = normalize(cross(ahead, right));
    for (int i = 0; i < 4; i++) {
        float2 at = 2.0 * float2(float(i % 2), float(i / 2)) - 1.0;
        float2 across = size * at;
        Corner corner;
        corner.position = mul(view_projection, float4(place + right * across.x + above * across.y, 1.0));
        corner.square_and_v = float3(at, points[0].place_and_v.w);
        square.Append(corner);
    }
    square.RestartStrip();
}
