// Vignette: compute shader, by Burnish.
// Darkens the corners of a picture.

struct Draw {
    strength: f32,
}

@group(3) @binding(0) var<uniform> draw: Draw;
@group(3) @binding(2) var dark: texture_storage_2d<rgba16float, write>;
@group(3) @binding(3) var light_: texture_storage_2d<r32float, write>;
@group(3) @binding(4) var picture: texture_2d<f32>;

struct ComputeInput {
    @builtin(global_invocation_id) texel: vec3u,
}

@compute @workgroup_size(8, 8)
fn main(input: ComputeInput) {
    let texel = vec2i(input.texel.xy);
    let place_texture_size = vec2i(textureDimensions(picture, 0));
    let place = (2.0 * vec2f(texel) + 1.0) / vec2f(place_texture_size) - 1.0;
    let light = 1.0 - draw.strength * dot(place, place);
    textureStore(
        dark, texel,
        vec4f(textureLoad(picture, clamp(texel, vec2i(0), place_texture_size - 1), 0).xyz * light, light)
    );
    textureStore(light_, texel, vec4f(light, 0.0, 0.0, 1.0));
}
