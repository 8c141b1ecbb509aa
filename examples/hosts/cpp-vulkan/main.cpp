// Draws materials of Burnish with Vulkan 1.3: `cpp-vulkan plastic|banner|shadows OUTPUT.png`.
//
// CMake has `burnish` write the shaders, as SPIR-V, and scene.hpp: the blocks, tables and frames.
#define BURNISH_VULKAN
#include "scene.hpp"

#define STB_IMAGE_WRITE_IMPLEMENTATION
#include <stb/stb_image_write.h>

#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

#include "gpu.hpp"

using nlohmann::json;
namespace vulkan = burnish::vulkan;

constexpr VkPipelineBindPoint GRAPHICS = VK_PIPELINE_BIND_POINT_GRAPHICS;
constexpr VkImageLayout GENERAL = VK_IMAGE_LAYOUT_GENERAL;

/// The numbers of a list, as they are stored: a vector, a matrix, or several of these.
template <class T>
static T stored(const json& numbers) {
    const auto lanes = numbers.get<std::vector<float>>();
    if (lanes.size() * sizeof(float) != sizeof(T))
        throw std::runtime_error("scene.json has a list of another length");
    T found;
    std::memcpy(&found, lanes.data(), sizeof(T));
    return found;
}

static std::string text_of(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error("there is no file " + path);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Draws the steps of a frame, each with the models of a scene.
class Engine : public burnish::FrameHost {
public:
    Engine(const json& document, const json& scene) : document_(document), scene_(scene) {}

    /// Uploads the pictures that a material reads. Colours are encoded as sRGB, and decoded where
    /// they are read.
    void load_pictures(const burnish::Material& material) {
        for (const burnish::Texture& each : material.textures) {
            const json& picture =
                document_["pictures"][scene_["textures"][each.name].get<std::string>()];
            const auto texels = picture["rgba"].get<std::vector<unsigned char>>();
            const bool is_color = each.intent == burnish::Intent::color;
            const VkFormat format = is_color ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM;
            const VkImageUsageFlags usage =
                VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
            const Image image = gpu_.image(format, {picture["width"], picture["height"]}, usage);
            gpu_.fill(image, texels.data(), texels.size());
            pictures_[each.name] = image.view;
        }
    }

    bool begin(
        const burnish::Frame& frame, const std::vector<std::array<int, 2>>& sizes,
        const std::vector<int>&
    ) override {
        for (std::size_t number = 0; number < frame.textures.size(); ++number) {
            const burnish::FrameTexture& row = frame.textures[number];
            VkImageUsageFlags usage =
                row.format == burnish::Format::depth32float ? 0 : VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
            for (const burnish::TextureUse use : row.uses)
                usage |= vulkan::of(use);
            const VkExtent2D extent{
                std::uint32_t(sizes[number][0]), std::uint32_t(sizes[number][1])
            };
            formats_.push_back(vulkan::of(row.format));
            images_.push_back(gpu_.image(formats_.back(), extent, usage));
        }
        return false;
    }

    void begin_pass(const burnish::Pass& pass) override {
        std::vector<VkRenderingAttachmentInfo> targets;
        for (const burnish::Attachment& each : pass.targets)
            targets.push_back(attachment(each));
        const VkRenderingAttachmentInfo depth =
            pass.depth ? attachment(*pass.depth) : VkRenderingAttachmentInfo{};
        const VkExtent2D extent =
            images_[pass.depth ? pass.depth->texture : pass.targets[0].texture].extent;
        depth_format_ = pass.depth ? formats_[pass.depth->texture] : VK_FORMAT_UNDEFINED;
        VkRenderingInfo info{};
        info.sType = VK_STRUCTURE_TYPE_RENDERING_INFO;
        info.renderArea.extent = extent;
        info.layerCount = 1;
        info.colorAttachmentCount = std::uint32_t(targets.size());
        info.pColorAttachments = targets.data();
        info.pDepthAttachment = pass.depth ? &depth : nullptr;
        vkCmdBeginRendering(gpu_.commands, &info);
        const VkViewport port = vulkan::viewport(0, 0, float(extent.width), float(extent.height));
        vkCmdSetViewport(gpu_.commands, 0, 1, &port);
        vkCmdSetScissor(gpu_.commands, 0, 1, &info.renderArea);
    }

    void draw_models(const char*, const std::vector<burnish::Use>& uses) override {
        for (const json& model : scene_["models"])
            for (const burnish::Use& use : uses)
                if (model["material"] == use.material) draw(model, use);
    }

    void end_pass() override {
        vkCmdEndRendering(gpu_.commands);
        gpu_.wait_for_all();
    }

    void end(const burnish::Frame& frame) override { output_ = frame.outputs[0].number; }
    void fill(const burnish::Use&, int) override { refuse(); }
    void copy(int, int) override { refuse(); }
    void dispatch(
        const burnish::Use&, std::array<int, 3>, const std::vector<burnish::Written>&,
        const std::vector<burnish::Written>&
    ) override {
        refuse();
    }

    /// Writes the frame's first output as a picture.
    void write(const std::string& path) {
        const Image& image = images_[output_];
        std::vector<unsigned char> bytes = gpu_.read(image);
        for (std::size_t alpha = 3; alpha < bytes.size(); alpha += 4)
            bytes[alpha] = 255;
        const int width = int(image.extent.width), height = int(image.extent.height);
        if (stbi_write_png(path.c_str(), width, height, 4, bytes.data(), width * 4) == 0)
            throw std::runtime_error("there is no way to write " + path);
    }

private:
    [[noreturn]] static void refuse() { throw std::runtime_error("this host draws models only"); }

    VkRenderingAttachmentInfo attachment(const burnish::Attachment& each) const {
        VkRenderingAttachmentInfo info{};
        info.sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO;
        info.imageView = images_[each.texture].view;
        info.imageLayout = VK_IMAGE_LAYOUT_GENERAL;
        info.loadOp = each.is_cleared ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD;
        info.storeOp =
            each.is_stored ? VK_ATTACHMENT_STORE_OP_STORE : VK_ATTACHMENT_STORE_OP_DONT_CARE;
        std::memcpy(&info.clearValue, each.clear.data(), sizeof each.clear);
        return info;
    }

    /// Draws one model with a shader: its camera, its place and its bones are given by their roles.
    void draw(const json& model, const burnish::Use& use) {
        const burnish::Material& material = *use.shader;
        const std::unique_ptr<burnish::Blocks> blocks = material.make_blocks();
        blocks->set("world_to_clip", stored<burnish::mat4>(document_["camera"]["view_projection"]));
        blocks->set("eye", stored<burnish::vec3>(document_["camera"]["eye"]));
        blocks->set("object_to_world", stored<burnish::mat4>(model["object_to_world"]));
        std::array<burnish::mat4, 4> bones;
        for (std::size_t bone = 0; bone < bones.size(); ++bone)
            bones[bone] = stored<burnish::mat4>(document_["bones"][bone]);
        blocks->set("pose", bones);
        use.give(*blocks);
        blocks->derive();
        if (const char* told =
                burnish::stale(material, text_of(SHADERS + std::string(material.name) + ".json")))
            throw std::runtime_error(told);
        const json& mesh = document_["meshes"][model["mesh"].get<std::string>()];

        // -- glue
        const burnish::Profile& profile = *vulkan::profile(material);
        const auto layout = vulkan::make_layout(gpu_.device, profile);
        const auto find = [&](const burnish::Binding& each) -> vulkan::Resource {
            if (const void* bytes = blocks->find(each.name))
                return {{uploaded(bytes, each.size), 0, each.size}, {}};
            return {{}, {sampler(material, each.name), view(use, each.name), GENERAL}};
        };
        const auto sets = vulkan::make_sets(gpu_.device, gpu_.pool, layout, profile, find);
        vulkan::Pipeline state(material, profile, layout, depth_format_);
        for (const burnish::Text& text : profile.texts) state.add(text, module(text.module));
        vkCmdBindPipeline(gpu_.commands, GRAPHICS, gpu_.pipeline(state.info));
        gpu_.bind(layout.pipeline, sets);
        for (std::uint32_t number = 0; number < material.vertex_inputs.size(); ++number)
            bind_vertices(number, material.vertex_inputs[number], mesh);
        // -- end of glue

        const auto indices = mesh["indices"].get<std::vector<std::uint32_t>>();
        const Buffer buffer =
            gpu_.buffer(indices.data(), indices.size() * 4, VK_BUFFER_USAGE_INDEX_BUFFER_BIT);
        vkCmdBindIndexBuffer(gpu_.commands, buffer.handle, 0, VK_INDEX_TYPE_UINT32);
        vkCmdDrawIndexed(gpu_.commands, std::uint32_t(indices.size()), 1, 0, 0, 0);
    }

    VkShaderModule module(const std::string& name) {
        const std::string bytes = text_of(SHADERS + name + ".spv");
        std::vector<std::uint32_t> words(bytes.size() / 4);
        std::memcpy(words.data(), bytes.data(), bytes.size());
        return gpu_.module(words);
    }

    VkBuffer uploaded(const void* bytes, std::size_t size) {
        return gpu_.buffer(bytes, size, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT).handle;
    }

    /// A vertex input is called `vertex_normal`, and the numbers of a mesh `normal`.
    void bind_vertices(std::uint32_t number, const burnish::VertexInput& input, const json& mesh) {
        const json& numbers = mesh[std::string(input.name).substr(sizeof "vertex")];
        const auto floats = numbers.get<std::vector<float>>();
        const auto whole = numbers.get<std::vector<std::uint32_t>>();
        const bool is_whole = input.format >= burnish::VertexFormat::uint32;
        const void* bytes = is_whole ? static_cast<const void*>(whole.data()) : floats.data();
        const Buffer buffer =
            gpu_.buffer(bytes, numbers.size() * 4, VK_BUFFER_USAGE_VERTEX_BUFFER_BIT);
        const VkDeviceSize start = 0;
        vkCmdBindVertexBuffers(gpu_.commands, number, 1, &buffer.handle, &start);
    }

    static const burnish::Texture& texture(
        const burnish::Material& material, std::string_view name
    ) {
        for (const burnish::Texture& each : material.textures)
            if (each.name == name) return each;
        throw std::runtime_error("no texture is called " + std::string(name));
    }

    VkSampler sampler(const burnish::Material& material, const char* name) {
        const VkSamplerCreateInfo info = vulkan::sampler(texture(material, name).sampler);
        VkSampler found = VK_NULL_HANDLE;
        insist(vkCreateSampler(gpu_.device, &info, nullptr, &found), "a sampler");
        return found;
    }

    /// A result of the frame, or a picture of the scene, which was uploaded before the first pass.
    VkImageView view(const burnish::Use& use, const std::string& name) {
        for (const burnish::Read& each : use.reads)
            if (each.name == name) return images_[each.source.number].view;
        return pictures_.at(name);
    }

    Gpu gpu_;
    const json& document_;
    const json& scene_;
    std::vector<Image> images_;
    std::vector<VkFormat> formats_;
    std::map<std::string, VkImageView> pictures_;
    VkFormat depth_format_ = VK_FORMAT_UNDEFINED;
    int output_ = 0;
};

/// The frame of a picture that is no frame of Burnish: a target, and depths.
constexpr burnish::TextureUse TARGET[] = {burnish::TextureUse::target},
                              DEPTH[] = {burnish::TextureUse::depth};
constexpr burnish::FrameTexture TEXTURES[] = {
    {"color", burnish::Format::rgba8unorm_srgb, burnish::Dimension::e2d, 1, 1, 1, TARGET, false},
    {"depth", burnish::Format::depth32float, burnish::Dimension::e2d, 1, 1, 1, DEPTH, false}
};
constexpr burnish::Output PICTURE[] = {{"picture", false, 0}};
constexpr burnish::Frame SINGLE = {"single", TEXTURES, {}, {}, PICTURE, {}};

static void draw_single(Engine& engine, int size, const burnish::Use& use) {
    engine.load_pictures(*use.shader);
    engine.begin(SINGLE, {{size, size}, {size, size}}, {});
    engine.begin_pass(
        {"picture",
         false,
         {{"color", 0, 0, 0, true, {}, true}},
         burnish::Attachment{"depth", 1, 0, 0, true, {1.0f}, false}}
    );
    engine.draw_models("scene", {use});
    engine.end_pass();
    engine.end(SINGLE);
}

static void insist_on_no_fault(const char* told) {
    if (told != nullptr) throw std::runtime_error(told);
}

static void draw(Engine& engine, const std::string& name, int size, const json& lights) {
    namespace scene = burnish::scene;
    const auto vector = [&](const json& light, const char* part) {
        return stored<burnish::vec3>(light[part]);
    };
    if (name == "plastic") {
        draw_single(engine, size, {"Plastic", &scene::plastic, {}, [&](burnish::Blocks& blocks) {
            auto& rig = static_cast<scene::PlasticBlocks&>(blocks).rig;
            rig.sun_direction = vector(lights["sun"], "direction");
            scene::Point lamps[2];
            for (int i = 0; i < 2; ++i) {
                lamps[i].place = vector(lights["lamps"][i], "place");
                lamps[i].diffuse_color = vector(lights["lamps"][i], "diffuse_color");
            }
            if (!rig.set_lamps(lamps, 2)) throw std::runtime_error("there are too many lamps");
            rig.torch_place = vector(lights["torch"], "place");
            rig.torch_axis = vector(lights["torch"], "axis");
            insist_on_no_fault(fault(rig));
        }});
    } else if (name == "banner") {
        draw_single(engine, size, {"Banner", &scene::banner, {}, [&](burnish::Blocks& blocks) {
            auto& rig = static_cast<scene::BannerBlocks&>(blocks).rig;
            rig.sun_direction = vector(lights["sun"], "direction");
            insist_on_no_fault(fault(rig));
        }});
    } else {
        scene::ShadowsParameters parameters;
        parameters.size = {size, size};
        parameters.lamp_place = vector(lights["lamp"], "place");
        parameters.lamp_axis = vector(lights["lamp"], "axis");
        insist_on_no_fault(fault(parameters));
        scene::draw_shadows(engine, parameters);
    }
}

int main(int count, char** words) try {
    const std::string name = count > 1 ? words[1] : "";
    const json document = json::parse(text_of(SCENE));
    if (count != 3 || !document["scenes"].contains(name)) {
        std::cerr << "there is no scene `" << name << "`: there are banner, plastic, shadows\n";
        return 2;
    }
    const json& scene = document["scenes"][name];
    Engine engine(document, scene);
    draw(engine, name, document["size"][0], scene["lights"]);
    engine.write(words[2]);
} catch (const std::exception& error) {
    std::cerr << "cpp-vulkan: " << error.what() << "\n";
    return 1;
}
