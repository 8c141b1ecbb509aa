// ObjectSpaceBumps: functions, by Burnish.
// Normals of the model's own space, so no tangents are needed.

fn object_space_bumps_normal(
    uv: vec2f, object_to_world: mat4x4f, bumps: texture_2d<f32>, bumps_sampler: sampler
) -> vec3f {
    let normal_determinant = determinant(
        mat3x3f(object_to_world[0].xyz, object_to_world[1].xyz, object_to_world[2].xyz)
    );
    // Normals stay upright under any scale by the inverse transpose. Their length changes.
    let normal_upright = mat3x3f(
            cross(object_to_world[1].xyz, object_to_world[2].xyz),
            cross(object_to_world[2].xyz, object_to_world[0].xyz),
            cross(object_to_world[0].xyz, object_to_world[1].xyz)
        )
        * select(0.0, 1.0 / normal_determinant, abs(normal_determinant) >= 1.1754944e-38)
        * (2.0 * textureSample(bumps, bumps_sampler, uv).xyz - 1.0);
    return normal_upright * inverseSqrt(max(dot(normal_upright, normal_upright), 1.1754944e-38));
}
