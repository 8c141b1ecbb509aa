// Plastic: functions, by Burnish.
// Plastic after the classic three-term model.

struct ShopFloorSurface {
    tint: vec3f,
    normal: vec3f,
}

struct ShopFloorVertices {
    object_position: vec3f,
    object_normal: vec3f,
}

/// base: Base colour
/// albedo: Multiplies the base colour
fn shop_floor_surface(
    uv: vec2f, normal: vec3f, base: vec3f, albedo: texture_2d<f32>, albedo_sampler: sampler
) -> ShopFloorSurface {
    var result: ShopFloorSurface;
    result.tint = base * textureSample(albedo, albedo_sampler, uv).xyz;
    result.normal = normal * inverseSqrt(max(dot(normal, normal), 1.1754944e-38));
    return result;
}

/// object_position: Before `object_to_world`
fn shop_floor_vertices(vertex_position: vec3f, vertex_normal: vec3f) -> ShopFloorVertices {
    var result: ShopFloorVertices;
    result.object_position = vertex_position;
    result.object_normal = vertex_normal;
    return result;
}
