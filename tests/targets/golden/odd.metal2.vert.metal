// Never compiled by Apple's compiler: only type-checked by clang.
// Compile it without fast maths (-fno-fast-math), which would do away with infinities.
#include <metal_stdlib>
using namespace metal;
// Odd: vertex shader, by Burnish.

struct VertexOutput {
    uint id [[user(location0), flat]];
    float4 clip_position [[position]];
};

vertex VertexOutput vs_main(uint vertex_index [[vertex_id]], uint instance_index [[instance_id]]) {
    VertexOutput output;
    output.id = instance_index + 7u;
    output.clip_position = float4(float(vertex_index), -0.5f, 1e-7f, 1.0f);
    return output;
}
