// All that an EXR file has, by OpenEXR's own reader.
#pragma once

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace hyalite::core::testing {

/// All channels of an EXR, by name.
[[nodiscard]] inline std::map<std::string, std::vector<float>> channelsOf(const std::filesystem::path &path) {
    Imf::InputFile file(path.c_str());
    const Imath::Box2i window = file.header().dataWindow();
    const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
    const auto height = static_cast<std::size_t>(window.max.y - window.min.y + 1);
    std::map<std::string, std::vector<float>> channels;
    Imf::FrameBuffer buffer;
    const Imf::ChannelList &list = file.header().channels();
    for (auto channel = list.begin(); channel != list.end(); ++channel) {
        std::vector<float> &values = channels[channel.name()];
        values.resize(width * height);
        char *const origin = reinterpret_cast<char *>(values.data()) -
                             sizeof(float) * (static_cast<std::size_t>(window.min.x) +
                                              static_cast<std::size_t>(window.min.y) * width);
        buffer.insert(channel.name(), Imf::Slice(Imf::FLOAT, origin, sizeof(float), sizeof(float) * width));
    }
    file.setFrameBuffer(buffer);
    file.readPixels(window.min.y, window.max.y);
    return channels;
}

[[nodiscard]] inline bool areSame(const std::map<std::string, std::vector<float>> &a,
                                  const std::map<std::string, std::vector<float>> &b) {
    return std::ranges::equal(a, b, [](const auto &one, const auto &other) {
        return one.first == other.first && std::ranges::equal(std::as_bytes(std::span(one.second)),
                                                              std::as_bytes(std::span(other.second)));
    });
}

/// What the file says of its layers: the attributes of Cryptomattes, and names of numbers.
[[nodiscard]] inline std::map<std::string, std::string> layerAttributesOf(const std::filesystem::path &path) {
    Imf::InputFile file(path.c_str());
    std::map<std::string, std::string> attributes;
    for (auto entry = file.header().begin(); entry != file.header().end(); ++entry) {
        const std::string name = entry.name();
        if (name.starts_with("cryptomatte/") || name.ends_with(".names"))
            attributes[name] = dynamic_cast<const Imf::StringAttribute &>(entry.attribute()).value();
    }
    return attributes;
}

} // namespace hyalite::core::testing
