// ObjectSpaceBumps: functions, by Burnish.
// Normals of the model's own space, so no tangents are needed.

float3 object_space_bumps_normal(
    float2 uv, float4x4 object_to_world, texture2d<float> bumps, sampler bumps_sampler
) {
    const float normal_determinant = determinant(
        float3x3(object_to_world[0].xyz, object_to_world[1].xyz, object_to_world[2].xyz)
    );
    // Normals stay upright under any scale by the inverse transpose. Their length changes.
    const float3 normal_upright = float3x3(
            cross(object_to_world[1].xyz, object_to_world[2].xyz),
            cross(object_to_world[2].xyz, object_to_world[0].xyz),
            cross(object_to_world[0].xyz, object_to_world[1].xyz)
        )
        * (abs(normal_determinant) >= 1.1754944e-38f ? 1.0f / normal_determinant : 0.0f)
        * (2.0f * bumps.sample(bumps_sampler, uv).xyz - 1.0f);
    return normal_upright * precise::rsqrt(max(dot(normal_upright, normal_upright), 1.1754944e-38f));
}
