#include "host/import/gltf/textures.h"

#include "host/base/error.h"
#include "host/import/gltf/uri.h"
#include "host/scene/limits.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

namespace hyalite::core::gltf {
namespace {

Wrap readWrap(const JsonObject &sampler, std::string_view key) {
    constexpr int repeat = 10497;
    constexpr int mirror = 33648;
    constexpr int clamp = 33071;
    const int mode = sampler.integer<int>(key, {0, 65535}, repeat);
    if (mode != repeat && mode != mirror && mode != clamp)
        sampler.at(key).refuse("33071, 33648 or 10497");
    return mode == repeat ? Wrap::Repeat : mode == mirror ? Wrap::Mirror : Wrap::Clamp;
}

void readSampler(const JsonObject &sampler, TextureUse &use) {
    constexpr int nearest = 9728;
    constexpr int linear = 9729;
    use.wrapU = readWrap(sampler, "wrapS");
    use.wrapV = readWrap(sampler, "wrapT");
    const int filter = sampler.integer<int>("magFilter", {0, 65535}, linear);
    if (filter != nearest && filter != linear)
        sampler.at("magFilter").refuse("9728 or 9729");
    use.isNearest = filter == nearest;
}

glm::dvec2 readPair(const JsonObject &object, std::string_view key, const glm::dvec2 &fallback) {
    const std::optional<JsonNode> node = object.find(key);
    if (!node)
        return fallback;
    const std::vector<double> numbers = numbersOf(*node, 2, limits::texturePlacement);
    return {numbers[0], numbers[1]};
}

} // namespace

// u' = cos sx u + sin sy v + ox and v' = -sin sx u + cos sy v + oy, with v counted from the top: 1 - v here.
void place(TextureUse &use, const UvTransform &transform) {
    const double c = std::cos(transform.rotation);
    const double s = std::sin(transform.rotation);
    const glm::dvec2 &scale = transform.scale;
    use.scale = glm::vec2(c * scale.x, c * scale.y);
    use.shear = glm::vec2(-s * scale.y, s * scale.x);
    use.offset = glm::vec2(transform.offset.x + s * scale.y, 1.0 - transform.offset.y - c * scale.y);
}

std::optional<TextureUse> TextureReader::read(const JsonNode &textureInfo) {
    const JsonObject info(textureInfo);
    const Document &document = buffers_.document();
    const std::size_t index = document.reference(info.at("index"), "textures");
    const JsonObject texture(document.at("textures", index));
    TextureUse use;
    auto uvSet = info.integer<std::uint32_t>("texCoord", {0, 65535}, std::uint32_t{0});
    if (const std::optional<JsonObject> object = extensionOf(info, "KHR_texture_transform")) {
        place(use, {.offset = readPair(*object, "offset", glm::dvec2(0.0)),
                    .rotation = object->number("rotation", limits::texturePlacement, 0.0),
                    .scale = readPair(*object, "scale", glm::dvec2(1.0))});
        uvSet = object->integer<std::uint32_t>("texCoord", {0, 65535}, uvSet);
    }
    use.uvSet = uvSet;
    if (const auto sampler = document.reference(texture, "sampler", "samplers"))
        readSampler(JsonObject(document.at("samplers", *sampler)), use);
    if (uvSet > 1) {
        losses().add("texture coordinates", [&] {
            return fmt::format("{}: {}: the texture is left out, as it wants TEXCOORD_{}; two sets are read",
                               document.fileName(), textureInfo.path.to_string(), uvSet);
        });
        return std::nullopt;
    }
    std::optional<std::size_t> source = document.reference(texture, "source", "images");
    if (const std::optional<JsonObject> webp = extensionOf(texture, "EXT_texture_webp"))
        source = document.reference(webp->at("source"), "images");
    if (!source) {
        losses().add("texture without image", [&] {
            return fmt::format("{}: /textures/{}: it has no image that is read, and is left out",
                               document.fileName(), index);
        });
        return std::nullopt;
    }
    const std::optional<std::uint32_t> loaded = image(*source);
    if (!loaded)
        return std::nullopt;
    use.textureIndex = *loaded;
    return use;
}

std::optional<std::uint32_t> TextureReader::image(std::size_t index) {
    if (const auto known = images_.find(index); known != images_.end())
        return known->second;
    const JsonNode node = buffers_.document().at("images", index);
    const JsonObject object(node);
    const std::string name = fmt::format("{}#/images/{}", buffers_.document().fileName(), index);
    std::optional<std::uint32_t> loaded;
    try {
        loaded = load(node, object, name);
        if (library_.at(*loaded).isFloat()) {
            losses().add("image of floats", [&] {
                return fmt::format("{}: it is left out: an image of floats; PNG, JPEG and WebP are read",
                                   name);
            });
            loaded.reset();
        }
    } catch (const Error &error) {
        if (error.kind != ErrorKind::BadInput && error.kind != ErrorKind::LimitExceeded)
            throw;
        losses().add("image",
                     [&] { return fmt::format("the texture {} is left out: {}", name, error.what()); });
    }
    images_.emplace(index, loaded);
    return loaded;
}

std::uint32_t TextureReader::load(const JsonNode &node, const JsonObject &object, const std::string &name) {
    if (const std::optional<JsonNode> view = object.find("bufferView")) {
        const std::size_t index = buffers_.document().reference(*view, "bufferViews");
        return library_.load(name, buffers_.view(index).bytes);
    }
    const std::optional<JsonNode> uri = object.find("uri");
    if (!uri)
        node.fail("an image with neither \"uri\" nor \"bufferView\"; allowed: one of the two");
    if (const std::optional<std::vector<std::byte>> data = dataOf(*uri))
        return library_.load(name, *data);
    const std::filesystem::path path = access_.resolve(*uri, fileNameOf(*uri));
    return library_.load(path);
}

} // namespace hyalite::core::gltf
