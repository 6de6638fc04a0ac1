#include "host/import/gltf/meshopt.h"

#include "host/base/interval.h"

#include <fmt/format.h>
#include <meshoptimizer.h>

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

namespace hyalite::core::gltf {
namespace {

enum class CompressedKind { Attributes, Triangles, Indices };
enum class Filter { None, Octahedral, Quaternion, Exponential };

constexpr auto modes =
    std::to_array<std::pair<std::string_view, CompressedKind>>({{"ATTRIBUTES", CompressedKind::Attributes},
                                                                {"TRIANGLES", CompressedKind::Triangles},
                                                                {"INDICES", CompressedKind::Indices}});
constexpr auto filters =
    std::to_array<std::pair<std::string_view, Filter>>({{"NONE", Filter::None},
                                                        {"OCTAHEDRAL", Filter::Octahedral},
                                                        {"QUATERNION", Filter::Quaternion},
                                                        {"EXPONENTIAL", Filter::Exponential}});

/// Whether the filter works on elements of that size.
bool takes(Filter filter, std::size_t stride) {
    switch (filter) {
    case Filter::None:
        return true;
    case Filter::Octahedral:
        return stride == 4 || stride == 8;
    case Filter::Quaternion:
        return stride == 8;
    case Filter::Exponential:
        return stride % 4 == 0;
    }
    return false;
}

void apply(Filter filter, std::vector<std::byte> &bytes, std::size_t count, std::size_t stride) {
    switch (filter) {
    case Filter::None:
        break;
    case Filter::Octahedral:
        meshopt_decodeFilterOct(bytes.data(), count, stride);
        break;
    case Filter::Quaternion:
        meshopt_decodeFilterQuat(bytes.data(), count, stride);
        break;
    case Filter::Exponential:
        meshopt_decodeFilterExp(bytes.data(), count, stride);
        break;
    }
}

int decode(CompressedKind mode, std::vector<std::byte> &bytes, std::size_t count, std::size_t stride,
           std::span<const std::byte> packed) {
    const auto *const data = reinterpret_cast<const unsigned char *>(packed.data());
    switch (mode) {
    case CompressedKind::Attributes:
        return meshopt_decodeVertexBuffer(bytes.data(), count, stride, data, packed.size());
    case CompressedKind::Triangles:
        return meshopt_decodeIndexBuffer(bytes.data(), count, stride, data, packed.size());
    case CompressedKind::Indices:
        return meshopt_decodeIndexSequence(bytes.data(), count, stride, data, packed.size());
    }
    return -1;
}

} // namespace

std::vector<std::byte> decompressMeshopt(const JsonObject &extension, std::span<const std::byte> packed,
                                         const std::function<void(std::size_t)> &allow) {
    const CompressedKind mode = extension.choice("mode", modes);
    const Filter filter = extension.choice("filter", filters, Filter::None);
    const JsonNode strideNode = extension.at("byteStride");
    const auto stride = static_cast<std::size_t>(strideNode.wholeNumber({2, 256}));
    const bool isIndex = mode != CompressedKind::Attributes;
    if (isIndex ? stride != 2 && stride != 4 : stride % 4 != 0)
        strideNode.refuse(isIndex ? "2 or 4 for indices" : "a multiple of 4 for attributes");
    if (!takes(filter, stride) || (isIndex && filter != Filter::None))
        extension.at("filter").fail(fmt::format("is not for elements of {} bytes in this mode", stride));
    const JsonNode countNode = extension.at("count");
    const auto count = static_cast<std::size_t>(countNode.wholeNumber({1.0, 4294967295.0}));
    if (mode == CompressedKind::Triangles && count % 3 != 0)
        countNode.refuse("a multiple of 3 for triangles");
    // Attributes take two bits for 16 numbers of one byte at least, triangles a byte for three indices.
    constexpr std::size_t densest = 64;
    if (count * stride / densest > packed.size())
        countNode.fail(fmt::format("{} elements of {} bytes do not fit in {} bytes of compressed data", count,
                                   stride, packed.size()));
    allow(count * stride);
    std::vector<std::byte> bytes(count * stride);
    if (decode(mode, bytes, count, stride, packed) != 0)
        countNode.fail("the compressed data is damaged");
    apply(filter, bytes, count, stride);
    return bytes;
}

} // namespace hyalite::core::gltf
