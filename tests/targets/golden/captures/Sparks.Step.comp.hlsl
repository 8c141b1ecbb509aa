// Sparks: compute shader, by Burnish.
// Every spark that is young enough becomes two.

struct MeshPrimitive {
    float3 corner0_vertex_position;
    float corner0_age;
};

cbuffer Material : register(b0, space2) {
    float3 wind;
};

cbuffer Draw : register(b0, space3) {
    column_major float4x4 object_to_world;
    int mesh_count;  /// The number of elements of `mesh`
};

StructuredBuffer<MeshPrimitive> mesh : register(t2, space3);
RWStructuredBuffer<uint> captured : register(u3, space3);

struct ComputeInput {
    uint index : SV_DispatchThreadID;
};

[numthreads(64, 1, 1)]
void main(ComputeInput input) {
    int index = int(input.index);
    if (index >= mesh_count * 2) { return; }
    int primitive = index / 2;
    float3 position = mul(object_to_world, float4(mesh[primitive].corner0_vertex_position, 1.0)).xyz;
    int emitted_vertex = asint(asuint(index % 2));
    float3 position_ = position + wind * float(emitted_vertex);
    float older = mesh[primitive].corner0_age + 0.1;
    captured[index * 6] = asuint(position_.x);
    captured[index * 6 + 1] = asuint(position_.y);
    captured[index * 6 + 2] = asuint(position_.z);
    captured[index * 6 + 3] = asuint(0.5 * older);
    captured[index * 6 + 4] = asuint(primitive);
    captured[index * 6 + 5] = older < 1.0 ? 1u : 0u;
}
