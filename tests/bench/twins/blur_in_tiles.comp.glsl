#version 450
#extension GL_EXT_samplerless_texture_functions : require
// The kernel of `tests/bench/tiles.py` as somebody writes it by hand who wants the texels of a work
// group to be read only once: they are staged through its memory.

layout(rgba16f, set = 3, binding = 0) writeonly uniform image2D blurred;
layout(set = 3, binding = 1) uniform texture2D source;

const int REACH = 15;
const int WIDTH = 64;
layout(local_size_x = WIDTH, local_size_y = 1) in;

shared vec4 tile[WIDTH + 2 * REACH];

const float WEIGHTS[31] = float[31](@WEIGHTS@);

void main() {
    ivec2 texel = ivec2(gl_GlobalInvocationID.xy);
    ivec2 last = textureSize(source, 0) - 1;
    int own = int(gl_LocalInvocationID.x);
    int begin = int(gl_WorkGroupID.x) * WIDTH - REACH;
    for (int i = own; i < WIDTH + 2 * REACH; i += WIDTH) {
        tile[i] = texelFetch(source, clamp(ivec2(begin + i, texel.y), ivec2(0), last), 0);
    }
    barrier();
    vec4 sum = vec4(0.0);
    for (int i = 0; i < 31; i++) {
        sum += WEIGHTS[i] * tile[own + i];
    }
    imageStore(blurred, texel, sum);
}
