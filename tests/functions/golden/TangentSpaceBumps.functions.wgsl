// TangentSpaceBumps: functions, by Burnish.
// Normals around the surface's own, so one map fits every model that has tangents.

/// Zero stays zero.
fn tangent_space_bumps_safe_normalize(v: vec3f) -> vec3f {
    return v * inverseSqrt(max(dot(v, v), 1.1754944e-38));
}

/// vertex_tangent: `w` is the sign of the bitangent
fn tangent_space_bumps_normal(
    uv: vec2f, normal: vec3f, vertex_tangent: vec4f, object_to_world: mat4x4f, bumps: texture_2d<f32>,
    bumps_sampler: sampler
) -> vec3f {
    let along_u = (object_to_world * vec4f(vertex_tangent.xyz, 0.0)).xyz;
    let inherited_normal = tangent_space_bumps_safe_normalize(normal);
    let along_v = cross(inherited_normal, along_u) * vertex_tangent.w;
    let bump = 2.0 * textureSample(bumps, bumps_sampler, uv).xyz - 1.0;
    return tangent_space_bumps_safe_normalize(mat3x3f(along_u, along_v, inherited_normal) * bump);
}

fn tangent_space_bumps_upright(normal: vec3f) -> vec3f {
    return tangent_space_bumps_safe_normalize(normal);
}

/// vertex_tangent: `w` is the sign of the bitangent
fn tangent_space_bumps_along_u(vertex_tangent: vec4f, object_to_world: mat4x4f) -> vec3f {
    return (object_to_world * vec4f(vertex_tangent.xyz, 0.0)).xyz;
}

/// vertex_tangent: `w` is the sign of the bitangent
fn tangent_space_bumps_along_v(normal: vec3f, vertex_tangent: vec4f, object_to_world: mat4x4f) -> vec3f {
    let along_u = (object_to_world * vec4f(vertex_tangent.xyz, 0.0)).xyz;
    return cross(tangent_space_bumps_safe_normalize(normal), along_u) * vertex_tangent.w;
}

/// vertex_tangent: `w` is the sign of the bitangent
fn tangent_space_bumps_tangent_to_world(
    normal: vec3f, vertex_tangent: vec4f, object_to_world: mat4x4f
) -> mat3x3f {
    let along_u = (object_to_world * vec4f(vertex_tangent.xyz, 0.0)).xyz;
    let inherited_normal = tangent_space_bumps_safe_normalize(normal);
    let along_v = cross(inherited_normal, along_u) * vertex_tangent.w;
    return mat3x3f(along_u, along_v, inherited_normal);
}

fn tangent_space_bumps_bump(uv: vec2f, bumps: texture_2d<f32>, bumps_sampler: sampler) -> vec3f {
    return 2.0 * textureSample(bumps, bumps_sampler, uv).xyz - 1.0;
}
