// Plastic: what a host sets, computes and binds.
// Made by `burnish bind`; do not edit. C++17. A host fills the structures, computes the derived
// ones
// by `derive_…`, and uploads their bytes.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

// A host's own types: define BURNISH_TYPES before this file is included, and these names in the
// namespace burnish, such as `namespace burnish { using vec3 = glm::vec3; }`.
#ifndef BURNISH_TYPES
#define BURNISH_TYPES
namespace burnish {
struct vec2 { float x, y; };
struct vec3 { float x, y, z; };
struct vec4 { float x, y, z, w; };
struct ivec2 { std::int32_t x, y; };
struct ivec3 { std::int32_t x, y, z; };
struct ivec4 { std::int32_t x, y, z, w; };
struct uvec2 { std::uint32_t x, y; };
struct uvec3 { std::uint32_t x, y, z; };
struct uvec4 { std::uint32_t x, y, z, w; };
/// Two columns, of which each has two lanes that nothing reads.
struct mat2x4 {
    vec4 a, b;
    constexpr vec4& operator[](int column) { return column == 0 ? a : b; }
    constexpr const vec4& operator[](int column) const { return column == 0 ? a : b; }
};
/// Three columns, of which each has a lane that nothing reads.
struct mat3x4 {
    vec4 a, b, c;
    constexpr vec4& operator[](int column) { return column == 0 ? a : column == 1 ? b : c; }
    constexpr const vec4& operator[](int column) const {
        return column == 0 ? a : column == 1 ? b : c;
    }
};
/// Four columns.
struct mat4 {
    vec4 a, b, c, d;
    constexpr vec4& operator[](int column) {
        return column == 0 ? a : column == 1 ? b : column == 2 ? c : d;
    }
    constexpr const vec4& operator[](int column) const {
        return column == 0 ? a : column == 1 ? b : column == 2 ? c : d;
    }
};
}  // namespace burnish
#endif

#ifndef BURNISH_TABLES
#define BURNISH_TABLES
namespace burnish {
static_assert(sizeof(vec2) == 8, "burnish::vec2 has to be two floats");
static_assert(sizeof(vec3) == 12, "burnish::vec3 has to be three floats");
static_assert(sizeof(vec4) == 16, "burnish::vec4 has to be four floats");
static_assert(
    sizeof(ivec2) == 8 && sizeof(uvec2) == 8,
    "burnish::ivec2 and uvec2 have to be two numbers of 32 bits"
);
static_assert(
    sizeof(ivec3) == 12 && sizeof(uvec3) == 12,
    "burnish::ivec3 and uvec3 have to be three numbers of 32 bits"
);
static_assert(
    sizeof(ivec4) == 16 && sizeof(uvec4) == 16,
    "burnish::ivec4 and uvec4 have to be four numbers of 32 bits"
);
static_assert(sizeof(mat2x4) == 32, "burnish::mat2x4 has to be two columns of four floats");
static_assert(sizeof(mat3x4) == 48, "burnish::mat3x4 has to be three columns of four floats");
static_assert(sizeof(mat4) == 64, "burnish::mat4 has to be four columns of four floats");

/// The rows of a table.
template <class T>
struct List {
    const T* first = nullptr;
    std::size_t count = 0;
    constexpr List() = default;
    template <std::size_t N>
    constexpr List(const T (&rows)[N]) : first(rows), count(N) {}
    constexpr const T* begin() const { return first; }
    constexpr const T* end() const { return first + count; }
    constexpr std::size_t size() const { return count; }
    constexpr const T& operator[](std::size_t number) const { return first[number]; }
};

enum class Kind : std::uint8_t { uniform, storage, texture, sampler, image, result };

enum class VertexFormat : std::uint8_t {
    none, float32, float32x2, float32x3, float32x4, uint32, uint32x2, uint32x3, uint32x4,
    sint32, sint32x2, sint32x3, sint32x4
};

/// Something that is bound. `set` and `binding` are -1 where a host binds by the identifier.
struct Binding {
    const char* name;
    Kind kind;
    int set, binding;
    unsigned stages;  ///< 1 vertex, 2 fragment, 4 compute, 8 geometry, 16 control, 32 evaluation
    std::size_t size;
    const char* identifier;
};

/// The text of a stage: the name of its file, and the text itself if it is embedded.
struct Text {
    const char *stage, *file, *entry_point, *text;
};

/// What the texts of one profile ask of a host.
struct Profile {
    const char* name;
    List<Binding> bindings;
    List<Text> texts;
    const char *front_face, *clip_depth;
};

struct VertexInput {
    const char* name;
    int location;
    VertexFormat format;
    bool per_instance;
};

/// The state of a sampler, in WebGPU's words.
struct Sampler {
    const char *filter = nullptr, *mip = nullptr, *wrap_u = nullptr, *wrap_v = nullptr;
    const char *wrap_w = nullptr, *border = nullptr, *compare = nullptr;
    int anisotropy = 1;
};

struct Texture {
    const char *name, *dimension, *sample_type;
    const char* intent;   ///< `color`: pictures encoded as sRGB are bound in a format that decodes them
    float texel[4];       ///< what to bind before there is a picture
    const char* sampler_type;
    Sampler sampler;
};

struct Target {
    const char* name;
    int location;
    const char *format, *encoding, *mask;
    const char* blend;    ///< as JSON, in WebGPU's words
};

struct Material {
    const char* name;
    List<const char*> layout_ids;
    List<VertexInput> vertex_inputs;
    List<Texture> textures;
    List<Target> targets;
    const char *topology, *cull;
    int samples;
    const char* depth_compare;
    bool depth_write;
    int depth_bias;
    float depth_slope_bias, depth_bias_clamp;
    bool alpha_to_coverage;
    List<Profile> profiles;
};

/// True if a direction has the length that shaders take for granted.
template <class Vector>
bool has_length_one(const Vector& v) {
    double square = double(v.x) * v.x + double(v.y) * v.y;
    if constexpr (sizeof(Vector) > sizeof(vec2)) square += double(v.z) * v.z;
    return std::abs(std::sqrt(square) - 1.0) <= 1e-3;
}

/// A sentence if the binding of a material is stale: its reflection says where values lie now.
inline const char* stale(const Material& material, std::string_view reflection) {
    std::size_t found = 0;
    for (
        std::size_t at = 0; (
            at = reflection.find("\"layout_id\"", at)
        ) != std::string_view::npos; ++at
    ) ++found;
    if (found != material.layout_ids.size())
        return "the binding is stale: there are other blocks now; run `burnish bind` again";
    for (const char* id : material.layout_ids)
        if (reflection.find(id) == std::string_view::npos)
            return "the binding is stale: a block has another layout; run `burnish bind` again";
    return nullptr;
}
}  // namespace burnish
#endif

namespace burnish::plastic {

struct Point {
    /// Linear.
    vec3 diffuse_color{1.0f, 1.0f, 1.0f};
    std::uint32_t _pad0[1]{};
    /// Linear.
    vec3 specular_color{1.0f, 1.0f, 1.0f};
    std::uint32_t _pad1[1]{};
    /// On no surface that is drawn; no default: has to be set.
    vec3 place{};
    std::uint32_t _pad2[1]{};
};
static_assert(sizeof(Point) == 48 && offsetof(Point, specular_color) == 16);
static_assert(offsetof(Point, place) == 32);

/// Group 0, binding 0; per view. Layout 978849b2805233be.
struct View {
    /// World to clip space.
    mat4 view_projection{
        vec4{1.0f, 0.0f, 0.0f, 0.0f},
        vec4{0.0f, 1.0f, 0.0f, 0.0f},
        vec4{0.0f, 0.0f, 1.0f, 0.0f},
        vec4{0.0f, 0.0f, 0.0f, 1.0f}
    };
    /// Where the viewer stands.
    vec3 eye{0.0f, 0.0f, 5.0f};
    std::uint32_t _pad0[1]{};
};
static_assert(sizeof(View) == 80 && offsetof(View, eye) == 64);

/// Group 1, binding 0; per rig. Layout 3d0f658f93ac902c.
struct Rig {
    /// Light from everywhere; linear.
    vec3 ambient_light{0.1f, 0.1f, 0.1f};
    std::uint32_t _pad0[1]{};
    /// Linear.
    vec3 sun_diffuse_color{1.0f, 1.0f, 1.0f};
    std::uint32_t _pad1[1]{};
    /// Linear.
    vec3 sun_specular_color{1.0f, 1.0f, 1.0f};
    std::uint32_t _pad2[1]{};
    /// Where the light travels; length 1.
    vec3 sun_direction{0.0f, -1.0f, 0.0f};
    std::uint32_t _pad3[1]{};
    Point lamps[8]{};
    /// The number of `lamps` that shine; 0 to 8.
    std::int32_t lamps_count = 0;
    std::uint32_t _pad4[3]{};
    /// Linear.
    vec3 torch_diffuse_color{1.0f, 1.0f, 1.0f};
    std::uint32_t _pad5[1]{};
    /// Linear.
    vec3 torch_specular_color{1.0f, 1.0f, 1.0f};
    std::uint32_t _pad6[1]{};
    /// On no surface that is drawn; no default: has to be set.
    vec3 torch_place{};
    std::uint32_t _pad7[1]{};
    /// Where the light travels; length 1.
    vec3 torch_axis{0.0f, -1.0f, 0.0f};
    /// 0 to 1.5708; radians.
    float torch_inner = 0.34906584f;
    /// 0 to 1.5708; radians.
    float torch_outer = 0.5235988f;
    std::uint32_t _pad8[3]{};

    static constexpr std::size_t lamps_capacity = 8;
    /// Sets `lamps` and their number; false, and nothing changes, if there are more than 8.
    bool set_lamps(const Point* first, std::size_t count) {
        if (count > lamps_capacity) return false;
        std::copy(first, first + count, lamps);
        lamps_count = static_cast<std::int32_t>(count);
        return true;
    }
};
static_assert(sizeof(Rig) == 544 && offsetof(Rig, sun_diffuse_color) == 16);
static_assert(offsetof(Rig, sun_specular_color) == 32 && offsetof(Rig, sun_direction) == 48);
static_assert(offsetof(Rig, lamps) == 64 && offsetof(Rig, lamps_count) == 448);
static_assert(offsetof(Rig, torch_diffuse_color) == 464);
static_assert(offsetof(Rig, torch_specular_color) == 480 && offsetof(Rig, torch_place) == 496);
static_assert(offsetof(Rig, torch_axis) == 512 && offsetof(Rig, torch_inner) == 524);
static_assert(offsetof(Rig, torch_outer) == 528);

/// Group 2, binding 0; per material. Layout bf52c16bcfd2db34.
struct PlasticMaterial {
    /// Base colour; linear.
    vec3 base{0.462077f, 0.13013647f, 0.012286488f};
    std::uint32_t _pad0[1]{};
    /// Highlight colour; linear.
    vec3 shine{1.0f, 1.0f, 1.0f};
    /// Specular exponent; 1 to 512.
    float power = 48.0f;
};
static_assert(sizeof(PlasticMaterial) == 32 && offsetof(PlasticMaterial, shine) == 16);
static_assert(offsetof(PlasticMaterial, power) == 28);

/// Group 3, binding 0; per draw. Layout 537a3c06595dcb26.
struct Draw {
    mat4 object_to_world{
        vec4{1.0f, 0.0f, 0.0f, 0.0f},
        vec4{0.0f, 1.0f, 0.0f, 0.0f},
        vec4{0.0f, 0.0f, 1.0f, 0.0f},
        vec4{0.0f, 0.0f, 0.0f, 1.0f}
    };
};
static_assert(sizeof(Draw) == 64);

/// Group 1, binding 1; per rig; computed from `Rig`. Layout 97c5e91246cd9c65.
struct RigDerived {
    float torch_falloff_cos{};
    float torch_falloff_inverse_width{};
    std::uint32_t _pad0[2]{};
};
static_assert(sizeof(RigDerived) == 16 && offsetof(RigDerived, torch_falloff_inverse_width) == 4);

/// Group 3, binding 1; per draw; computed from `Draw`. Layout e41d484946444194.
struct DrawDerived {
    mat3x4 normal_matrix{};
};
static_assert(sizeof(DrawDerived) == 48);

/// A sentence about a value that is not what its declaration promises; null if all are.
inline const char* fault(const Rig& rig) {
    if (!has_length_one(rig.sun_direction)) return "`sun.direction` has to be of length 1";
    if (
        !(rig.lamps_count >= 0 && rig.lamps_count <= 8)
    ) return "`lamps.count` is declared in 0 to 8";
    if (!has_length_one(rig.torch_axis)) return "`torch.axis` has to be of length 1";
    if (
        !(rig.torch_inner >= 0.0f && rig.torch_inner <= 1.5707964f)
    ) return "`torch.inner` is declared in 0 to 1.5708";
    if (
        !(rig.torch_outer >= 0.0f && rig.torch_outer <= 1.5707964f)
    ) return "`torch.outer` is declared in 0 to 1.5708";
    return nullptr;
}

/// A sentence about a value that is not what its declaration promises; null if all are.
inline const char* fault(const PlasticMaterial& material) {
    if (
        !(material.power >= 1.0f && material.power <= 512.0f)
    ) return "`power` is declared in 1 to 512";
    return nullptr;
}

inline double quotient(double x, double y) {
    return std::abs(y) < 0x1p-126 ? 0.0 : x / y;
}

/// The values that a host computes of `Rig`, in double precision.
inline RigDerived derive_rig(const Rig& rig) {
    RigDerived derived;
    const double torch_outer = rig.torch_outer;
    const double torch_falloff_cos = std::cos(torch_outer);
    derived.torch_falloff_cos = static_cast<float>(torch_falloff_cos);
    const double difference = std::cos(std::min<double>(double{rig.torch_inner}, torch_outer))
        - torch_falloff_cos;
    derived.torch_falloff_inverse_width = static_cast<float>(
        std::abs(difference) >= 0x1p-64 ? quotient(1.0, difference) : 0x1p+64
    );
    return derived;
}

/// The values that a host computes of `Draw`, in double precision.
inline DrawDerived derive_draw(const Draw& draw) {
    DrawDerived derived;
    const double object_to_world_0_x = draw.object_to_world[0].x;
    const double object_to_world_0_y = draw.object_to_world[0].y;
    const double object_to_world_0_z = draw.object_to_world[0].z;
    const double object_to_world_1_x = draw.object_to_world[1].x;
    const double object_to_world_1_y = draw.object_to_world[1].y;
    const double object_to_world_1_z = draw.object_to_world[1].z;
    const double object_to_world_2_x = draw.object_to_world[2].x;
    const double object_to_world_2_y = draw.object_to_world[2].y;
    const double object_to_world_2_z = draw.object_to_world[2].z;
    const double product = object_to_world_1_y * object_to_world_2_z;
    const double product_2 = object_to_world_1_x * object_to_world_2_z;
    const double product_3 = object_to_world_1_x * object_to_world_2_y;
    const double determinant = object_to_world_0_x
        * (product + object_to_world_1_z * -object_to_world_2_y)
        + object_to_world_0_y * -(product_2 + object_to_world_1_z * -object_to_world_2_x)
        + object_to_world_0_z * (product_3 + object_to_world_1_y * -object_to_world_2_x);
    const double choice = std::abs(determinant) >= 0x1p-126 ? quotient(1.0, determinant) : 0.0;
    derived.normal_matrix[0] = {
        static_cast<float>((product - object_to_world_1_z * object_to_world_2_y) * choice),
        static_cast<float>((object_to_world_1_z * object_to_world_2_x - product_2) * choice),
        static_cast<float>((product_3 - object_to_world_1_y * object_to_world_2_x) * choice),
        0.0f
    };
    derived.normal_matrix[1] = {
        static_cast<float>(
            (object_to_world_2_y * object_to_world_0_z - object_to_world_2_z * object_to_world_0_y)
                * choice
        ),
        static_cast<float>(
            (object_to_world_2_z * object_to_world_0_x - object_to_world_2_x * object_to_world_0_z)
                * choice
        ),
        static_cast<float>(
            (object_to_world_2_x * object_to_world_0_y - object_to_world_2_y * object_to_world_0_x)
                * choice
        ),
        0.0f
    };
    derived.normal_matrix[2] = {
        static_cast<float>(
            (object_to_world_0_y * object_to_world_1_z - object_to_world_0_z * object_to_world_1_y)
                * choice
        ),
        static_cast<float>(
            (object_to_world_0_z * object_to_world_1_x - object_to_world_0_x * object_to_world_1_z)
                * choice
        ),
        static_cast<float>(
            (object_to_world_0_x * object_to_world_1_y - object_to_world_0_y * object_to_world_1_x)
                * choice
        ),
        0.0f
    };
    return derived;
}

namespace detail {
inline constexpr Binding plastic_glsl_vulkan_bindings[] = {
    {"View", Kind::uniform, 0, 0, 3, sizeof(View), "View"},
    {"Rig", Kind::uniform, 1, 0, 2, sizeof(Rig), "Rig"},
    {"RigDerived", Kind::uniform, 1, 1, 2, sizeof(RigDerived), "RigDerived"},
    {"Plastic.Material", Kind::uniform, 2, 0, 2, sizeof(PlasticMaterial), "Material"},
    {"albedo", Kind::texture, 2, 1, 2, 0, "albedo"},
    {"albedo", Kind::sampler, 2, 2, 2, 0, "albedo_sampler"},
    {"Draw", Kind::uniform, 3, 0, 1, sizeof(Draw), "Draw"},
    {"DrawDerived", Kind::uniform, 3, 1, 1, sizeof(DrawDerived), "DrawDerived"},
};
inline constexpr Text plastic_glsl_vulkan_texts[] = {
    {"vertex", "Plastic.vert.glsl", "main", nullptr},
    {"fragment", "Plastic.frag.glsl", "main", nullptr},
};
inline constexpr Binding plastic_wgsl_webgpu_bindings[] = {
    {"View", Kind::uniform, 0, 0, 3, sizeof(View), "View"},
    {"Rig", Kind::uniform, 1, 0, 2, sizeof(Rig), "Rig"},
    {"RigDerived", Kind::uniform, 1, 1, 2, sizeof(RigDerived), "RigDerived"},
    {"Plastic.Material", Kind::uniform, 2, 0, 2, sizeof(PlasticMaterial), "Material"},
    {"albedo", Kind::texture, 2, 1, 2, 0, "albedo"},
    {"albedo", Kind::sampler, 2, 2, 2, 0, "albedo_sampler"},
    {"Draw", Kind::uniform, 3, 0, 1, sizeof(Draw), "Draw"},
    {"DrawDerived", Kind::uniform, 3, 1, 1, sizeof(DrawDerived), "DrawDerived"},
};
inline constexpr Text plastic_wgsl_webgpu_texts[] = {
    {"vertex", "Plastic.vert.wgsl", "main", nullptr},
    {"fragment", "Plastic.frag.wgsl", "main", nullptr},
};
inline constexpr Profile plastic_profiles[] = {
    {"glsl:vulkan", plastic_glsl_vulkan_bindings, plastic_glsl_vulkan_texts, "ccw", "0..1"},
    {"wgsl:webgpu", plastic_wgsl_webgpu_bindings, plastic_wgsl_webgpu_texts, "ccw", "0..1"},
};
inline constexpr const char* plastic_layouts[] = {
    "978849b2805233be",
    "3d0f658f93ac902c",
    "97c5e91246cd9c65",
    "bf52c16bcfd2db34",
    "537a3c06595dcb26",
    "e41d484946444194",
};
inline constexpr VertexInput plastic_inputs[] = {
    {"vertex_position", 0, VertexFormat::float32x3, false},
    {"vertex_normal", 1, VertexFormat::float32x3, false},
    {"vertex_uv", 2, VertexFormat::float32x2, false},
};
inline constexpr Texture plastic_textures[] = {
    {
        "albedo",
        "2d",
        "float",
        "color",
        {1.0f, 1.0f, 1.0f, 1.0f},
        "filtering",
        {"linear", "linear", "repeat", "repeat", "repeat", nullptr, nullptr, 1}
    },
};
inline constexpr Target plastic_targets[] = {
    {"color", 0, "rgba8unorm-srgb", "srgb", "rgba", nullptr},
};
}  // namespace detail

inline constexpr Material plastic = {
    "Plastic",
    detail::plastic_layouts,
    detail::plastic_inputs,
    detail::plastic_textures,
    detail::plastic_targets,
    "triangle-list", "none", 1, "less", true, 0, 0.0f, 0.0f, false,
    detail::plastic_profiles,
};

}  // namespace burnish::plastic
