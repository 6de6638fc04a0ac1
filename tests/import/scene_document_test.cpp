// Scenes in memory: arrays in place of files.
#include "host/import/load.h"
#include "host/import/mesh_arrays.h"
#include "host/import/ply.h"
#include "host/scene/limits.h"
#include "tests/fixtures/temporary_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <string>

namespace hyalite::core {
namespace {

MeshArrays squareArrays(const glm::dvec3 &offset = glm::dvec3(0.0), double size = 1.0) {
    MeshArrays arrays;
    arrays.positions = {offset, offset + glm::dvec3(size, 0, 0), offset + glm::dvec3(size, size, 0),
                        offset + glm::dvec3(0, size, 0)};
    arrays.corners = {0, 1, 2, 0, 2, 3};
    return arrays;
}

SceneDocument documentOf(MeshArrays arrays) {
    SceneDocument document{.json = {{"meshes", {{{"file", "square"}}}}}, .file = "scene"};
    document.arrays.meshes.emplace("square", std::make_shared<MeshArrays>(std::move(arrays)));
    return document;
}

std::string faultOf(const MeshArrays &arrays) {
    try {
        static_cast<void>(loadScene(documentOf(arrays)));
    } catch (const Error &error) {
        EXPECT_EQ(error.kind, ErrorKind::BadInput);
        return error.what();
    }
    return "none";
}

// The arrays go the way of files: normals, colours and polygons, and the same bits.
TEST(MeshArrays, AreReadAsThePlyOfTheSameNumbers) {
    MeshArrays arrays = squareArrays({0.1, 0.2, 0.3}, 0.7);
    arrays.corners = {0, 1, 2, 3};
    arrays.cornersPerFace = 4;
    arrays.normals.assign(4, glm::dvec3(0.0, 3.0, 4.0));
    arrays.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    arrays.colours = {{0.25f, 0.5f, 1.0f}, {0, 0, 0}, {1, 1, 1}, {0.5f, 0.5f, 0.5f}};
    const testing::TemporaryFolder folder;
    const std::filesystem::path file = folder.path / "square.ply";
    std::ofstream stream(file);
    stream.precision(17);
    stream << "ply\nformat ascii 1.0\nelement vertex 4\n";
    for (const char *name : {"x", "y", "z", "nx", "ny", "nz", "s", "t"})
        stream << "property double " << name << "\n";
    for (const char *name : {"red", "green", "blue"})
        stream << "property float " << name << "\n";
    stream << "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec3 &p = arrays.positions[i];
        const glm::vec3 &c = arrays.colours[i];
        stream << p.x << " " << p.y << " " << p.z << " 0 3 4 " << arrays.uvs[i].x << " " << arrays.uvs[i].y
               << " " << c.x << " " << c.y << " " << c.z << "\n";
    }
    stream << "4 0 1 2 3\n";
    stream.close();
    const ObjMesh ply = loadPly(file);
    const MeshFile made = readMeshArrays("square", arrays, {});
    const TriangleMesh &mesh = made.meshes.front().mesh;
    EXPECT_EQ(mesh.positions, ply.mesh.positions);
    EXPECT_EQ(mesh.normals, ply.mesh.normals);
    EXPECT_EQ(mesh.uvs, ply.mesh.uvs);
    EXPECT_EQ(mesh.colours.values, ply.mesh.colours.values);
    ASSERT_EQ(mesh.triangles.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i)
        EXPECT_EQ(mesh.triangles[i].positions, ply.mesh.triangles[i].positions);
}

// In float32 the square of a thousandth would have no size at ten million.
TEST(MeshArrays, KeepTheirDoublesUntilTheyAreMovedNearZero) {
    const LoadedScene far = loadScene(documentOf(squareArrays({1e7, -2e7, 3e7}, 1e-3)));
    const std::vector<glm::vec3> &positions = far.scene.meshes.front().positions;
    EXPECT_NEAR(glm::dvec3(positions[1]).x - glm::dvec3(positions[0]).x, 1e-3,
                4e-9); // steps of doubles there
    EXPECT_NEAR((far.scene.origin + glm::dvec3(positions[0])).x, 1e7, 4e-9);
}

TEST(MeshArrays, ArePlaced) {
    MeshArrays arrays = squareArrays();
    arrays.places.assign(3, glm::dmat4x3(1.0));
    arrays.places[2][3] = {5.0, 0.0, 0.0};
    const LoadedScene loaded = loadScene(documentOf(arrays));
    ASSERT_EQ(loaded.scene.instances.size(), 3u);
    EXPECT_EQ(loaded.scene.instances[2].toWorld.offset, glm::vec3(5.0f, 0.0f, 0.0f));
}

TEST(MeshArrays, AreRefusedWithTheirNameAndRow) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    MeshArrays arrays = squareArrays();
    arrays.corners[5] = 4;
    EXPECT_EQ(faultOf(arrays), "square: row 1: found the vertex 4; allowed: from 0 to 3");
    arrays = squareArrays();
    arrays.positions[3].y = nan;
    EXPECT_NE(faultOf(arrays).find("square: row 3: vertex (0, nan, 0) is no finite float"), std::string::npos)
        << faultOf(arrays);
    arrays = squareArrays();
    arrays.places.assign(2, glm::dmat4x3(1.0));
    arrays.places[1][1] = glm::dvec3(0.0);
    EXPECT_NE(faultOf(arrays).find("square: row 1: the instance makes everything flat"), std::string::npos);
    arrays = squareArrays();
    arrays.places.assign(1, glm::dmat4x3(1.0));
    arrays.places[0][3].z = nan;
    EXPECT_NE(faultOf(arrays).find("square: row 0: found nan in the instance's matrix"), std::string::npos);
    arrays = squareArrays();
    arrays.corners.clear();
    EXPECT_NE(faultOf(arrays).find("no triangle in 0 faces"), std::string::npos);
}

TEST(SceneDocuments, HaveTexturesAndEnvironmentsOfArrays) {
    MeshArrays arrays = squareArrays();
    arrays.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    SceneDocument document = documentOf(arrays);
    document.json["materials"]["painted"] = {{"type", "diffuse"},
                                             {"textures", {{"baseColour", {{"file", "paint"}}}}}};
    document.json["meshes"][0]["material"] = "painted";
    document.json["environment"] = {{"file", "sky"}, {"scale", 2.0}};
    auto paint = std::make_shared<Texture>();
    paint->name = "paint";
    paint->width = paint->height = 1;
    paint->levels = {0xff0000ffu};
    document.arrays.textures.emplace("paint", paint);
    auto sky = std::make_shared<Image>(2, 1);
    sky->at(0, 0) = {1.0f, -1.0f, 3.0f}; // a negative radiance counts as 0
    document.arrays.environments.emplace("sky", sky);
    const LoadedScene loaded = loadScene(document);
    ASSERT_EQ(loaded.scene.textures.size(), 1u);
    EXPECT_EQ(loaded.scene.textures[0].levels, paint->levels);
    EXPECT_EQ(loaded.scene.environment.radiance.at(0, 0), glm::vec3(1.0f, 0.0f, 3.0f));
    EXPECT_EQ(loaded.scene.environment.scale, 2.0f);
    ASSERT_EQ(loaded.warnings.size(), 1u);
    EXPECT_EQ(loaded.settings.integrator, Integrator::Path);
}

TEST(SceneDocuments, KeepScenesFromFilesOfStrangers) {
    SceneDocument document = documentOf(squareArrays());
    document.json["meshes"][0]["file"] = "/etc/hostname";
    EXPECT_THROW(static_cast<void>(loadScene(document)), Error);
}

TEST(SceneDocuments, AreFramedAndLitOnRequest) {
    SceneDocument document = documentOf(squareArrays({100.0, 0.0, 0.0}));
    document.isFramed = true;
    const LoadedScene loaded = loadScene(document);
    EXPECT_TRUE(loaded.autoFramed);
    EXPECT_TRUE(loaded.isAutoLit);
    EXPECT_EQ(loaded.scene.lights.size(), 2u);
    EXPECT_GT(loaded.scene.camera.position.x, 90.0);
    document.json["lights"] = {{{"type", "point"}, {"position", {0, 0, 5}}, {"power", 10}}};
    EXPECT_FALSE(loadScene(document).isAutoLit);
    EXPECT_EQ(loadScene(document).scene.lights.size(), 1u);
}

} // namespace
} // namespace hyalite::core
