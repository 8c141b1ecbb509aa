// Plastic: functions, by Burnish.
// Plastic after the classic three-term model.

/// base: Base colour
/// albedo: Multiplies the base colour
vec3 plastic_tint(vec2 uv, vec3 base, sampler2D albedo) {
    return base * texture(albedo, uv).xyz;
}
