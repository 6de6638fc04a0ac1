#include "host/import/gltf/accessor.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace hyalite::core::gltf {
namespace {

struct Type {
    std::string_view name;
    std::size_t rowCount;
    std::size_t columnCount;
};

constexpr auto types = std::to_array<Type>({{"SCALAR", 1, 1},
                                            {"VEC2", 2, 1},
                                            {"VEC3", 3, 1},
                                            {"VEC4", 4, 1},
                                            {"MAT2", 2, 2},
                                            {"MAT3", 3, 3},
                                            {"MAT4", 4, 4}});

/// 0 for a number that is no component type.
std::size_t bytesOf(ComponentType type) {
    switch (type) {
    case ComponentType::Byte:
    case ComponentType::UnsignedByte:
        return 1;
    case ComponentType::Short:
    case ComponentType::UnsignedShort:
        return 2;
    case ComponentType::UnsignedInt:
    case ComponentType::Float:
        return 4;
    }
    return 0;
}

bool isUnsigned(ComponentType type) {
    return type == ComponentType::UnsignedByte || type == ComponentType::UnsignedShort ||
           type == ComponentType::UnsignedInt;
}

ComponentType readComponentType(const JsonNode &node) {
    const auto type = static_cast<ComponentType>(static_cast<int>(node.wholeNumber({0, 65535})));
    if (bytesOf(type) == 0)
        node.refuse("5120, 5121, 5122, 5123, 5125 or 5126");
    return type;
}

template <class Number> Number load(const std::byte *bytes) {
    Number number;
    std::memcpy(&number, bytes, sizeof(number));
    return number;
}

/// glTF 2.0, section 3.6.2.2.
float decoded(const std::byte *bytes, ComponentType type, bool isNormalized) {
    const auto scaled = [&](float number, float most) {
        return isNormalized ? std::max(number / most, -1.0f) : number;
    };
    switch (type) {
    case ComponentType::Byte:
        return scaled(load<std::int8_t>(bytes), 127.0f);
    case ComponentType::UnsignedByte:
        return scaled(load<std::uint8_t>(bytes), 255.0f);
    case ComponentType::Short:
        return scaled(load<std::int16_t>(bytes), 32767.0f);
    case ComponentType::UnsignedShort:
        return scaled(load<std::uint16_t>(bytes), 65535.0f);
    case ComponentType::UnsignedInt:
        return static_cast<float>(load<std::uint32_t>(bytes));
    case ComponentType::Float:
        return load<float>(bytes);
    }
    return 0.0f;
}

std::uint32_t decodedWhole(const std::byte *bytes, ComponentType type) {
    return type == ComponentType::UnsignedByte    ? load<std::uint8_t>(bytes)
           : type == ComponentType::UnsignedShort ? load<std::uint16_t>(bytes)
                                                  : load<std::uint32_t>(bytes);
}

} // namespace

void Accessor::readHeader(const Buffers &buffers) {
    const JsonObject object(node_);
    componentType_ = readComponentType(object.at("componentType"));
    componentBytes_ = bytesOf(componentType_);
    isUnsigned_ = isUnsigned(componentType_);
    isNormalized_ = object.boolean("normalized", false);
    const JsonNode typeNode = object.at("type");
    std::vector<std::string_view> names;
    names.reserve(types.size());
    for (const Type &type : types)
        names.push_back(type.name);
    const Type &type = types[typeNode.indexOfName(names)];
    type_ = type.name;
    rowCount_ = type.rowCount;
    componentCount_ = type.rowCount * type.columnCount;
    const std::size_t packed = type.rowCount * componentBytes_;
    columnBytes_ = type.columnCount == 1 ? packed : (packed + 3) / 4 * 4;
    const JsonNode countNode = object.at("count");
    count_ = static_cast<std::size_t>(countNode.wholeNumber({1.0, 4294967295.0}));
    if (!object.find("bufferView") && count_ > MemoryBudget::base / 64 + 64 * buffers.document().sizeBytes())
        countNode.fail(
            fmt::format("{} elements without a buffer view are more than such a file may have", count_));
}

std::span<const std::byte> Accessor::elementsIn(Buffers &buffers, const JsonObject &object, std::size_t count,
                                                std::size_t elementBytes, std::size_t &stride) {
    const JsonNode viewNode = object.at("bufferView");
    const BufferView view = buffers.view(buffers.document().reference(viewNode, "bufferViews"));
    stride = view.stride != 0 ? view.stride : elementBytes;
    const auto offset = object.integer<std::size_t>("byteOffset", byteCount, std::size_t{0});
    if (offset > view.bytes.size())
        object.at("byteOffset").refuse(fmt::format("at most {}, the length of the view", view.bytes.size()));
    const std::size_t available = view.bytes.size() - offset;
    if (elementBytes > available || (count - 1) > (available - elementBytes) / stride)
        viewNode.fail(fmt::format("{} elements of {} bytes, {} apart from byte {} on, do not fit in the {} "
                                  "bytes of the view",
                                  count, elementBytes, stride, offset, view.bytes.size()));
    return view.bytes.subspan(offset);
}

void Accessor::readSparse(Buffers &buffers, const JsonObject &sparse) {
    const JsonNode countNode = sparse.at("count");
    const auto count = static_cast<std::size_t>(countNode.wholeNumber({1.0, static_cast<double>(count_)}));
    const JsonNode indicesNode = sparse.at("indices");
    const JsonObject indices(indicesNode);
    const ComponentType indexType = readComponentType(indices.at("componentType"));
    if (!isUnsigned(indexType))
        indices.at("componentType").refuse("5121, 5123 or 5125");
    const std::size_t indexBytes = bytesOf(indexType);
    std::size_t stride = 0;
    const auto indexData = elementsIn(buffers, indices, count, indexBytes, stride);
    buffers.memoryBudget().take(count * sizeof(std::uint32_t), node_);
    Sparse read;
    read.indices.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t index = decodedWhole(indexData.data() + i * stride, indexType);
        if (index >= count_ || (i > 0 && index <= read.indices.back()))
            indicesNode.fail(fmt::format("found index {} at place {}; allowed: ascending ones below {}",
                                         index, i, count_));
        read.indices.push_back(index);
    }
    std::size_t valueStride = 0;
    const std::size_t elementBytes = columnBytes_ * (componentCount_ / rowCount_);
    read.values = elementsIn(buffers, JsonObject(sparse.at("values")), count, elementBytes, valueStride);
    sparse_ = std::move(read);
}

Accessor::Accessor(Buffers &buffers, std::size_t index) : node_(buffers.document().at("accessors", index)) {
    readHeader(buffers);
    const JsonObject object(node_);
    const std::size_t elementBytes = columnBytes_ * (componentCount_ / rowCount_);
    if (object.find("bufferView"))
        bytes_ = elementsIn(buffers, object, count_, elementBytes, stride_);
    if (const std::optional<JsonNode> sparse = object.find("sparse"))
        readSparse(buffers, JsonObject(*sparse));
}

Accessor::Accessor(Buffers &buffers, std::size_t index, std::vector<float> numbers)
    : node_(buffers.document().at("accessors", index)) {
    readHeader(buffers);
    componentBytes_ = sizeof(float);
    componentType_ = ComponentType::Float;
    columnBytes_ = rowCount_ * sizeof(float);
    isNormalized_ = false;
    stride_ = componentCount_ * sizeof(float);
    own_ = std::move(numbers);
    bytes_ = std::as_bytes(std::span(own_));
    requireCount(own_.size() / componentCount_);
}

const std::byte *Accessor::at(std::size_t element, std::size_t component) const {
    const std::size_t place = component / rowCount_ * columnBytes_ + component % rowCount_ * componentBytes_;
    if (sparse_) {
        const auto replaced = std::ranges::lower_bound(sparse_->indices, element);
        if (replaced != sparse_->indices.end() && *replaced == element)
            return sparse_->values.data() +
                   static_cast<std::size_t>(replaced - sparse_->indices.begin()) *
                       (columnBytes_ * (componentCount_ / rowCount_)) +
                   place;
    }
    return bytes_.empty() ? nullptr : bytes_.data() + element * stride_ + place;
}

float Accessor::number(std::size_t element, std::size_t component) const {
    const std::byte *const bytes = at(element, component);
    const float number = bytes == nullptr ? 0.0f : decoded(bytes, componentType_, isNormalized_);
    if (!std::isfinite(number))
        node_.fail(fmt::format("component {} of element {} is {}; allowed: finite numbers", component,
                               element, number));
    return number;
}

std::uint32_t Accessor::whole(std::size_t element, std::size_t component) const {
    if (!own_.empty())
        return static_cast<std::uint32_t>(std::clamp(number(element, component), 0.0f, 4.0e9f));
    const std::byte *const bytes = at(element, component);
    return bytes == nullptr ? 0 : decodedWhole(bytes, componentType_);
}

glm::vec2 Accessor::vec2(std::size_t element) const { return {number(element, 0), number(element, 1)}; }

glm::vec3 Accessor::vec3(std::size_t element) const {
    return {number(element, 0), number(element, 1), number(element, 2)};
}

glm::vec4 Accessor::vec4(std::size_t element) const {
    return {number(element, 0), number(element, 1), number(element, 2), number(element, 3)};
}

void Accessor::requireType(std::span<const std::string_view> types) const {
    if (std::ranges::find(types, type_) == types.end())
        JsonObject(node_).at("type").refuse(fmt::format("{} for this use", quotedList(types)));
}

void Accessor::requireUnsigned() const {
    if (!isUnsigned_)
        JsonObject(node_).at("componentType").refuse("5121, 5123 or 5125 for this use");
}

void Accessor::requireCount(std::size_t count) const {
    if (count_ != count)
        JsonObject(node_).at("count").refuse(fmt::format("{}, as its fellows have", count));
}

} // namespace hyalite::core::gltf
