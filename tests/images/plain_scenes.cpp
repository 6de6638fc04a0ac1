#include "tests/images/plain_scenes.h"
#include "tests/fixtures/test_scene.h"

namespace hyalite::core::testing {

TestScene emptyScene(int maxDepth, int samplesPerPixel) {
    TestScene scene;
    scene.camera.position = {0.0, 0.0, 4.0};
    scene.camera.horizontalFovDegrees = 30.0;
    scene.camera.focusDistance = 4.0;
    scene.camera.width = 16;
    scene.camera.height = 16;
    scene.settings.integrator = Integrator::Path;
    scene.settings.maxDepth = maxDepth;
    scene.settings.samplesPerPixel = samplesPerPixel;
    scene.settings.seed = 7;
    return scene;
}

Environment studioEnvironment(double rotateDegrees) {
    Environment environment;
    environment.radiance = Image(8, 4);
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 8; ++x) {
            glm::vec3 &pixel = environment.radiance.at(x, y);
            const float up = y < 2 ? 1.0f : 0.5f;
            pixel = up * glm::vec3(0.3f + 0.05f * static_cast<float>(x), 0.4f,
                                   0.7f - 0.05f * static_cast<float>(x));
        }
    environment.radiance.at(1, 1) = {3.0f, 2.0f, 1.0f};
    environment.radiance.at(6, 1) = {0.5f, 1.5f, 3.0f};
    environment.radiance.at(3, 3) = {0.1f, 1.0f, 0.1f};
    environment.rotateDegrees = rotateDegrees;
    return environment;
}

std::uint32_t addMaterial(Scene &scene, const Material &material) {
    scene.materials.push_back(material);
    return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

void addBall(Scene &scene, const glm::dvec3 &centre, double radius, const Material &material, bool isInward) {
    scene.spheres.push_back({centre, radius, addMaterial(scene, material), isInward});
}

TriangleMesh &addQuad(Scene &scene, const glm::vec3 &corner, const glm::vec3 &u, const glm::vec3 &v,
                      const Material &material) {
    TriangleMesh mesh;
    mesh.materialIndex = addMaterial(scene, material);
    mesh.positions = {corner, corner + u, corner + u + v, corner + v};
    mesh.triangles = {{glm::uvec3(0, 1, 2)}, {glm::uvec3(0, 2, 3)}};
    mesh.uvs = {{0.0f, 0.0f}, {1.0f, 0.0f}, {1.0f, 1.0f}, {0.0f, 1.0f}};
    mesh.triangleUvs = {glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)};
    scene.meshes.push_back(mesh);
    return scene.meshes.back();
}

Material diffuse(const glm::vec3 &albedo) {
    Material material;
    material.albedo = albedo;
    return material;
}

Material lamp(const glm::vec3 &emission) {
    Material material = diffuse(glm::vec3(0.0f));
    material.emission = emission;
    return material;
}

Texture levelTexture(int width, int height, const std::vector<std::array<std::uint32_t, 4>> &pixels) {
    Texture texture;
    texture.name = "texture of the test";
    texture.width = width;
    texture.height = height;
    for (const auto &pixel : pixels) {
        texture.levels.push_back(pixel[0] | pixel[1] << 8u | pixel[2] << 16u | pixel[3] << 24u);
        texture.hasAlpha = texture.hasAlpha || pixel[3] != 255u;
    }
    return texture;
}

void wear(Scene &scene, Material &material, std::uint32_t slot, const Texture &texture, glm::vec2 scale,
          glm::vec2 offset) {
    material.textures[slot] = TextureUse{static_cast<std::uint32_t>(scene.textures.size()), scale, offset};
    scene.textures.push_back(texture);
}

} // namespace hyalite::core::testing
