#include "host/import/gltf/draco.h"

#include <draco/compression/decode.h>
#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>

namespace hyalite::core::gltf {
namespace {

std::unique_ptr<draco::Mesh> decodeMesh(std::span<const std::byte> bytes, const JsonNode &view) {
    draco::DecoderBuffer input;
    input.Init(reinterpret_cast<const char *>(bytes.data()), bytes.size());
    const auto type = draco::Decoder::GetEncodedGeometryType(&input);
    if (!type.ok() || type.value() != draco::TRIANGULAR_MESH)
        view.fail("its data is not a Draco mesh");
    draco::Decoder decoder;
    auto decoded = decoder.DecodeMeshFromBuffer(&input);
    if (!decoded.ok())
        view.fail(fmt::format("its Draco data is damaged: {}", decoded.status().error_msg_string()));
    return std::move(decoded).value();
}

/// The factor that normalised integers still want.
float normalisation(const draco::PointAttribute &attribute, const JsonObject &accessor) {
    if (!accessor.boolean("normalized", false) || attribute.normalized())
        return 1.0f;
    switch (attribute.data_type()) {
    case draco::DT_INT8:
        return 1.0f / 127.0f;
    case draco::DT_UINT8:
        return 1.0f / 255.0f;
    case draco::DT_INT16:
        return 1.0f / 32767.0f;
    case draco::DT_UINT16:
        return 1.0f / 65535.0f;
    default:
        return 1.0f;
    }
}

std::vector<float> valuesOf(const draco::PointAttribute &attribute, std::uint32_t pointCount, float factor) {
    const auto componentCount = static_cast<std::size_t>(attribute.num_components());
    std::vector<float> numbers(pointCount * componentCount);
    for (std::uint32_t point = 0; point < pointCount; ++point) {
        const draco::AttributeValueIndex index = attribute.mapped_index(draco::PointIndex(point));
        float *const first = numbers.data() + point * componentCount;
        attribute.ConvertValue<float>(index, attribute.num_components(), first);
        for (std::size_t i = 0; i < componentCount; ++i)
            first[i] *= factor;
    }
    return numbers;
}

void requireIndexCount(Buffers &buffers, const JsonObject &primitive, const draco::Mesh &mesh) {
    const auto index = buffers.document().reference(primitive, "indices", "accessors");
    if (!index)
        return;
    const JsonObject accessor(buffers.document().at("accessors", *index));
    const JsonNode count = accessor.at("count");
    if (count.wholeNumber(byteCount) != 3.0 * mesh.num_faces())
        count.refuse(fmt::format("{}, as the Draco data has", std::uint64_t{3} * mesh.num_faces()));
}

} // namespace

DracoMesh decodeDraco(Buffers &buffers, const JsonObject &primitive, const JsonObject &extension) {
    const Document &document = buffers.document();
    const JsonNode viewNode = extension.at("bufferView");
    const BufferView view = buffers.view(document.reference(viewNode, "bufferViews"));
    const std::unique_ptr<draco::Mesh> mesh = decodeMesh(view.bytes, viewNode);
    requireIndexCount(buffers, primitive, *mesh);
    buffers.memoryBudget().take(
        std::uint64_t{mesh->num_faces()} * 12 + std::uint64_t{mesh->num_points()} * 64, viewNode);
    DracoMesh decoded;
    const JsonObject accessors(primitive.at("attributes"));
    for (const auto &[name, id] : JsonObject(extension.at("attributes")).members(1024)) {
        const auto uniqueId = static_cast<std::uint32_t>(id.wholeNumber({0.0, 4294967295.0}));
        const draco::PointAttribute *const attribute = mesh->GetAttributeByUniqueId(uniqueId);
        if (attribute == nullptr)
            id.fail(fmt::format("the Draco data has no attribute {}", uniqueId));
        const std::size_t index = document.reference(accessors.at(name), "accessors");
        const float factor = normalisation(*attribute, JsonObject(document.at("accessors", index)));
        Accessor accessor(buffers, index, valuesOf(*attribute, mesh->num_points(), factor));
        if (accessor.componentCount() != static_cast<std::size_t>(attribute->num_components()))
            id.fail(fmt::format("the Draco data has {} numbers a vertex, the accessor {}",
                                attribute->num_components(), accessor.componentCount()));
        decoded.attributes.emplace(name, std::move(accessor));
    }
    for (std::uint32_t face = 0; face < mesh->num_faces(); ++face)
        for (const draco::PointIndex &point : mesh->face(draco::FaceIndex(face))) {
            if (point.value() >= mesh->num_points())
                viewNode.fail("its Draco data names a vertex that it has not");
            decoded.indices.push_back(point.value());
        }
    // Attributes that are not compressed stand beside those that are.
    for (const auto &[name, member] : accessors.members(1024))
        if (!decoded.attributes.contains(name))
            decoded.attributes.emplace(name, Accessor(buffers, document.reference(member, "accessors")));
    for (const auto &[name, accessor] : decoded.attributes)
        accessor.requireCount(mesh->num_points());
    return decoded;
}

} // namespace hyalite::core::gltf
