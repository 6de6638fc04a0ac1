// MTL as programs write it: what is made of it, program by program. host/import/README.md has a row for each of these.
#include "host/base/clean_text.h"
#include "host/import/mtl.h"
#include "tests/fixtures/png_fixture.h"
#include "tests/fixtures/scene_json_fixture.h"

#include <fmt/format.h>

#include <fstream>
#include <set>
#include <sstream>

namespace hyalite::core {
namespace {

struct Look {
    MaterialKind kind = MaterialKind::Diffuse;
    glm::vec3 albedo{0.8f};
    bool isTextured = false;
    float metallic = 0.0f;
    float transmission = 0.0f;
};

struct Case {
    const char *program;
    const char *statements;
    Look look;
};

constexpr MaterialKind principled = MaterialKind::Principled;

const Case cases[] = {
    {"Maya",
     "illum 4\nKd 0.00 0.00 0.00\nKa 0.00 0.00 0.00\nTf 1.00 1.00 1.00\nmap_Kd c.png\nNi 1.00\n",
     {.albedo = glm::vec3(1), .isTextured = true}},
    {"Maya",
     "illum 4\nKd 0.50 0.40 0.30\nKa 0.00 0.00 0.00\nTf 1.00 1.00 1.00\nNi 1.00\n",
     {.albedo{0.5f, 0.4f, 0.3f}}},
    {"Maya",
     "illum 4\nKd 0.00 0.00 0.00\nKa 0.00 0.00 0.00\nTf 1.00 1.00 1.00\nNi 1.00\n",
     {.albedo = glm::vec3(0)}},
    {"3ds Max",
     "\tNs 10.0000\n\tNi 1.5000\n\td 1.0000\n\tTr 0.0000\n\tTf 1.0000 1.0000 1.0000\n\tillum 2\n\tKa 0.5 0.5 "
     "0.5\n"
     "\tKd 0.5 0.5 0.5\n\tKs 0 0 0\n\tKe 0 0 0\n\tmap_Ka c.png\n\tmap_Kd c.png\n",
     {.albedo = glm::vec3(0.5f), .isTextured = true}},
    {"3ds Max",
     "Ns 10\nNi 1.5\nd 0.25\nTr 0.75\nillum 2\nKd 0.5 0.5 0.5\nKs 0 0 0\n",
     {.kind = principled, .albedo = glm::vec3(0.5f), .transmission = 0.75f}},
    {"Cinema 4D",
     "Ka 1 1 1\nKd 0.95 0.49 0.1\nKs 1 1 1\nNs 50\nillum 7\n",
     {principled, {0.95f, 0.49f, 0.1f}}},
    {"Cinema 4D", "Ka 1 1 1\nKd 0 0 0\nKs 1 1 1\nNs 50\nillum 7\n", {principled, glm::vec3(0)}},
    {"Cinema 4D",
     "Kd 1 1 1\nKs 0 0 0\nNs 50\nillum 7\nmap_Kd c.png\n",
     {.albedo = glm::vec3(1), .isTextured = true}},
    {"Blender",
     "Ns 250\nKa 1 1 1\nKd 0.8 0.8 0.4\nKs 0.5 0.5 0.5\nKe 0 0 0\nNi 1.45\nd 1\nillum 3\nPr 0.3\nPm 1.0\nPs "
     "0\nPc 0\n"
     "Pcr 0.03\naniso 0\nanisor 0\n",
     {principled, {0.8f, 0.8f, 0.4f}, false, 1.0f}},
    {"Blender",
     "Ns 250\nKd 0.8 0.2 0.1\nKs 0.5 0.5 0.5\nKe 0 0 0\nNi 1.45\nd 1\nillum 2\n",
     {principled, {0.8f, 0.2f, 0.1f}}},
    {"Blender",
     "Ns 250\nKd 0.8 0.2 0.1\nKs 0.5 0.5 0.5\nKe 0 0 0\nNi 1.45\nd 0.5\nillum 9\n",
     {principled, {0.8f, 0.2f, 0.1f}, false, 0.0f, 0.5f}},
    {"MeshLab",
     "Ka 0.2 0.2 0.2\nKd 0.8 0.8 0.6\nKs 0 0 0\nTr 1.000000\nillum 2\nNs 0.000000\nmap_Kd c.png\n",
     {.albedo{0.8f, 0.8f, 0.6f}, .isTextured = true}},
    {"IfcOpenShell",
     "Kd 0.5 0.5 0.6\nKs 0 0 0\nNs 64\nTr 0.25\nd 0.25\nD 0.25\n",
     {.kind = principled, .albedo{0.5f, 0.5f, 0.6f}, .transmission = 0.75f}},
    {"IfcOpenShell", "Kd 0.5 0.5 0.6\nd 1\nTr 1\nD 1\n", {.albedo{0.5f, 0.5f, 0.6f}}},
    {"SketchUp", "Ka 0 0 0\nKd 0 0 0\nKs 0.33 0.33 0.33\nmap_Kd c.png\n", {principled, glm::vec3(1), true}},
    {"By hand", "illum 7\nNi 1.5\n", {.kind = MaterialKind::Dielectric}},
    {"By hand", "Kd 0 0 0\nKs 1 1 1\nNi 1.5\nillum 7\n", {.kind = MaterialKind::Dielectric}},
    {"By hand", "illum 3\nKs 0.9 0.7 0.4\nNs 126\n", {principled, {0.9f, 0.7f, 0.4f}, false, 1.0f}},
};

class MtlOfPrograms : public SceneFolder, public ::testing::WithParamInterface<Case> {};

TEST_P(MtlOfPrograms, BecomesWhatTheyMean) {
    const Case &each = GetParam();
    (void)write("c.png", onePixelPng(200, 100, 50));
    FileFinder files(std::filesystem::canonical(folder));
    TextureLibrary library;
    Losses losses;
    const std::vector<Material> materials =
        loadMtl(write("a.mtl", std::string("newmtl m\n") + each.statements), {files, library, losses});
    ASSERT_EQ(materials.size(), 1u);
    const Material &material = materials[0];
    EXPECT_EQ(material.kind, each.look.kind);
    if (each.look.kind != MaterialKind::Dielectric) {
        EXPECT_EQ(material.albedo, each.look.albedo);
        EXPECT_EQ(material.textures[layout::slotBaseColour].has_value(), each.look.isTextured);
        EXPECT_EQ(material.metallic, each.look.metallic);
        EXPECT_EQ(material.transmission, each.look.transmission);
        EXPECT_EQ(material.opacity, 1.0f);
    }
    const bool isMeshLab = std::string(each.program) == "MeshLab";
    EXPECT_EQ(losses.warnings().size(), isMeshLab ? 1u : 0u) << ::testing::PrintToString(losses.warnings());
}

INSTANTIATE_TEST_SUITE_P(Each, MtlOfPrograms, ::testing::ValuesIn(cases));

// The first column of the table.
TEST(MtlOfPrograms, AreThoseOfTheDocument) {
    std::ifstream stream(HYALITE_SOURCE_DIR "/host/import/README.md");
    std::stringstream text;
    text << stream.rdbuf();
    std::string rest = text.str();
    rest = rest.substr(rest.find("## MTL as programs write it"));
    rest = rest.substr(0, rest.find("\n## ", 1));
    std::set<std::string> documented;
    std::istringstream lines(rest.substr(rest.find("|---|")));
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line) && line.starts_with("| "))
        documented.insert(line.substr(2, line.find(" |") - 2));
    std::set<std::string> tested;
    for (const Case &each : cases)
        tested.insert(each.program);
    EXPECT_EQ(documented, tested);
}

} // namespace
} // namespace hyalite::core
