// Shared: fragment shader, by Burnish.
// Fins on some triangles, and some more on all.

float4 main() : SV_Target0 {
    return float4(0.8, 0.8, 0.8, 1.0);
}
