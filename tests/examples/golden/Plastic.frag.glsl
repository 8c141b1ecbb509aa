#version 450
// Plastic: fragment shader, by Burnish.
// Plastic after the classic three-term model.

struct Point {
    vec3 diffuse_color;
    float pad_0;
    vec3 specular_color;
    float pad_1;
    vec3 place;
    float pad_2;
};

layout(std140, set = 0, binding = 1) uniform View {
    mat4 view_projection;  /// World to clip space
    vec3 eye;  /// Where the viewer stands
};

layout(std140, set = 1, binding = 0) uniform Rig {
    vec3 ambient_light;  /// Light from everywhere
    vec3 sun_diffuse_color;
    vec3 sun_specular_color;
    vec3 sun_direction;  /// Where the light travels
    float rig_pad_0;
    Point lamps[8];
    int lamps_count;  /// The number of `lamps` that shine
    float rig_pad_1;
    float rig_pad_2;
    float rig_pad_3;
    vec3 torch_diffuse_color;
    vec3 torch_specular_color;
    vec3 torch_place;  /// On no surface that is drawn
    vec3 torch_axis;  /// Where the light travels
    float torch_inner;
    float torch_outer;
};

layout(std140, set = 2, binding = 4) uniform DerivedFromRig {
    float torch_falloff_cos;
    float torch_falloff_inverse_width;
};

layout(std140, set = 2, binding = 0) uniform Material {
    vec3 base;  /// Base colour
    vec3 shine;  /// Highlight colour
    float power;  /// Specular exponent
};

layout(set = 2, binding = 5) uniform texture2D albedo;
layout(set = 2, binding = 6) uniform sampler albedo_sampler;

layout(location = 0) in vec3 v_position;
layout(location = 1) in vec3 v_normal;
layout(location = 2) in vec2 v_uv;

layout(location = 0) out vec4 out_color;

vec3 lambert_phong(vec3 to_light, vec3 diffuse, vec3 specular, vec3 normal, vec3 tint, vec3 to_eye) {
    float normal_dot_to_light = dot(normal, to_light);
    vec3 phong = shine * (
        normal_dot_to_light > 0.0 ? pow(clamp(dot(reflect(-to_light, normal), to_eye), 0.0, 1.0), power) : 0.0
    ) * specular;
    return tint * clamp(normal_dot_to_light, 0.0, 1.0) * diffuse + phong;
}

void main() {
    vec3 tint = base * texture(sampler2D(albedo, albedo_sampler), v_uv).xyz;
    // Zero stays zero.
    vec3 normal = v_normal * inversesqrt(max(dot(v_normal, v_normal), 1.1754944e-38));
    vec3 to_eye = normalize(eye - v_position);
    vec3 color_total = vec3(0.0);
    for (int i = 0; i < min(lamps_count, 8); i++) {
        vec3 lamps_to_light = normalize(lamps[i].place - v_position);
        color_total += lambert_phong(
            lamps_to_light, lamps[i].diffuse_color, lamps[i].specular_color, normal, tint, to_eye
        );
    }
    vec3 torch_to_light = normalize(torch_place - v_position);
    float torch_falloff = smoothstep(
        0.0, 1.0, (dot(torch_axis, -torch_to_light) - torch_falloff_cos) * torch_falloff_inverse_width
    );
    vec3 color = tint * ambient_light
        + lambert_phong(-sun_direction, sun_diffuse_color, sun_specular_color, normal, tint, to_eye)
        + color_total
        + lambert_phong(
            torch_to_light, torch_diffuse_color * torch_falloff, torch_specular_color * torch_falloff, normal,
            tint, to_eye
        );
    out_color = vec4(color, 1.0);
}
