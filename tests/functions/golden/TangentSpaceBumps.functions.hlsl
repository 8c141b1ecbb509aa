// TangentSpaceBumps: functions, by Burnish.
// Normals around the surface's own, so one map fits every model that has tangents.

/// Zero stays zero.
float3 tangent_space_bumps_safe_normalize(float3 v) {
    return v * rsqrt(max(dot(v, v), 1.1754944e-38));
}

/// vertex_tangent: `w` is the sign of the bitangent
float3 tangent_space_bumps_normal(
    float2 uv, float3 normal, float4 vertex_tangent, float4x4 object_to_world, Texture2D<float4> bumps,
    SamplerState bumps_sampler
) {
    float3 along_u = mul(object_to_world, float4(vertex_tangent.xyz, 0.0)).xyz;
    float3 inherited_normal = tangent_space_bumps_safe_normalize(normal);
    float3 along_v = cross(inherited_normal, along_u) * vertex_tangent.w;
    float3 bump = 2.0 * bumps.Sample(bumps_sampler, uv).xyz - 1.0;
    return tangent_space_bumps_safe_normalize(mul(bump, float3x3(along_u, along_v, inherited_normal)));
}

float3 tangent_space_bumps_upright(float3 normal) {
    return tangent_space_bumps_safe_normalize(normal);
}

/// vertex_tangent: `w` is the sign of the bitangent
float3 tangent_space_bumps_along_u(float4 vertex_tangent, float4x4 object_to_world) {
    return mul(object_to_world, float4(vertex_tangent.xyz, 0.0)).xyz;
}

/// vertex_tangent: `w` is the sign of the bitangent
float3 tangent_space_bumps_along_v(float3 normal, float4 vertex_tangent, float4x4 object_to_world) {
    float3 along_u = mul(object_to_world, float4(vertex_tangent.xyz, 0.0)).xyz;
    return cross(tangent_space_bumps_safe_normalize(normal), along_u) * vertex_tangent.w;
}

/// vertex_tangent: `w` is the sign of the bitangent
float3x3 tangent_space_bumps_tangent_to_world(
    float3 normal, float4 vertex_tangent, float4x4 object_to_world
) {
    float3 along_u = mul(object_to_world, float4(vertex_tangent.xyz, 0.0)).xyz;
    float3 inherited_normal = tangent_space_bumps_safe_normalize(normal);
    float3 along_v = cross(inherited_normal, along_u) * vertex_tangent.w;
    return transpose(float3x3(along_u, along_v, inherited_normal));
}

float3 tangent_space_bumps_bump(float2 uv, Texture2D<float4> bumps, SamplerState bumps_sampler) {
    return 2.0 * bumps.Sample(bumps_sampler, uv).xyz - 1.0;
}
