// ObjectSpaceBumps: functions, by Burnish.
// Normals of the model's own space, so no tangents are needed.

float3 object_space_bumps_normal(
    float2 uv, float4x4 object_to_world, Texture2D<float4> bumps, SamplerState bumps_sampler
) {
    float normal_determinant = determinant(
        transpose(
            float3x3(
                transpose(object_to_world)[0].xyz, transpose(object_to_world)[1].xyz,
                transpose(object_to_world)[2].xyz
            )
        )
    );
    // Normals stay upright under any scale by the inverse transpose. Their length changes.
    float3 normal_upright = mul(
        mul(
            transpose(
                float3x3(
                    cross(transpose(object_to_world)[1].xyz, transpose(object_to_world)[2].xyz),
                    cross(transpose(object_to_world)[2].xyz, transpose(object_to_world)[0].xyz),
                    cross(transpose(object_to_world)[0].xyz, transpose(object_to_world)[1].xyz)
                )
            ),
            abs(normal_determinant) >= 1.1754944e-38 ? 1.0 / normal_determinant : 0.0
        ),
        2.0 * bumps.Sample(bumps_sampler, uv).xyz - 1.0
    );
    return normal_upright * rsqrt(max(dot(normal_upright, normal_upright), 1.1754944e-38));
}
