#include "host/import/gltf/contents.h"

#include "host/import/gltf/animation.h"
#include "host/import/gltf/extensions.h"
#include "host/import/gltf/image_based_light.h"
#include "host/import/gltf/instancing.h"
#include "host/import/gltf/lights.h"
#include "host/import/gltf/materials.h"
#include "host/import/gltf/meshes.h"
#include "host/import/gltf/skins.h"
#include "host/import/transform_json.h"
#include "host/scene/instances.h"
#include "host/scene/limits.h"
#include "host/scene/origin.h"

#include <fmt/format.h>

#include <glm/common.hpp>
#include <glm/mat3x3.hpp>

#include <algorithm>
#include <iterator>
#include <map>
#include <span>
#include <utility>

namespace hyalite::core::gltf {
namespace {

/// Meshes that are the same except for their place: by index and weights of morph targets.
struct MeshUse {
    std::size_t mesh;
    Deformation deformation;
    std::vector<glm::dmat4x3> places; ///< none for a skin, whose mesh is in world space
    std::vector<std::uint32_t> nodes; ///< of each place, or of the skin
};

bool isFlat(const glm::dmat4x3 &map) { return determinant(toPlacement(map)) == 0.0; }

void requireInRange(const glm::dmat4x3 &map, const JsonNode &node) {
    for (glm::length_t column = 0; column < 4; ++column)
        for (glm::length_t row = 0; row < 3; ++row)
            if (!limits::coordinate.contains(map[column][row]))
                node.fail(fmt::format("brings its mesh beyond coordinates {}", limits::coordinate.text()));
}

/// The boxes of meshes by the bounds that the file states of their positions.
class StatedBounds {
  public:
    explicit StatedBounds(const Document &document) : document_(document), boxes_(document.count("meshes")) {}

    /// Adds the corners of the mesh's box at each place. Returns whether the points so far are far.
    bool add(std::size_t mesh, const std::vector<glm::dmat4x3> &places, OriginFinder &finder) {
        if (!boxes_[mesh])
            boxes_[mesh] = read(mesh);
        const Bounds &box = *boxes_[mesh];
        const auto addAt = [&](const glm::dmat4x3 &place) { return finder.addBox(box, place); };
        return !(box.low.x <= box.high.x) || std::ranges::all_of(places, addAt);
    }

  private:
    [[nodiscard]] Bounds read(std::size_t mesh) const {
        Bounds box = noBounds;
        for (const JsonNode &primitive : elementsOf(JsonObject(document_.at("meshes", mesh)), "primitives")) {
            const JsonObject attributes(JsonObject(primitive).at("attributes"));
            const auto positions = document_.reference(attributes, "POSITION", "accessors");
            if (!positions)
                continue;
            const nlohmann::json &accessor = *document_.at("accessors", *positions).value;
            const auto low = statedPoint(accessor, "min");
            const auto high = statedPoint(accessor, "max");
            if (low && high) {
                box.low = glm::min(box.low, *low);
                box.high = glm::max(box.high, *high);
            }
        }
        return box;
    }

    /// Nothing where the file states no point. Of normalised integers it states what they are before.
    static std::optional<glm::dvec3> statedPoint(const nlohmann::json &accessor, const char *key) {
        if (accessor.value("normalized", nlohmann::json()) == true)
            return glm::dvec3(*key == 'm' && key[1] == 'i' ? -1.0 : 1.0);
        const auto point = accessor.find(key);
        const auto isNumber = [](const nlohmann::json &number) { return number.is_number(); };
        if (point == accessor.end() || !point->is_array() || point->size() != 3 ||
            !std::ranges::all_of(*point, isNumber))
            return std::nullopt;
        return glm::dvec3((*point)[0].get<double>(), (*point)[1].get<double>(), (*point)[2].get<double>());
    }

    const Document &document_;
    /// Of meshes that were asked for; empty ones: nothing is stated.
    std::vector<std::optional<Bounds>> boxes_;
};

/// The places of a node's mesh: one, or those of its instances.
std::vector<glm::dmat4x3> placesOf(Buffers &buffers, const JsonObject &node, const glm::dmat4x3 &toWorld) {
    const auto instancing = extensionOf(node, "EXT_mesh_gpu_instancing");
    if (!instancing)
        return {toWorld};
    std::vector<glm::dmat4x3> places = readInstancing(buffers, *instancing);
    for (glm::dmat4x3 &place : places)
        place = composed(toWorld, place);
    return places;
}

/// The origin of the scene at rest; nothing if the file states no bounds.
std::optional<glm::dvec3> restOriginOf(Buffers &buffers, const NodeTree &tree, const std::vector<Pose> &rest,
                                       const std::vector<std::size_t> &nodes, StatedBounds &bounds) {
    const Document &document = buffers.document();
    const std::vector<glm::dmat4x3> toWorld = tree.toWorld(rest);
    OriginFinder finder;
    const auto add = [&](std::size_t index) {
        const JsonObject node(document.at("nodes", index));
        const std::optional<std::size_t> mesh = document.reference(node, "mesh", "meshes");
        if (!mesh)
            return true;
        const auto skin = document.reference(node, "skin", "skins");
        return bounds.add(*mesh,
                          skin ? jointMaps(buffers, *skin, toWorld) : placesOf(buffers, node, toWorld[index]),
                          finder);
    };
    (void)std::ranges::all_of(nodes, add);
    return finder.isEmpty() ? std::nullopt : std::optional(finder.origin());
}

/// Where nodes see meshes.
class MeshUses {
  public:
    MeshUses(Buffers &buffers, const std::vector<Pose> &poses, const std::vector<glm::dmat4x3> &toWorld,
             StatedBounds &bounds)
        : buffers_(buffers), poses_(poses), toWorld_(toWorld), bounds_(bounds) {}

    /// `position` is that of the node in MeshFile::nodes.
    void add(std::size_t index, std::uint32_t position) {
        const Document &document = buffers_.document();
        const JsonNode node = document.at("nodes", index);
        const JsonObject object(node);
        const std::optional<std::size_t> mesh = document.reference(object, "mesh", "meshes");
        if (!mesh)
            return;
        if (const auto skin = document.reference(object, "skin", "skins")) {
            addSkinned(
                {*mesh, {poses_[index].weights, jointMaps(buffers_, *skin, toWorld_)}, {}, {position}});
            return;
        }
        std::vector<glm::dmat4x3> places = placesOf(buffers_, object, toWorld_[index]);
        for (const glm::dmat4x3 &place : places)
            requireInRange(place, node);
        const std::size_t flatCount = std::erase_if(places, isFlat);
        if (flatCount > 0)
            document.losses().add("flattened mesh", [&] {
                return fmt::format("{}: {}: the mesh is flattened to a plane, a line or a point by its "
                                   "transform, and is left out",
                                   document.fileName(), node.path.to_string());
            });
        if (places.empty())
            return;
        const auto [known, isNew] = known_.try_emplace({*mesh, poses_[index].weights}, uses_.size());
        if (isNew)
            uses_.push_back({*mesh, {poses_[index].weights, {}}, {}, {}});
        MeshUse &use = uses_[known->second];
        use.places.insert(use.places.end(), places.begin(), places.end());
        use.nodes.resize(use.places.size(), position);
    }

    [[nodiscard]] const std::vector<MeshUse> &uses() const { return uses_; }

  private:
    void addSkinned(MeshUse use) {
        OriginFinder finder;
        (void)bounds_.add(use.mesh, use.deformation.joints, finder);
        use.deformation.origin = finder.origin();
        for (glm::dmat4x3 &joint : use.deformation.joints)
            joint[3] -= use.deformation.origin;
        uses_.push_back(std::move(use));
    }

    Buffers &buffers_;
    const std::vector<Pose> &poses_;
    const std::vector<glm::dmat4x3> &toWorld_;
    StatedBounds &bounds_;
    std::map<std::pair<std::size_t, std::vector<double>>, std::size_t> known_;
    std::vector<MeshUse> uses_;
};

void addWarnings(const MeshFindings &findings, const std::string &fileName, MeshReport &report) {
    const auto warn = [&](std::size_t count, std::string_view what) {
        if (count > 0)
            report.warnings.push_back(fmt::format("{}: {} {}", fileName, count, what));
    };
    warn(findings.passedOver.points, "primitives of points are passed over");
    warn(findings.passedOver.lines, "primitives of lines are passed over");
    warn(findings.passedOver.empty, "primitives without positions are passed over");
    warn(findings.uvLess,
         "triangles have no texture coordinates that their material wants, and show one texel");
    report.degenerateTriangleCount = findings.degenerateTriangles;
    report.lostNormalCount = findings.lostNormals;
}

void readMeshes(Buffers &buffers, const std::vector<MeshUse> &uses, const OnReading &onReading,
                std::span<const std::uint32_t> shownAs, MeshFile &file) {
    MeshReader reader(buffers, file.materials, shownAs);
    for (std::size_t i = 0; i < uses.size(); ++i) {
        if (onReading)
            onReading(static_cast<double>(i) / static_cast<double>(uses.size()));
        TriangleMesh mesh = reader.read(uses[i].mesh, uses[i].deformation);
        if (mesh.triangles.empty())
            continue;
        MeshReport &report = file.report;
        report.triangleCount += mesh.triangles.size();
        report.vertexCount += mesh.positions.size();
        report.normalCount += mesh.normals.size();
        report.instanceCount += uses[i].places.size() > 1 ? uses[i].places.size() : 0;
        file.meshes.push_back({std::move(mesh), uses[i].places, uses[i].nodes});
    }
    file.report.faceCount = file.report.triangleCount + reader.findings().degenerateTriangles;
    addWarnings(reader.findings(), buffers.document().fileName(), file.report);
}

/// Those of the nodes whose meshes and lights are shown, where some are not: KHR_node_visibility. A node hides all below
/// it, but no camera. Empty: all are shown.
std::optional<std::vector<std::size_t>> nodesShown(const Document &document, const NodeTree &tree,
                                                   const std::vector<std::size_t> &nodes,
                                                   std::size_t nodeCount) {
    std::vector<bool> hides(nodeCount);
    for (std::size_t i = 0; i < nodeCount; ++i) {
        const auto visibility = extensionOf(JsonObject(document.at("nodes", i)), "KHR_node_visibility");
        hides[i] = visibility && !visibility->boolean("visible", true);
    }
    if (std::ranges::find(hides, true) == hides.end())
        return std::nullopt;
    const std::vector<bool> hidden = tree.below(std::move(hides));
    std::vector<std::size_t> shown;
    std::ranges::copy_if(nodes, std::back_inserter(shown), [&](std::size_t node) { return !hidden[node]; });
    return shown;
}

/// Whether one of the nodes that move has a mesh or a light. Joints of a skin may be any node: a mesh with a skin
/// moves.
bool moveMoreThanCameras(const Document &document, const std::vector<std::size_t> &nodes,
                         const std::vector<bool> &moving) {
    return std::ranges::any_of(nodes, [&](std::size_t index) {
        const JsonObject node(document.at("nodes", index));
        return node.find("skin") ||
               (moving[index] && (node.find("mesh") || extensionOf(node, "KHR_lights_punctual") ||
                                  extensionOf(node, "EXT_lights_ies")));
    });
}

/// The contents of a node, for people.
std::string contentsOf(const Document &document, const JsonObject &node) {
    std::string contents;
    const auto add = [&](std::string_view what, std::string_view name, const JsonNode &index) {
        contents += fmt::format("{}{} {}", contents.empty() ? "" : ", ", what, index.wholeNumber(byteCount));
        if (!name.empty())
            contents += fmt::format(" \"{}\"", name);
    };
    for (const auto &[key, array] :
         {std::pair{"mesh", "meshes"}, std::pair{"camera", "cameras"}, std::pair{"skin", "skins"}})
        if (const auto index = document.reference(node, key, array))
            add(key, nameOf(JsonObject(document.at(array, *index))), node.at(key));
    if (const auto light = extensionOf(node, "KHR_lights_punctual"))
        add("light", "", light->at("light"));
    if (const auto light = extensionOf(node, "EXT_lights_ies"))
        add("profile", "", light->at("light"));
    return contents;
}

/// The nodes with a mesh at or below them, parents before their children.
struct NamedNodes {
    std::vector<SceneNode> nodes{};
    std::vector<std::uint32_t> positions; ///< of each node of the file, in `nodes`; or noNode
};

NamedNodes namedNodesOf(const Document &document, const NodeTree &tree,
                        const std::vector<std::size_t> &nodes) {
    std::vector<bool> isNamed(document.count("nodes"), false);
    for (std::size_t i = nodes.size(); i-- > 0;) {
        const std::size_t node = nodes[i];
        isNamed[node] = isNamed[node] || JsonObject(document.at("nodes", node)).find("mesh").has_value();
        if (const std::optional<std::size_t> parent = tree.parentOf(node); parent && isNamed[node])
            isNamed[*parent] = true;
    }
    NamedNodes named{.positions = std::vector<std::uint32_t>(isNamed.size(), noNode)};
    for (const std::size_t index : nodes) {
        if (!isNamed[index])
            continue;
        const JsonObject object(document.at("nodes", index));
        named.positions[index] = static_cast<std::uint32_t>(named.nodes.size());
        SceneNode &node = named.nodes.emplace_back();
        node.name = nameOf(object);
        node.index = static_cast<std::uint32_t>(index);
        if (const std::optional<std::size_t> mesh = document.reference(object, "mesh", "meshes"))
            node.mesh = nameOf(JsonObject(document.at("meshes", *mesh)));
        if (const std::optional<std::size_t> parent = tree.parentOf(index))
            node.parent = named.positions[*parent];
    }
    return named;
}

/// A row of an animation by what the file states. Faults are those of who asks for a time.
GltfOutline::AnimationRow animationRow(const Document &document, std::size_t index) {
    static const nlohmann::json nothing;
    const auto member = [](const nlohmann::json &object, const char *key) -> const nlohmann::json & {
        const auto found = object.find(key);
        return found == object.end() ? nothing : *found;
    };
    const nlohmann::json &animation = *document.at("animations", index).value;
    GltfOutline::AnimationRow row;
    if (const nlohmann::json &name = member(animation, "name"); name.is_string())
        row.name = name.get<std::string>();
    for (const nlohmann::json &sampler : member(animation, "samplers")) {
        const nlohmann::json &input = member(sampler, "input");
        if (!input.is_number_unsigned() || input.get<std::size_t>() >= document.count("accessors"))
            continue;
        const nlohmann::json &last = member(*document.at("accessors", input.get<std::size_t>()).value, "max");
        if (last.is_array() && last.size() == 1 && last[0].is_number())
            row.seconds = std::max(row.seconds, last[0].get<double>());
    }
    return row;
}

/// `nodes` are those of the scene that is loaded.
GltfOutline outlineOf(const Document &document, const NodeTree &tree, const std::vector<std::size_t> &nodes) {
    GltfOutline outline;
    outline.cameraCount = document.count("cameras");
    for (std::size_t i = 0; i < std::min(outline.cameraCount, GltfOutline::maxRows); ++i) {
        const JsonObject camera(document.at("cameras", i));
        outline.cameras.push_back({nameOf(camera), camera.text("type")});
    }
    outline.animationCount = document.count("animations");
    for (std::size_t i = 0; i < std::min(outline.animationCount, GltfOutline::maxRows); ++i)
        outline.animations.push_back(animationRow(document, i));
    outline.nodeCount = nodes.size();
    for (const std::size_t index : std::span(nodes).first(std::min(nodes.size(), GltfOutline::maxRows))) {
        const JsonObject node(document.at("nodes", index));
        outline.nodes.push_back({index, tree.depthOf(index), nameOf(node), contentsOf(document, node)});
    }
    return outline;
}

} // namespace

Contents readContents(const std::filesystem::path &path, const FileAccess &access, TextureLibrary &textures,
                      const ContentOptions &options) {
    const Document document(path);
    MemoryBudget memoryBudget;
    memoryBudget.addFile(document.sizeBytes());
    const FileAccess near = access.from(path);
    Buffers buffers(document, near, memoryBudget);
    Contents contents;
    MeshReport &report = contents.file.report;
    report.name = document.fileName();
    checkExtensions(document, report.warnings);

    if (const std::size_t count = document.count("nodes"); count > 0)
        memoryBudget.take(count * NodeTree::bytesEach, document.top().at("nodes"));
    const NodeTree tree(document);
    const std::vector<Pose> rest = readPoses(document);
    std::optional<std::vector<Pose>> moved;
    if (options.timeSeconds)
        animate(buffers, *options.timeSeconds, moved.emplace(rest));
    const std::vector<Pose> &poses = moved ? *moved : rest;
    const std::vector<glm::dmat4x3> toWorld = tree.toWorld(poses);
    const std::optional<JsonObject> scene = chosenScene(document, options.scene);
    const std::vector<std::size_t> nodes = tree.nodesOfScene(document, scene);
    const std::optional<std::vector<std::size_t>> some = nodesShown(document, tree, nodes, poses.size());
    const std::vector<std::size_t> &shown = some ? *some : nodes;

    TextureReader textureReader(buffers, near, textures);
    Materials materials = readMaterials(document, textureReader);
    contents.file.materials = std::move(materials.list);
    StatedBounds bounds(document);
    MeshUses uses(buffers, poses, toWorld, bounds);
    NamedNodes named = namedNodesOf(document, tree, nodes);
    contents.file.nodes = std::move(named.nodes);
    ProfiledLights profiled(buffers, near);
    for (const std::size_t index : shown) {
        uses.add(index, named.positions[index]);
        const JsonObject node(document.at("nodes", index));
        if (const auto light = readLight(document, node, toWorld[index]))
            contents.lights.push_back(*light);
        if (const auto light = profiled.read(node, toWorld[index]))
            contents.lights.push_back(*light);
    }
    if (scene)
        contents.environment = readImageBasedLight(buffers, near, *scene);
    contents.profiles = profiled.give();
    report.warnings.insert(report.warnings.end(), profiled.warnings().begin(), profiled.warnings().end());
    readMeshes(buffers, uses.uses(), options.onReading, materials.shownAs, contents.file);
    contents.outline = outlineOf(document, tree, nodes);
    contents.camera = readCamera(document, nodes, toWorld, options.camera);
    if (document.count("animations") > 0)
        contents.restOrigin = restOriginOf(buffers, tree, rest, shown, bounds);
    if (options.sequence) {
        const std::vector<bool> animated = animatedNodes(document);
        const std::vector<bool> moving = tree.below(animated);
        contents.movesByTime = std::ranges::find(animated, true) != animated.end() &&
                               moveMoreThanCameras(document, shown, moving);
        if (contents.camera && moving[contents.camera->node] && !contents.movesByTime)
            contents.cameraPath = readCameraPath(buffers, tree, rest, *contents.camera, *options.sequence);
    }
    std::ranges::move(document.losses().warnings(), std::back_inserter(report.warnings));
    report.files = buffers.files();
    report.files.insert(report.files.begin(), path);
    return contents;
}

} // namespace hyalite::core::gltf
