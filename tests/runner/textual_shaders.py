"""Small shaders, each in GLSL and in WGSL, with a bar between their stages.

GLSL is written without the first lines, in which its dialects differ. Positions are in Direct3D's
clip space.
"""

from __future__ import annotations

PAINT_GLSL = """in vec3 place;
in vec4 paint;
out vec4 color;
void main() {
    color = paint;
    gl_Position = vec4(place.xy, 2.0 * place.z - 1.0, 1.0);
}
|in vec4 color;
layout(location = 0) out vec4 target;
void main() { target = color; }
"""
PAINT_WGSL = """struct Between { @location(0) color: vec4f, @builtin(position) place: vec4f }
@vertex fn main(@location(0) place: vec3f, @location(1) paint: vec4f) -> Between {
    return Between(paint, vec4f(place, 1.0));
}
|@fragment fn main(@location(0) color: vec4f) -> @location(0) vec4f { return color; }
"""

FLAT_GLSL = PAINT_GLSL.replace("out vec4 color", "flat out vec4 color").replace(
    "|in vec4 color", "|flat in vec4 color"
)
FLAT_WGSL = PAINT_WGSL.replace("@location(0) color", "@location(0) @interpolate(flat, first) color")

NUMBERS_GLSL = """in vec3 place;
in ivec3 paint;
flat out ivec3 number;
void main() { number = paint; gl_Position = vec4(place, 1.0); }
|flat in ivec3 number;
layout(std140) uniform Numbers { ivec2 add; uint shift; uint wide[3]; };
layout(location = 0) out vec4 target;
void main() { target = vec4(number + ivec3(add, int(shift >> 30)), float(wide[2])); }
"""
NUMBERS_WGSL = """struct Between {
    @location(0) @interpolate(flat) number: vec3i, @builtin(position) place: vec4f
}
@vertex fn main(@location(0) place: vec3f, @location(1) paint: vec3i) -> Between {
    return Between(paint, vec4f(place, 1.0));
}
|struct Numbers { add: vec2i, shift: u32, @align(16) wide: array<vec4u, 3> }
@group(2) @binding(5) var<uniform> numbers: Numbers;
@fragment fn main(@location(0) @interpolate(flat) number: vec3i) -> @location(0) vec4f {
    let sum = number + vec3i(numbers.add, i32(numbers.shift >> 30));
    return vec4f(vec3f(sum), f32(numbers.wide[2].x));
}
"""

TEXTURED_GLSL = PAINT_GLSL.replace("target = color", "target = texture(image, color.xy)").replace(
    "|", "|uniform sampler2D image;\n"
)
TEXTURED_WGSL = PAINT_WGSL.replace(
    "return color", "return textureSample(image, reader, color.xy)"
).replace(
    "|",
    """|@group(0) @binding(0) var image: texture_2d<f32>;
@group(0) @binding(1) var reader: sampler;
""",
)

TWO_GLSL = PAINT_GLSL.replace(
    "void main() { target = color; }",
    "layout(location = 1) out vec2 other; void main() { target = color; other = color.zw; }",
)
TWO_WGSL = (
    PAINT_WGSL.split("|", maxsplit=1)[0]
    + """|struct Targets { @location(0) whole: vec4f, @location(1) half: vec2f }
@fragment fn main(@location(0) color: vec4f) -> Targets { return Targets(color, color.zw); }
"""
)
