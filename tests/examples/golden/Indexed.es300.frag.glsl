#version 300 es
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp usampler2D;
// Indexed: fragment shader, by Burnish.
// As in the days of 256 colours: texels are numbers, and a second texture says what they stand for.

layout(std140) uniform Material {
    int shift;  /// Turns the palette
};

uniform usampler2D sprite;
uniform sampler2D palette;

in vec2 v_uv;

layout(location = 0) out vec4 out_color;

void main() {
    ivec2 number_texture_size = textureSize(sprite, 0);
    ivec2 place = ivec2(floor(fract(v_uv) * vec2(number_texture_size)));
    int number = int(texelFetch(sprite, clamp(place, ivec2(0), number_texture_size - 1), 0).x) + shift;
    ivec2 found_texture_size = textureSize(palette, 0);
    int found_cut_remainder = number - found_texture_size.x * (number / found_texture_size.x);
    ivec2 found_kept_inside = clamp(
        ivec2(
            found_cut_remainder != 0 && found_cut_remainder < 0
                ? found_cut_remainder + found_texture_size.x
                : found_cut_remainder,
            0
        ),
        ivec2(0), found_texture_size - 1
    );
    out_color = texelFetch(palette, found_kept_inside, 0);
}
