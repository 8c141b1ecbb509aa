// Plastic: functions, by Burnish.
// Plastic after the classic three-term model.

struct ShopFloorSurface {
    float3 tint;
    float3 normal;
};

struct ShopFloorVertices {
    float3 object_position;
    float3 object_normal;
};

/// base: Base colour
/// albedo: Multiplies the base colour
ShopFloorSurface shop_floor_surface(
    float2 uv, float3 normal, float3 base, Texture2D<float4> albedo, SamplerState albedo_sampler
) {
    ShopFloorSurface result;
    result.tint = base * albedo.Sample(albedo_sampler, uv).xyz;
    result.normal = normal * rsqrt(max(dot(normal, normal), 1.1754944e-38));
    return result;
}

/// object_position: Before `object_to_world`
ShopFloorVertices shop_floor_vertices(float3 vertex_position, float3 vertex_normal) {
    ShopFloorVertices result;
    result.object_position = vertex_position;
    result.object_normal = vertex_normal;
    return result;
}
