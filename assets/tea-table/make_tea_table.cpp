// make_tea_table --output FILE: writes the tea table, a binary glTF file that needs no other. Runs while Hyalite
// is built.
//
// On a round cloth stand a painted teapot, a glass of tea, a copper bowl of sugar, and macarons under a bell jar.
//
//            pot        jar
//               tea
//                     bowl           x to the right, z towards the camera
#include "assets/tea-table/glb.h"
#include "assets/tea-table/images.h"
#include "assets/tea-table/materials.h"
#include "assets/tea-table/shapes.h"
#include "assets/tea-table/turns.h"

#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

namespace {

using namespace tea_table;

constexpr int exitUsage = 2;
constexpr int exitOutput = 7;

constexpr double doilyRadius = 0.135;

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", value);
    return text;
}

/// The nodes in the making: a list in JSON.
class Nodes {
  public:
    void add(std::string_view name, int mesh, const Vec &translation, double turnsAboutY = 0.0,
             std::string_view more = {}) {
        std::string node = "{\"name\":\"" + std::string(name) + "\",\"mesh\":" + std::to_string(mesh) +
                           ",\"translation\":[" + number(translation[0]) + "," + number(translation[1]) +
                           "," + number(translation[2]) + "]";
        if (turnsAboutY != 0.0)
            node += ",\"rotation\":[0," + number(sinTurns(0.5 * turnsAboutY)) + ",0," +
                    number(cosTurns(0.5 * turnsAboutY)) + "]";
        addText(node + std::string(more) + "}");
    }

    void addText(const std::string &node) {
        text_ += (count_ == 0 ? "" : ",\n") + node;
        ++count_;
    }

    [[nodiscard]] std::string scene() const {
        std::string roots;
        for (int i = 0; i < count_; ++i)
            roots += (i == 0 ? "" : ",") + std::to_string(i);
        return "\"nodes\":[" + text_ + "],\n\"scenes\":[{\"name\":\"tea table\",\"nodes\":[" + roots +
               "]}],\"scene\":0,\n";
    }

  private:
    std::string text_;
    int count_ = 0;
};

constexpr std::string_view head = R"("asset":{"version":"2.0","generator":"make_tea_table of Hyalite"},
"extensionsUsed":["EXT_mesh_gpu_instancing","KHR_materials_anisotropy","KHR_materials_clearcoat","KHR_materials_ior",
"KHR_materials_sheen","KHR_materials_specular","KHR_materials_transmission","KHR_materials_volume",
"KHR_texture_transform"],
"cameras":[{"name":"guest","type":"perspective","perspective":{"yfov":0.37,"aspectRatio":1.3333333,"znear":0.01}}],
)";

void addTextures(Glb &glb) {
    using still_life::encodePng;
    glb.addTexture("cloth", encodePng(clothColour(), false));
    glb.addTexture("threads", encodePng(clothNormals(), false));
    glb.addTexture("blossoms", encodePng(potColour(), false));
    glb.addTexture("lace", encodePng(lace(), true));
    glb.addTexture("grains", encodePng(sugarNormals(), false));
    glb.addTexture("steam", encodePng(steam(), true));
}

/// Cubes in the bowl and beside it share a mesh. One is a mirror image.
void addSugar(Glb &glb, Nodes &nodes, const Vec &bowl) {
    const int cube = glb.addMesh("sugar cube", {{materialSugar, sugarCube()}});
    constexpr auto places = std::to_array<std::array<double, 4>>({{-0.020, 0.026, -0.012, 0.07},
                                                                  {0.001, 0.022, 0.014, 0.19},
                                                                  {0.020, 0.026, -0.008, 0.02},
                                                                  {-0.022, 0.028, 0.016, 0.11},
                                                                  {0.022, 0.029, 0.015, 0.15},
                                                                  {0.000, 0.030, -0.024, 0.05},
                                                                  {-0.009, 0.0425, 0.003, 0.13},
                                                                  {0.012, 0.0425, 0.002, 0.03}});
    for (const auto &[x, y, z, turns] : places)
        nodes.add("sugar", cube, still_life::add(bowl, {x, y, z}), turns);
    nodes.add("sugar", cube, {0.078, sugarHalf, 0.190}, 0.08);
    nodes.add("sugar, mirrored", cube, {0.056, sugarHalf, 0.208}, 0.17, ",\"scale\":[-1,1,1]");
}

void addCakes(Glb &glb, Nodes &nodes, const Vec &stand) {
    constexpr Vec cream{0.85, 0.76, 0.60};
    const int rose = glb.addMesh("rose macaron", {{materialMacaron, macaron({0.78, 0.27, 0.30}, cream)}});
    const int pistachio = glb.addMesh("pistachio macaron",
                                      {{materialMacaron, macaron({0.42, 0.56, 0.22}, {0.30, 0.13, 0.06})}});
    const auto place = [&](int mesh, double x, double z, double turns, double height) {
        nodes.add("macaron", mesh, still_life::add(stand, {x, cakeStandHeight + height, z}), turns);
    };
    place(rose, -0.027, 0.020, 0.1, 0.0);
    place(pistachio, 0.027, 0.018, 0.3, 0.0);
    place(rose, 0.002, -0.028, 0.5, 0.0);
    place(pistachio, -0.042, -0.024, 0.2, 0.0);
    place(rose, 0.045, -0.025, 0.7, 0.0);
    place(pistachio, -0.008, 0.004, 0.6, macaronHeight);
    place(rose, 0.020, -0.006, 0.9, macaronHeight);
}

/// Pearls on the lace's scallops: one mesh, instanced.
void addPearls(Glb &glb, Nodes &nodes, const Vec &middle) {
    std::vector<Vec> places;
    for (int i = 0; i < laceScallopCount; ++i) {
        const double distance = doilyRadius * 2.0 * (laceScallopRadius + 0.052);
        const double turns = -static_cast<double>(i) / laceScallopCount;
        places.push_back({distance * cosTurns(turns), 0.0, distance * sinTurns(turns)});
    }
    const int accessor = glb.addVectors(places); // not within the call: the order there is the compiler's
    const int mesh = glb.addMesh("pearl", {{materialPearl, pearl()}});
    nodes.add("pearls", mesh, middle, 0.0,
              ",\"extensions\":{\"EXT_mesh_gpu_instancing\":{\"attributes\":{\"TRANSLATION\":" +
                  std::to_string(accessor) + "}}}");
}

bool writeTable(const char *file) {
    constexpr Vec pot{-0.120, 0.0, -0.030};
    constexpr Vec glass{0.000, 0.0, 0.125};
    constexpr Vec bowl{0.140, 0.0, 0.140};
    constexpr Vec jar{0.130, 0.0, -0.060};
    Glb glb;
    Nodes nodes;
    addTextures(glb);
    // The camera looks down by 19.2 degrees.
    nodes.addText(R"({"name":"guest","camera":0,"translation":[0.01,0.42,1.02],)"
                  R"("rotation":[-0.16676875,0,0,0.98599604]})");
    nodes.add("cloth", glb.addMesh("cloth", {{materialCloth, cloth()}}), {});
    nodes.add("pot",
              glb.addMesh("pot", {{materialPaintedGlaze, potBody()}, {materialGlaze, potSpoutAndHandle()}}),
              pot, 0.1);
    nodes.add("saucer", glb.addMesh("saucer", {{materialGlaze, saucer()}}), glass);
    const Vec onSaucer = still_life::add(glass, {0.0, 0.0056, 0.0});
    nodes.add("tea glass", glb.addMesh("tea glass", {{materialGlass, teaGlass()}}), onSaucer);
    nodes.add("tea", glb.addMesh("tea", {{materialTea, tea()}}), onSaucer);
    nodes.add("steam", glb.addMesh("steam", {{materialSteam, steamPlume()}}),
              still_life::add(onSaucer, {0.0, 0.070, 0.0}));
    nodes.add("sugar bowl", glb.addMesh("sugar bowl", {{materialCopper, sugarBowl()}}), bowl);
    addSugar(glb, nodes, bowl);
    const Vec onLace = still_life::add(jar, {0.0, 0.0012, 0.0});
    nodes.add("doily", glb.addMesh("doily", {{materialLace, doily(doilyRadius)}}),
              still_life::add(jar, {0.0, 0.001, 0.0}));
    addPearls(glb, nodes, jar);
    nodes.add("cake stand", glb.addMesh("cake stand", {{materialGlaze, cakeStand()}}), onLace);
    addCakes(glb, nodes, onLace);
    nodes.add("bell jar", glb.addMesh("bell jar", {{materialThinGlass, bellJar()}}),
              still_life::add(onLace, {0.0, cakeStandHeight + 0.0002, 0.0}));
    return glb.write(file, std::string(head) + std::string(materials) + nodes.scene());
}

} // namespace

int main(int argumentCount, char **arguments) {
    if (argumentCount != 3 || std::strcmp(arguments[1], "--output") != 0) {
        std::fputs("usage: make_tea_table --output FILE\n", stderr);
        return exitUsage;
    }
    if (!writeTable(arguments[2])) {
        std::fprintf(stderr, "make_tea_table: %s could not be written\n", arguments[2]);
        return exitOutput;
    }
    return 0;
}
