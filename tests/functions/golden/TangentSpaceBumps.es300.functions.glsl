// TangentSpaceBumps: functions, by Burnish.
// Normals around the surface's own, so one map fits every model that has tangents.

/// Zero stays zero.
vec3 tangent_space_bumps_safe_normalize(vec3 v) {
    return v * inversesqrt(max(dot(v, v), 1.1754944e-38));
}

/// vertex_tangent: `w` is the sign of the bitangent
vec3 tangent_space_bumps_normal(
    vec2 uv, vec3 normal, vec4 vertex_tangent, mat4 object_to_world, sampler2D bumps
) {
    vec3 along_u = (object_to_world * vec4(vertex_tangent.xyz, 0.0)).xyz;
    vec3 inherited_normal = tangent_space_bumps_safe_normalize(normal);
    vec3 along_v = cross(inherited_normal, along_u) * vertex_tangent.w;
    vec3 bump = 2.0 * texture(bumps, uv).xyz - 1.0;
    return tangent_space_bumps_safe_normalize(mat3(along_u, along_v, inherited_normal) * bump);
}

vec3 tangent_space_bumps_upright(vec3 normal) {
    return tangent_space_bumps_safe_normalize(normal);
}

/// vertex_tangent: `w` is the sign of the bitangent
vec3 tangent_space_bumps_along_u(vec4 vertex_tangent, mat4 object_to_world) {
    return (object_to_world * vec4(vertex_tangent.xyz, 0.0)).xyz;
}

/// vertex_tangent: `w` is the sign of the bitangent
vec3 tangent_space_bumps_along_v(vec3 normal, vec4 vertex_tangent, mat4 object_to_world) {
    vec3 along_u = (object_to_world * vec4(vertex_tangent.xyz, 0.0)).xyz;
    return cross(tangent_space_bumps_safe_normalize(normal), along_u) * vertex_tangent.w;
}

/// vertex_tangent: `w` is the sign of the bitangent
mat3 tangent_space_bumps_tangent_to_world(vec3 normal, vec4 vertex_tangent, mat4 object_to_world) {
    vec3 along_u = (object_to_world * vec4(vertex_tangent.xyz, 0.0)).xyz;
    vec3 inherited_normal = tangent_space_bumps_safe_normalize(normal);
    vec3 along_v = cross(inherited_normal, along_u) * vertex_tangent.w;
    return mat3(along_u, along_v, inherited_normal);
}

vec3 tangent_space_bumps_bump(vec2 uv, sampler2D bumps) {
    return 2.0 * texture(bumps, uv).xyz - 1.0;
}
