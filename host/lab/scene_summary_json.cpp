#include "host/lab/scene_summary_json.h"

#include "host/base/hash.h"
#include "host/report/provenance.h"
#include "host/scene/names.h"
#include "host/scene/settings_table.h"

namespace hyalite::core {

namespace {

using OrderedJson = nlohmann::ordered_json;

template <class Vector> OrderedJson vectorToJson(const Vector &v) { return {v.x, v.y, v.z}; }

OrderedJson boundsToJson(const std::optional<Bounds> &bounds) {
    if (!bounds)
        return nullptr;
    return {{"low", vectorToJson(bounds->low)}, {"high", vectorToJson(bounds->high)}};
}

OrderedJson profileToJson(const ProfileSummary &profile) {
    return {{"file", profile.file},
            {"gammas", profile.gammaCount},
            {"planes", profile.planeCount},
            {"candela", profile.candela},
            {"lumens", profile.lumens}};
}

OrderedJson materialToJson(const MaterialSummary &material) {
    OrderedJson json{{"name", material.name},
                     {"type", nameIn(materialNames, material.kind)},
                     {"spheres", material.sphereCount},
                     {"triangles", material.triangleCount}};
    if (material.emission != glm::vec3(0.0f)) {
        json["emission"] = vectorToJson(material.emission);
        json["twoSided"] = material.isTwoSided;
    }
    for (const auto &[key, file] : material.textures)
        json["textures"][std::string(key)] = file;
    return json;
}

std::string_view kindName(NodeKind kind) {
    return kind == NodeKind::Gltf ? "node" : kind == NodeKind::Mesh ? "mesh" : "shape";
}

/// Index and names of a node.
void addName(const SceneNode &node, OrderedJson &json) {
    json["kind"] = kindName(node.kind);
    json["index"] = node.index;
    json["name"] = node.name;
    if (!node.mesh.empty())
        json["mesh"] = node.mesh;
}

OrderedJson nodeToJson(const NodeSummary &summary) {
    OrderedJson json;
    addName(summary.node, json);
    json["parent"] = summary.node.parent == noNode ? OrderedJson() : OrderedJson(summary.node.parent);
    json["bounds"] = boundsToJson(summary.bounds);
    return json;
}

OrderedJson meshToJson(const MeshReport &mesh) {
    return {{"name", mesh.name},
            {"triangles", mesh.triangleCount},
            {"vertices", mesh.vertexCount},
            {"normals", mesh.normalCount},
            {"instances", mesh.instanceCount},
            {"faces", mesh.faceCount},
            {"polygons", mesh.polygonCount},
            {"degenerateTriangles", mesh.degenerateTriangleCount},
            {"unusedStatements", mesh.unusedStatementCount},
            {"lostNormals", mesh.lostNormalCount},
            {"lostLibraries", mesh.lostLibraries},
            {"unknownMaterials", mesh.unknownMaterialCount},
            {"warnings", mesh.warnings}};
}

/// The lists of a glTF file, which have the first rows only.
void addOutline(const GltfOutline &outline, OrderedJson &json) {
    OrderedJson &file = json["gltf"];
    file = {{"cameraCount", outline.cameraCount}, {"cameras", OrderedJson::array()}};
    for (std::size_t i = 0; i < outline.cameras.size(); ++i)
        file["cameras"].push_back(
            {{"index", i}, {"name", outline.cameras[i].name}, {"type", outline.cameras[i].type}});
    file["animationCount"] = outline.animationCount;
    file["animations"] = OrderedJson::array();
    for (std::size_t i = 0; i < outline.animations.size(); ++i)
        file["animations"].push_back(
            {{"index", i}, {"name", outline.animations[i].name}, {"seconds", outline.animations[i].seconds}});
    file["nodeCount"] = outline.nodeCount;
    file["nodes"] = OrderedJson::array();
    for (const GltfOutline::NodeRow &node : outline.nodes)
        file["nodes"].push_back(
            {{"index", node.index}, {"depth", node.depth}, {"name", node.name}, {"contents", node.contents}});
}

OrderedJson treeToJson(const TreeSummary &tree, const RenderSettings &settings) {
    const BvhStatistics &statistics = tree.statistics;
    OrderedJson json{{"type", nameOf(settings.tree)},
                     {"leafSize", settings.leafSize},
                     {"innerNodes", statistics.innerCount},
                     {"leaves", statistics.leafCount},
                     {"depth", statistics.depth},
                     {"meanLeaf", statistics.meanLeaf},
                     {"largestLeaf", statistics.largestLeaf},
                     {"sahCost", statistics.sahCost},
                     {"trianglesTested", statistics.trianglesTested},
                     {"droppedTriangles", tree.droppedCount},
                     {"fault", tree.fault.empty() ? OrderedJson() : OrderedJson(tree.fault)}};
    json["leavesOfUpTo"] = OrderedJson::object();
    for (std::size_t i = 0; i < statistics.leafHistogram.size(); ++i)
        json["leavesOfUpTo"][i + 1 == statistics.leafHistogram.size() ? "more" : std::to_string(1u << i)] =
            statistics.leafHistogram[i];
    return json;
}

void addPixels(const Coverage &coverage, const CoveredPixels &pixels, OrderedJson &json) {
    json["share"] = coverage.shareOf(pixels.pixelCount);
    json["pixels"] = pixels.pixelCount;
    json["box"] = {pixels.box.x0, pixels.box.x1, pixels.box.y0, pixels.box.y1};
}

OrderedJson objectToJson(const Coverage &coverage, const ObjectCoverage &object) {
    OrderedJson json;
    if (object.sphere)
        json = {{"kind", "sphere"}, {"index", *object.sphere}, {"material", object.material}};
    else
        addName(object.node, json);
    if (!object.file.empty())
        json["file"] = object.file;
    if (object.instance)
        json["instance"] = *object.instance;
    addPixels(coverage, object.pixels, json);
    return json;
}

OrderedJson coverageToJson(const Coverage &coverage) {
    OrderedJson json{{"crop", {coverage.crop.x0, coverage.crop.x1, coverage.crop.y0, coverage.crop.y1}},
                     {"pixels", coverage.pixelCount},
                     {"background", coverage.shareOf(coverage.backgroundCount)},
                     {"objects", OrderedJson::array()},
                     {"unseenObjects", coverage.unseenCount},
                     {"materials", OrderedJson::array()}};
    for (const ObjectCoverage &object : coverage.objects)
        json["objects"].push_back(objectToJson(coverage, object));
    for (const MaterialCoverage &material : coverage.materials) {
        OrderedJson &row = json["materials"].emplace_back(OrderedJson{{"name", material.name}});
        addPixels(coverage, material.pixels, row);
    }
    return json;
}

template <class Row, class ToJson> OrderedJson listOf(const std::vector<Row> &rows, const ToJson &toJson) {
    OrderedJson list = OrderedJson::array();
    for (const Row &row : rows)
        list.push_back(toJson(row));
    return list;
}

/// The document without what was measured.
OrderedJson summaryToJson(const SceneSummary &summary, const std::string &commandLine) {
    OrderedJson json{{"inspectVersion", inspectVersion}};
    json.update(programToJson(commandLine));
    json["scene"] = summary.file;
    json["sceneHash"] = hashText(summary.contentHash);
    json["inputFiles"] = summary.inputFiles;
    json["contents"] = {{"triangles", summary.triangleCount},
                        {"meshes", summary.meshes.size()},
                        {"instances", summary.arrangement.instanceCount},
                        {"instancedMeshes", summary.arrangement.prototypeCount},
                        {"flattenedInstances", summary.arrangement.flattenedCount},
                        {"spheres", summary.sphereCount},
                        {"lights", summary.lights.size()},
                        {"materials", summary.materials.size()}};
    json["bounds"] = boundsToJson(summary.bounds);
    if (summary.origin != glm::dvec3(0.0))
        json["origin"] = vectorToJson(summary.origin);
    json["camera"] = cameraToJson(summary.camera);
    json["lights"] = listOf(summary.lights, lightToJson);
    json["profiles"] = listOf(summary.profiles, profileToJson);
    json["environment"] = nullptr;
    if (const std::optional<EnvironmentSummary> &sky = summary.environment)
        json["environment"] = {{"width", sky->width},
                               {"height", sky->height},
                               {"scale", sky->scale},
                               {"rotateDegrees", sky->rotateDegrees}};
    json["background"] = summary.environment ? OrderedJson() : vectorToJson(summary.background);
    json["materials"] = listOf(summary.materials, materialToJson);
    json["shapes"] = OrderedJson::object();
    for (const auto &[type, count] : summary.shapes)
        json["shapes"][std::string(type)] = count;
    json["nodes"] = listOf(summary.nodes, nodeToJson);
    json["meshes"] = listOf(summary.meshes, meshToJson);
    if (summary.outline)
        addOutline(*summary.outline, json);
    json["settings"] = settingsToJson(summary.settings);
    json["tree"] = summary.tree ? treeToJson(*summary.tree, summary.settings) : OrderedJson();
    json["bytes"] = {{"nodes", summary.nodeBytes},
                     {"triangles", summary.triangleBytes},
                     {"normals", summary.normalBytes},
                     {"scene", summary.sceneBytes}};
    json["seconds"] = {{"load", summary.loadSeconds}, {"build", summary.buildSeconds}};
    return json;
}

} // namespace

OrderedJson cameraToJson(const Camera &camera) {
    OrderedJson json{{"type", nameIn(cameraNames, camera.kind)},
                     {"position", vectorToJson(camera.position)},
                     {"direction", vectorToJson(camera.direction)},
                     {"up", vectorToJson(camera.up)}};
    if (camera.kind == CameraKind::Perspective) {
        json["horizontalFov"] = camera.horizontalFovDegrees;
        json["aperture"] = camera.aperture;
        json["focusDistance"] = camera.focusDistance;
    }
    if (camera.kind == CameraKind::Orthographic)
        json["viewWidth"] = camera.viewWidth;
    json["width"] = camera.width;
    json["height"] = camera.height;
    return json;
}

OrderedJson lightToJson(const Light &light) {
    OrderedJson json{{"type", nameIn(lightNames, light.kind)}};
    if (light.kind != LightKind::Directional)
        json["position"] = vectorToJson(light.position);
    if (light.kind != LightKind::Point || light.profile)
        json["direction"] = vectorToJson(light.direction);
    json[light.kind == LightKind::Directional ? "irradiance" : "power"] = vectorToJson(light.power);
    if (light.kind == LightKind::Spot) {
        json["angle"] = light.angleDegrees;
        json["blend"] = light.blend;
        json["fade"] = nameIn(spotFadeNames, light.fade);
    }
    if (light.profile) {
        json["profile"] = *light.profile;
        json["c0"] = vectorToJson(light.c0);
    }
    return json;
}

nlohmann::ordered_json sceneToJson(const SceneSummary &summary, const std::optional<Coverage> &coverage,
                                   const std::optional<TreeCheck> &check, const std::string &commandLine) {
    OrderedJson json = summaryToJson(summary, commandLine);
    if (coverage)
        json["coverage"] = coverageToJson(*coverage);
    if (check)
        json["rays"] = {{"count", check->rayCount},
                        {"treeSeconds", check->treeSeconds},
                        {"bruteSeconds", check->bruteSeconds},
                        {"differences", check->differenceCount}};
    return json;
}

} // namespace hyalite::core
