// TangentSpaceBumps: functions, by Burnish.
// Normals around the surface's own, so one map fits every model that has tangents.

/// Zero stays zero.
float3 tangent_space_bumps_safe_normalize(float3 v) {
    return v * precise::rsqrt(max(dot(v, v), 1.1754944e-38f));
}

/// vertex_tangent: `w` is the sign of the bitangent
float3 tangent_space_bumps_normal(
    float2 uv, float3 normal, float4 vertex_tangent, float4x4 object_to_world, texture2d<float> bumps,
    sampler bumps_sampler
) {
    const float3 along_u = (object_to_world * float4(vertex_tangent.xyz, 0.0f)).xyz;
    const float3 inherited_normal = tangent_space_bumps_safe_normalize(normal);
    const float3 along_v = cross(inherited_normal, along_u) * vertex_tangent.w;
    const float3 bump = 2.0f * bumps.sample(bumps_sampler, uv).xyz - 1.0f;
    return tangent_space_bumps_safe_normalize(float3x3(along_u, along_v, inherited_normal) * bump);
}

float3 tangent_space_bumps_upright(float3 normal) {
    return tangent_space_bumps_safe_normalize(normal);
}

/// vertex_tangent: `w` is the sign of the bitangent
float3 tangent_space_bumps_along_u(float4 vertex_tangent, float4x4 object_to_world) {
    return (object_to_world * float4(vertex_tangent.xyz, 0.0f)).xyz;
}

/// vertex_tangent: `w` is the sign of the bitangent
float3 tangent_space_bumps_along_v(float3 normal, float4 vertex_tangent, float4x4 object_to_world) {
    const float3 along_u = (object_to_world * float4(vertex_tangent.xyz, 0.0f)).xyz;
    return cross(tangent_space_bumps_safe_normalize(normal), along_u) * vertex_tangent.w;
}

/// vertex_tangent: `w` is the sign of the bitangent
float3x3 tangent_space_bumps_tangent_to_world(
    float3 normal, float4 vertex_tangent, float4x4 object_to_world
) {
    const float3 along_u = (object_to_world * float4(vertex_tangent.xyz, 0.0f)).xyz;
    const float3 inherited_normal = tangent_space_bumps_safe_normalize(normal);
    const float3 along_v = cross(inherited_normal, along_u) * vertex_tangent.w;
    return float3x3(along_u, along_v, inherited_normal);
}

float3 tangent_space_bumps_bump(float2 uv, texture2d<float> bumps, sampler bumps_sampler) {
    return 2.0f * bumps.sample(bumps_sampler, uv).xyz - 1.0f;
}
