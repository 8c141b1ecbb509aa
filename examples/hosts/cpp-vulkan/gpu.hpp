// A device of Vulkan 1.3 without a window: memory, buffers, images and commands. There is nothing of
// Burnish in this file: an engine has all of it already.
#pragma once

#include <vulkan/vulkan.h>

#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

inline void insist(VkResult result, const char* what) {
    if (result != VK_SUCCESS) throw std::runtime_error(std::string("Vulkan refuses ") + what);
}

struct Buffer {
    VkBuffer handle = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    std::size_t size = 0;
};

/// A picture of one level, which stays in the general layout.
struct Image {
    VkImage handle = VK_NULL_HANDLE;
    VkDeviceMemory memory = VK_NULL_HANDLE;
    VkImageView view = VK_NULL_HANDLE;
    VkImageAspectFlags aspect = 0;
    VkExtent2D extent{};
};

/// Everything lives until the process ends: this program draws one picture.
class Gpu {
public:
    VkDevice device = VK_NULL_HANDLE;
    VkCommandBuffer commands = VK_NULL_HANDLE;
    VkDescriptorPool pool = VK_NULL_HANDLE;

    Gpu() {
        VkApplicationInfo application{};
        application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
        application.apiVersion = VK_API_VERSION_1_3;
        VkInstanceCreateInfo wanted{};
        wanted.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
        wanted.pApplicationInfo = &application;
        VkInstance instance = VK_NULL_HANDLE;
        insist(vkCreateInstance(&wanted, nullptr, &instance), "an instance of version 1.3");
        std::uint32_t count = 1;
        vkEnumeratePhysicalDevices(instance, &count, &physical_);
        if (count == 0) throw std::runtime_error("Vulkan has no device here");
        vkGetPhysicalDeviceMemoryProperties(physical_, &memories_);

        VkPhysicalDeviceVulkan13Features features{};
        features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES;
        features.dynamicRendering = VK_TRUE;
        const float priority = 1.0f;
        VkDeviceQueueCreateInfo queue{};
        queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
        queue.queueCount = 1;
        queue.pQueuePriorities = &priority;
        VkDeviceCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
        info.pNext = &features;
        info.queueCreateInfoCount = 1;
        info.pQueueCreateInfos = &queue;
        insist(
            vkCreateDevice(physical_, &info, nullptr, &device),
            "a device that draws without render passes"
        );
        vkGetDeviceQueue(device, 0, 0, &queue_);

        VkCommandPoolCreateInfo of_commands{};
        of_commands.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
        VkCommandPool command_pool = VK_NULL_HANDLE;
        insist(vkCreateCommandPool(device, &of_commands, nullptr, &command_pool), "commands");
        VkCommandBufferAllocateInfo one{};
        one.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
        one.commandPool = command_pool;
        one.commandBufferCount = 1;
        insist(vkAllocateCommandBuffers(device, &one, &commands), "commands");
        const VkDescriptorPoolSize sizes[] = {
            {VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 256},
            {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 256},
            {VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 256},
            {VK_DESCRIPTOR_TYPE_SAMPLER, 256},
            {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 256}
        };
        VkDescriptorPoolCreateInfo of_sets{};
        of_sets.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
        of_sets.maxSets = 256;
        of_sets.poolSizeCount = 5;
        of_sets.pPoolSizes = sizes;
        insist(vkCreateDescriptorPool(device, &of_sets, nullptr, &pool), "descriptor sets");
        VkCommandBufferBeginInfo begin{};
        begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
        insist(vkBeginCommandBuffer(commands, &begin), "to record commands");
    }

    /// A buffer that the processor writes and reads; `bytes` may be null.
    Buffer buffer(const void* bytes, std::size_t size, VkBufferUsageFlags usage) {
        Buffer made{VK_NULL_HANDLE, VK_NULL_HANDLE, size};
        VkBufferCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO;
        info.size = size;
        info.usage = usage;
        insist(vkCreateBuffer(device, &info, nullptr, &made.handle), "a buffer");
        VkMemoryRequirements needs{};
        vkGetBufferMemoryRequirements(device, made.handle, &needs);
        made.memory = memory(
            needs, VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT
        );
        insist(vkBindBufferMemory(device, made.handle, made.memory, 0), "memory of a buffer");
        if (bytes != nullptr) std::memcpy(mapped(made), bytes, size);
        return made;
    }

    void* mapped(const Buffer& buffer) {
        void* found = nullptr;
        insist(vkMapMemory(device, buffer.memory, 0, VK_WHOLE_SIZE, 0, &found), "to map memory");
        return found;
    }

    Image image(VkFormat format, VkExtent2D extent, VkImageUsageFlags usage) {
        const bool is_depth = format == VK_FORMAT_D32_SFLOAT;
        Image made;
        made.extent = extent;
        made.aspect = is_depth ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
        VkImageCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO;
        info.imageType = VK_IMAGE_TYPE_2D;
        info.format = format;
        info.extent = {extent.width, extent.height, 1};
        info.mipLevels = info.arrayLayers = 1;
        info.samples = VK_SAMPLE_COUNT_1_BIT;
        info.usage = usage;
        insist(vkCreateImage(device, &info, nullptr, &made.handle), "an image");
        VkMemoryRequirements needs{};
        vkGetImageMemoryRequirements(device, made.handle, &needs);
        made.memory = memory(needs, 0);
        insist(vkBindImageMemory(device, made.handle, made.memory, 0), "memory of an image");
        VkImageViewCreateInfo view{};
        view.sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO;
        view.image = made.handle;
        view.viewType = VK_IMAGE_VIEW_TYPE_2D;
        view.format = format;
        view.subresourceRange = {made.aspect, 0, 1, 0, 1};
        insist(vkCreateImageView(device, &view, nullptr, &made.view), "a view of an image");
        to_general(made);
        return made;
    }

    void fill(const Image& image, const void* texels, std::size_t size) {
        const Buffer staged = buffer(texels, size, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
        const VkBufferImageCopy region = whole(image);
        vkCmdCopyBufferToImage(
            commands, staged.handle, image.handle, VK_IMAGE_LAYOUT_GENERAL, 1, &region
        );
        wait_for_all();
    }

    /// What comes behind this in the commands sees everything that was written before.
    void wait_for_all() {
        VkMemoryBarrier barrier{};
        barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
        barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
        barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
        vkCmdPipelineBarrier(
            commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 1,
            &barrier, 0, nullptr, 0, nullptr
        );
    }

    /// Executes all commands, and returns the four bytes of each pixel of an image.
    std::vector<unsigned char> read(const Image& image) {
        std::vector<unsigned char> bytes(std::size_t{4} * image.extent.width * image.extent.height);
        const Buffer target = buffer(nullptr, bytes.size(), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
        const VkBufferImageCopy region = whole(image);
        wait_for_all();
        vkCmdCopyImageToBuffer(
            commands, image.handle, VK_IMAGE_LAYOUT_GENERAL, target.handle, 1, &region
        );
        wait_for_all();
        insist(vkEndCommandBuffer(commands), "the commands");
        VkSubmitInfo submit{};
        submit.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
        submit.commandBufferCount = 1;
        submit.pCommandBuffers = &commands;
        insist(vkQueueSubmit(queue_, 1, &submit, VK_NULL_HANDLE), "to draw");
        insist(vkQueueWaitIdle(queue_), "to finish");
        std::memcpy(bytes.data(), mapped(target), bytes.size());
        return bytes;
    }

    VkShaderModule module(const std::vector<std::uint32_t>& words) {
        VkShaderModuleCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SHADER_MODULE_CREATE_INFO;
        info.codeSize = words.size() * 4;
        info.pCode = words.data();
        VkShaderModule made = VK_NULL_HANDLE;
        insist(vkCreateShaderModule(device, &info, nullptr, &made), "a shader");
        return made;
    }

    VkPipeline pipeline(const VkGraphicsPipelineCreateInfo& info) {
        VkPipeline made = VK_NULL_HANDLE;
        insist(
            vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &made),
            "a pipeline"
        );
        return made;
    }

    void bind(VkPipelineLayout layout, const std::vector<VkDescriptorSet>& sets) {
        const auto count = static_cast<std::uint32_t>(sets.size());
        vkCmdBindDescriptorSets(
            commands, VK_PIPELINE_BIND_POINT_GRAPHICS, layout, 0, count, sets.data(), 0, nullptr
        );
    }

private:
    static VkBufferImageCopy whole(const Image& image) {
        VkBufferImageCopy region{};
        region.imageSubresource = {image.aspect, 0, 0, 1};
        region.imageExtent = {image.extent.width, image.extent.height, 1};
        return region;
    }

    void to_general(const Image& image) {
        VkImageMemoryBarrier barrier{};
        barrier.sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER;
        barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
        barrier.newLayout = VK_IMAGE_LAYOUT_GENERAL;
        barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
        barrier.image = image.handle;
        barrier.subresourceRange = {image.aspect, 0, 1, 0, 1};
        vkCmdPipelineBarrier(
            commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 0,
            nullptr, 0, nullptr, 1, &barrier
        );
    }

    VkDeviceMemory memory(const VkMemoryRequirements& needs, VkMemoryPropertyFlags wanted) {
        VkMemoryAllocateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO;
        info.allocationSize = needs.size;
        while (info.memoryTypeIndex < memories_.memoryTypeCount) {
            const VkMemoryPropertyFlags has =
                memories_.memoryTypes[info.memoryTypeIndex].propertyFlags;
            if ((needs.memoryTypeBits >> info.memoryTypeIndex & 1) != 0 && (has & wanted) == wanted)
                break;
            ++info.memoryTypeIndex;
        }
        VkDeviceMemory found = VK_NULL_HANDLE;
        insist(vkAllocateMemory(device, &info, nullptr, &found), "memory");
        return found;
    }

    VkPhysicalDevice physical_ = VK_NULL_HANDLE;
    VkPhysicalDeviceMemoryProperties memories_{};
    VkQueue queue_ = VK_NULL_HANDLE;
};
