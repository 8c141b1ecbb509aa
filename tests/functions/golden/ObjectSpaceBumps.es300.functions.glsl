// ObjectSpaceBumps: functions, by Burnish.
// Normals of the model's own space, so no tangents are needed.

vec3 object_space_bumps_normal(vec2 uv, mat4 object_to_world, sampler2D bumps) {
    float normal_determinant = determinant(
        mat3(object_to_world[0].xyz, object_to_world[1].xyz, object_to_world[2].xyz)
    );
    // Normals stay upright under any scale by the inverse transpose. Their length changes.
    vec3 normal_upright = mat3(
            cross(object_to_world[1].xyz, object_to_world[2].xyz),
            cross(object_to_world[2].xyz, object_to_world[0].xyz),
            cross(object_to_world[0].xyz, object_to_world[1].xyz)
        )
        * (abs(normal_determinant) >= 1.1754944e-38 ? 1.0 / normal_determinant : 0.0)
        * (2.0 * texture(bumps, uv).xyz - 1.0);
    return normal_upright * inversesqrt(max(dot(normal_upright, normal_upright), 1.1754944e-38));
}
