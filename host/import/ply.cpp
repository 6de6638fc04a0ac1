#include "host/import/ply.h"

#include "host/base/error.h"
#include "host/image/tone_curve.h"
#include "host/import/file_finder.h"
#include "host/import/mesh_builder.h"
#include "host/import/obj_lines.h"
#include "host/import/obj_statement.h"
#include "host/import/ply_header.h"
#include "host/import/ply_values.h"
#include "host/import/whole_file.h"
#include "host/scene/origin.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace hyalite::core {
namespace {

/// Uses of a vertex's values. Each set is wanted as a whole.
enum Role : std::size_t { X, Y, Z, NormalX, NormalY, NormalZ, U, V, Red, Green, Blue, Alpha, roleCount };
constexpr std::size_t unusedRole = roleCount;

struct RoleName {
    std::string_view name;
    Role role;
};
constexpr RoleName roleNames[] = {{"x", X},
                                  {"y", Y},
                                  {"z", Z},
                                  {"nx", NormalX},
                                  {"ny", NormalY},
                                  {"nz", NormalZ},
                                  {"s", U},
                                  {"t", V},
                                  {"u", U},
                                  {"v", V},
                                  {"texture_u", U},
                                  {"texture_v", V},
                                  {"texture_s", U},
                                  {"texture_t", V},
                                  {"red", Red},
                                  {"green", Green},
                                  {"blue", Blue},
                                  {"r", Red},
                                  {"g", Green},
                                  {"b", Blue},
                                  {"diffuse_red", Red},
                                  {"diffuse_green", Green},
                                  {"diffuse_blue", Blue},
                                  {"alpha", Alpha},
                                  {"a", Alpha},
                                  {"diffuse_alpha", Alpha}};

/// How the values of a row, of a vertex or a face, are used.
struct RowPlan {
    std::vector<std::size_t> roles; ///< of each property
    bool hasPosition = false;
    bool hasNormal = false;
    bool hasUv = false;
    bool hasColour = false;
    bool hasAlpha = false;
    double colourScale = 1.0; ///< to [0, 1]
    bool isSrgb = false;
};

RowPlan planRow(const PlyElement &element) {
    RowPlan plan;
    std::array<const PlyProperty *, roleCount> given{};
    for (const PlyProperty &property : element.properties) {
        const auto *const known = std::ranges::find(roleNames, property.name, &RoleName::name);
        const bool isUsed = known != std::end(roleNames) && !property.isList && given[known->role] == nullptr;
        if (isUsed)
            given[known->role] = &property;
        plan.roles.push_back(isUsed ? known->role : unusedRole);
    }
    const auto hasAll = [&](Role first, Role last) {
        return std::all_of(given.begin() + first, given.begin() + last + 1,
                           [](const PlyProperty *property) { return property != nullptr; });
    };
    plan.hasPosition = hasAll(X, Z);
    plan.hasNormal = hasAll(NormalX, NormalZ);
    plan.hasUv = hasAll(U, V);
    plan.hasColour = hasAll(Red, Blue);
    plan.hasAlpha = plan.hasColour && hasAll(Alpha, Alpha);
    if (plan.hasColour && isWhole(given[Red]->type)) {
        constexpr double largest[] = {255.0, 255.0, 32767.0, 65535.0, 2147483647.0, 4294967295.0};
        plan.isSrgb = true;
        plan.colourScale = 1.0 / largest[static_cast<std::size_t>(given[Red]->type)];
    }
    return plan;
}

/// Of a colour or alpha. meshio declares bytes as int8: those below 0 are above 127.
double wrapped(double value, const RowPlan &plan) {
    return plan.isSrgb && plan.colourScale == 1.0 / 255.0 && value < 0.0 ? value + 256.0 : value;
}

float linearColour(double found, const RowPlan &plan) {
    const double value = wrapped(found, plan);
    const double share = std::clamp(value * plan.colourScale, 0.0, 1.0);
    if (!plan.isSrgb)
        return share > 0.0 ? static_cast<float>(share) : 0.0f; // and NaN is 0
    if (plan.colourScale == 1.0 / 255.0)
        return srgbDecodedLevels()[static_cast<std::size_t>(std::clamp(value, 0.0, 255.0))];
    return static_cast<float>(srgbDecoded(share));
}

/// Reads the elements of a body. Values is PlyTextValues or PlyByteValues.
template <class Values> class PlyReader {
  public:
    PlyReader(const PlyHeader &header, Values values, MeshBuilder &builder, const std::string &fileName,
              const OnReading &onReading)
        : header_(header), values_(std::move(values)), builder_(builder), fileName_(fileName),
          onReading_(onReading) {}

    void read() {
        for (const PlyElement &element : header_.elements)
            if (element.name == "vertex") {
                vertexCount_ = element.count;
                plan_ = planRow(element);
                if (!plan_.hasPosition)
                    throw Error(ErrorKind::BadInput,
                                fileName_ + ": vertices lack one of the properties x, y and z");
            }
        for (const PlyElement &element : header_.elements) {
            if (element.properties.empty())
                continue; // it has no bytes
            tellUnused(element);
            if (element.name == "vertex") {
                requireRoom(element);
                readVertices(element);
                continue;
            }
            try {
                if (element.name == "face")
                    readFaces(element);
                else if (element.name == "tristrips")
                    readStrips(element);
                else
                    skip(element);
            } catch (const PlyCutShort &cut) {
                if (!hasVertices_ || builder_.report().faceCount == 0)
                    throw;
                builder_.losses().add("cut", [&] {
                    return fmt::format("{}; what is there is rendered, {} of {} rows", cut.what(), rowCount_,
                                       element.count);
                });
                return;
            }
        }
    }

  private:
    /// Warns of elements and properties that are not used.
    void tellUnused(const PlyElement &element) {
        const bool isRead = element.name == "vertex" || element.name == "face" || element.name == "tristrips";
        if (!isRead && element.count > 0)
            builder_.losses().add("element", [&] {
                return fmt::format("{}: the element {} is left out", fileName_, quoteInput(element.name));
            });
        constexpr std::string_view usedOfFaces[] = {"vertex_indices", "vertex_index", "texcoord",
                                                    "texnumber"};
        for (const PlyProperty &property : element.properties) {
            const auto *const row = std::ranges::find(roleNames, property.name, &RoleName::name);
            const bool isUsed = row != std::end(roleNames) && (element.name == "vertex" || row->role >= Red);
            const bool isOfFace = element.name != "vertex" &&
                                  std::ranges::find(usedOfFaces, property.name) != std::end(usedOfFaces);
            if (isRead && !isUsed && !isOfFace)
                builder_.losses().add("property", [&] {
                    return fmt::format("{}: the property {} of the element {} is left out", fileName_,
                                       quoteInput(property.name), quoteInput(element.name));
                });
        }
    }

    /// Refuses a count that the file cannot hold, before anything is allocated.
    void requireRoom(const PlyElement &element) const {
        const std::size_t rowBytes = Values::minRowBytes(element);
        const std::uint64_t most = values_.bytesLeft() / rowBytes + 1; // the last line may lack its end
        if (element.count > most)
            throw Error(
                ErrorKind::BadInput,
                fmt::format("{}: the header announces {} rows of the element {}, each of at least {} bytes, "
                            "but {} bytes are left for them: the file is damaged or cut short",
                            fileName_, element.count, quoteInput(element.name), rowBytes,
                            values_.bytesLeft()));
    }

    template <class Read> void forEachRow(const PlyElement &element, const Read &read) {
        constexpr std::uint64_t stepRows = 65536;
        for (std::uint64_t &row = rowCount_ = 0; row < element.count; ++row) {
            if (onReading_ && row % stepRows == stepRows - 1)
                onReading_(static_cast<double>(values_.bytesRead()) /
                           static_cast<double>(values_.bytesRead() + values_.bytesLeft()));
            values_.beginRow(element);
            read();
            if (values_.endRow())
                builder_.losses().add("surplus", [&] {
                    return fmt::format("{}what stands behind the values of the element {} is left out",
                                       placeText(fileName_, Values::unit, values_.place()),
                                       quoteInput(element.name));
                });
        }
    }

    std::size_t readLength(const PlyProperty &property) {
        const double length = values_.next(property.countType);
        if (length < 0.0 || length > 4294967295.0 || length != std::floor(length))
            values_.fail(fmt::format("a list has the length {}", length));
        return static_cast<std::size_t>(length);
    }

    void skipValue(const PlyProperty &property) {
        values_.skip(property.type, property.isList ? readLength(property) : 1);
    }

    void skip(const PlyElement &element) {
        forEachRow(element, [&] {
            std::ranges::for_each(element.properties, [&](const auto &property) { skipValue(property); });
        });
        builder_.report().unusedStatementCount += element.count;
    }

    void readVertices(const PlyElement &element) {
        builder_.reserve(element.count, 0);
        std::array<double, roleCount + 1> found{};
        forEachRow(element, [&] {
            for (std::size_t i = 0; i < element.properties.size(); ++i) {
                const PlyProperty &property = element.properties[i];
                if (property.isList)
                    skipValue(property);
                else
                    found[plan_.roles[i]] = values_.next(property.type);
            }
            builder_.addPosition({found[X], found[Y], found[Z]}, values_.place());
            if (plan_.hasNormal)
                builder_.addNormal({found[NormalX], found[NormalY], found[NormalZ]});
            if (plan_.hasUv)
                builder_.addUv({found[U], found[V]});
            if (plan_.hasColour && header_.textureFiles.empty())
                builder_.setColour(colourOf(found, plan_));
        });
        if (plan_.hasColour && !header_.textureFiles.empty())
            builder_.losses().add("colours", [&] {
                return fileName_ + ": colours of vertices are left out, as the mesh has a texture";
            });
        hasVertices_ = true;
    }

    /// Linear. Warns of transparency.
    glm::vec3 colourOf(const std::array<double, roleCount + 1> &found, const RowPlan &plan) {
        if (plan.hasAlpha && wrapped(found[Alpha], plan) * plan.colourScale < 1.0)
            builder_.losses().add("alpha", [&] {
                return fmt::format("{}alpha is left out: colours are opaque",
                                   placeText(fileName_, Values::unit, values_.place()));
            });
        return {linearColour(found[Red], plan), linearColour(found[Green], plan),
                linearColour(found[Blue], plan)};
    }

    /// Of a face or a strip, the property with the corners. Throws Error{BadInput} if there is none.
    const PlyProperty &indicesOf(const PlyElement &element) const {
        for (const PlyProperty &property : element.properties)
            if (property.isList && (property.name == "vertex_indices" || property.name == "vertex_index")) {
                if (!isWhole(property.type))
                    throw Error(ErrorKind::BadInput,
                                fmt::format("{}: the list {} is of floats; allowed are whole numbers",
                                            fileName_, quoteInput(property.name)));
                return property;
            }
        throw Error(ErrorKind::BadInput,
                    fmt::format("{}: the element {} has no list vertex_indices or vertex_index", fileName_,
                                quoteInput(element.name)));
    }

    /// How many triangles the rows have, at most: what a byte or two ask for is allocated once. Text is longer.
    std::size_t countTriangles(const PlyElement &element, const PlyProperty &indices) const {
        if constexpr (Values::unit == PlaceUnit::Line)
            return 0;
        const OnReading nobody; // outlives the reader, which refers to it
        PlyReader ahead(header_, values_, builder_, fileName_, nobody);
        std::size_t count = 0;
        try {
            ahead.forEachRow(element, [&] {
                for (const PlyProperty &property : element.properties) {
                    const std::size_t length = property.isList ? ahead.readLength(property) : 1;
                    ahead.values_.skip(property.type, length);
                    if (&property == &indices && length > 2)
                        count += length - 2;
                }
            });
        } catch (const PlyCutShort &) { // as will be seen once more
        }
        return count;
    }

    FaceCorner corner(double index) const {
        if (index < 0.0 || index >= static_cast<double>(vertexCount_))
            values_.fail(fmt::format("the face has the vertex index {}; the file has {} vertices, from 0 on",
                                     index, vertexCount_));
        const auto fromOne = static_cast<std::int32_t>(index) + 1;
        return {fromOne, plan_.hasNormal ? fromOne : 0, plan_.hasUv ? fromOne : 0};
    }

    void readFaces(const PlyElement &element) {
        const PlyProperty &indices = indicesOf(element);
        builder_.reserve(0, countTriangles(element, indices));
        const RowPlan plan = planRow(element);
        std::array<double, roleCount + 1> found{};
        std::vector<FaceCorner> corners;
        std::vector<double> uvs;
        builder_.setMaterial(header_.textureFiles.empty() ? 0 : 1);
        forEachRow(element, [&] {
            uvs.clear();
            for (std::size_t i = 0; i < element.properties.size(); ++i) {
                const PlyProperty &property = element.properties[i];
                if (&property == &indices)
                    readCorners(property, corners);
                else if (property.isList && property.name == "texcoord")
                    readNumbers(property, uvs);
                else if (property.isList)
                    skipValue(property);
                else if (property.name == "texnumber")
                    useTexture(values_.next(property.type));
                else
                    found[plan.roles[i]] = values_.next(property.type);
            }
            if (plan.hasColour)
                builder_.setFaceColour(colourOf(found, plan));
            addFace(corners, uvs);
        });
    }

    /// -1 and other numbers without a texture: none.
    void useTexture(double number) {
        const bool isKnown = number >= 0.0 && number < static_cast<double>(header_.textureFiles.size());
        builder_.setMaterial(isKnown ? static_cast<std::uint32_t>(number) + 1 : 0);
    }

    void readCorners(const PlyProperty &property, std::vector<FaceCorner> &corners) {
        corners.clear();
        const std::size_t length = readLength(property);
        if (length > maxFaceCorners)
            values_.fail(fmt::format("the face has {} corners; allowed are 3 to {}", length, maxFaceCorners));
        for (std::size_t i = 0; i < length; ++i)
            corners.push_back(corner(values_.next(property.type)));
    }

    void readNumbers(const PlyProperty &property, std::vector<double> &numbers) {
        const std::size_t length = readLength(property);
        if (length > 2 * maxFaceCorners)
            values_.fail(fmt::format("the face has {} texture coordinates", length));
        for (std::size_t i = 0; i < length; ++i)
            numbers.push_back(values_.next(property.type));
    }

    void addFace(std::vector<FaceCorner> &corners, const std::vector<double> &uvs) {
        const auto firstUv = static_cast<std::int32_t>(builder_.uvCount()) + 1;
        // Those of vertices have the first places, so vertices must have come.
        if (hasVertices_ && uvs.size() == 2 * corners.size())
            for (std::size_t i = 0; i < corners.size(); ++i) {
                builder_.addUv({uvs[2 * i], uvs[2 * i + 1]});
                corners[i].uv = firstUv + static_cast<std::int32_t>(i);
            }
        builder_.addFace(corners, values_.place());
    }

    /// Each corner of a strip makes a triangle with the two before it; every other one is turned, so that all face the
    /// same way.
    void readStrips(const PlyElement &element) {
        const PlyProperty &indices = indicesOf(element);
        builder_.reserve(0, countTriangles(element, indices));
        forEachRow(element, [&] {
            for (const PlyProperty &property : element.properties)
                if (&property == &indices)
                    readStrip(property);
                else
                    skipValue(property);
        });
    }

    void readStrip(const PlyProperty &property) {
        std::array<FaceCorner, 3> triangle{};
        std::size_t count = 0; // of the strip's corners so far
        for (std::size_t left = readLength(property); left > 0; --left) {
            const double index = values_.next(property.type);
            if (index == -1.0) {
                count = 0;
                continue;
            }
            triangle = {triangle[1], triangle[2], corner(index)};
            ++count;
            if (count < 3)
                continue;
            std::array<FaceCorner, 3> turned = triangle;
            if (count % 2 == 0)
                std::swap(turned[0], turned[1]);
            builder_.addFace(turned, values_.place());
        }
    }

    const PlyHeader &header_;
    Values values_;
    MeshBuilder &builder_;
    const std::string &fileName_;
    const OnReading &onReading_;
    std::uint64_t vertexCount_ = 0;
    bool hasVertices_ = false;   ///< they are read
    RowPlan plan_;               ///< of vertices
    std::uint64_t rowCount_ = 0; ///< of the element that is read
};

bool isPointCloud(const PlyHeader &header) {
    return std::ranges::none_of(header.elements, [](const PlyElement &element) {
        return element.count > 0 && (element.name == "face" || element.name == "tristrips");
    });
}

void requireFaces(const PlyHeader &header, const std::string &fileName) {
    const auto vertices = std::ranges::find(header.elements, "vertex", &PlyElement::name);
    if (vertices == header.elements.end())
        throw Error(ErrorKind::BadInput, fileName + ": there is no element \"vertex\"");
    if (vertices->count >= std::numeric_limits<std::int32_t>::max())
        throw Error(ErrorKind::BadInput, fmt::format("{}: there are {} vertices; allowed are fewer than 2^31",
                                                     fileName, vertices->count));
    if (isPointCloud(header))
        throw Error(
            ErrorKind::BadInput,
            fmt::format("{}: a point cloud, {} vertices without faces; surfaces are rendered: make a mesh "
                        "of it first, by surface reconstruction",
                        fileName, vertices->count));
}

/// A material for each texture of the header. One whose picture cannot be had is neutral.
std::vector<Material> texturedMaterials(const PlyHeader &header, const std::filesystem::path &file,
                                        TextureLibrary *textures, Losses &losses) {
    std::vector<Material> materials;
    if (textures == nullptr)
        return materials;
    FileFinder files(folderOf(file));
    for (const std::string &name : header.textureFiles) {
        Material &material = materials.emplace_back();
        material.name = name;
        material.twoSided = true;
        material.albedo = glm::vec3(0.8f);
        const auto lose = [&](std::string_view kind, std::string_view reason) {
            losses.add(kind, [&] {
                return fmt::format("{}: TextureFile {} is left out: {}", file.string(), quoteInput(name),
                                   reason);
            });
        };
        const std::optional<std::filesystem::path> image = files.find(files.folder(), name);
        if (!image) {
            lose("no texture", "there is no such file in the mesh's folder");
            continue;
        }
        try {
            material.textures[layout::slotBaseColour] = TextureUse{.textureIndex = textures->load(*image)};
            material.albedo = glm::vec3(1.0f);
        } catch (const Error &error) {
            if (error.kind != ErrorKind::BadInput)
                throw;
            lose("damaged texture", error.what());
        }
    }
    return materials;
}

} // namespace

ObjMesh loadPly(const std::filesystem::path &file, const MeshTransform &transform, const OnReading &onReading,
                TextureLibrary *textures) {
    const std::string fileName = file.string();
    const std::vector<char> bytes = readWholeFile(file);
    const PlyHeader header = readPlyHeader(bytes, fileName);
    requireFaces(header, fileName);
    const std::span<const char> body = std::span(bytes).subspan(header.bodyOffset);
    const bool isText = header.format == PlyFormat::Text;
    return readNear([&](const glm::dvec3 &origin) {
        MeshBuilder builder(fileName, transform, origin, isText ? PlaceUnit::Line : PlaceUnit::Byte);
        builder.report().files.push_back(file);
        const auto read = [&](auto values) {
            PlyReader(header, std::move(values), builder, fileName, onReading).read();
        };
        if (isText)
            read(PlyTextValues(body, header.bodyLine, fileName));
        else
            read(PlyByteValues(body, header.bodyOffset, header.format == PlyFormat::BigEndian, fileName));
        std::vector<Material> materials = texturedMaterials(header, file, textures, builder.losses());
        ObjMesh loaded = builder.finish();
        loaded.materials = std::move(materials);
        if (loaded.materials.empty())
            loaded.mesh.triangleMaterials.clear();
        leaveOutUselessTextures(loaded);
        return loaded;
    });
}

MeshFile readPlyMeshes(const std::filesystem::path &file, const MeshOptions &options) {
    return meshFileOf(loadPly(file, options.transform, options.onReading, options.textures));
}

} // namespace hyalite::core
