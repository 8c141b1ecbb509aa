// Plastic, for Bevy 0.19: by Burnish.
// Plastic after the classic three-term model.

#import bevy_pbr::{
    decal::clustered,
    pbr_fragment,
    pbr_functions,
    pbr_types,
}
#ifdef PREPASS_PIPELINE
#import bevy_pbr::{
    prepass_io::{VertexOutput, FragmentOutput},
    pbr_deferred_functions,
    pbr_prepass_functions,
}
#else
#import bevy_pbr::forward_io::{VertexOutput, FragmentOutput}
#endif

struct PlasticParameters {
    base: vec3<f32>,
}

@group(#{MATERIAL_BIND_GROUP}) @binding(100) var<uniform> parameters: PlasticParameters;
@group(#{MATERIAL_BIND_GROUP}) @binding(101) var albedo: texture_2d<f32>;
@group(#{MATERIAL_BIND_GROUP}) @binding(102) var albedo_sampler: sampler;

/// base: Base colour
/// albedo: Multiplies the base colour
fn plastic_tint(uv: vec2f, base: vec3f, albedo: texture_2d<f32>, albedo_sampler: sampler) -> vec3f {
    return base * textureSample(albedo, albedo_sampler, uv).xyz;
}

@fragment
fn fragment(pixel: VertexOutput, @builtin(front_facing) front_facing: bool) -> FragmentOutput {
#ifdef VISIBILITY_RANGE_DITHER
    pbr_functions::visibility_range_dither(pixel.position, pixel.visibility_range_dither);
#endif
    var pbr_input = pbr_fragment::pbr_input_from_standard_material(pixel, front_facing);
    pbr_input.material.base_color = vec4<f32>(
        plastic_tint(pixel.uv, parameters.base, albedo, albedo_sampler), pbr_input.material.base_color.a
    );
    pbr_input.material.base_color = pbr_functions::alpha_discard(
        pbr_input.material, pbr_input.material.base_color
    );
    clustered::apply_decals(&pbr_input);
#ifdef PREPASS_PIPELINE
    return pbr_deferred_functions::deferred_output(pixel, pbr_input);
#else
    var out: FragmentOutput;
    out.color = pbr_input.material.base_color;
    if (pbr_input.material.flags & pbr_types::STANDARD_MATERIAL_FLAGS_UNLIT_BIT) == 0u {
        out.color = pbr_functions::apply_pbr_lighting(pbr_input);
    }
    out.color = pbr_functions::main_pass_post_lighting_processing(pbr_input, out.color);
    return out;
#endif
}
