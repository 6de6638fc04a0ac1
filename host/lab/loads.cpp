#include "host/lab/loads.h"

#include "host/base/json_document.h"
#include "host/base/json_reader.h"
#include "host/import/assets.h"
#include "host/lab/shipped_films.h"
#include "host/scene/limits.h"
#include "host/scene/names.h"

#include <array>

namespace hyalite::core {

namespace {

constexpr Interval sides{8, 4096};
constexpr Interval sampleCounts{1, 4096};
constexpr std::size_t maxLoadCount = 100;

LoadSize readSize(const JsonNode &node) {
    constexpr std::array<std::string_view, 4> keys{"width", "height", "samplesPerPixel", "hash"};
    const JsonObject object(node, keys);
    return {static_cast<int>(object.at("width").wholeNumber(sides)),
            static_cast<int>(object.at("height").wholeNumber(sides)),
            static_cast<int>(object.at("samplesPerPixel").wholeNumber(sampleCounts)),
            readHash(object.at("hash"))};
}

Load readLoad(const JsonNode &node) {
    constexpr std::array<std::string_view, 5> keys{"name", "scene", "integrator", "small", "large"};
    const JsonObject object(node, keys);
    return {object.text("name"), object.text("scene"), object.choice("integrator", integratorNames),
            readSize(object.at("small")), readSize(object.at("large"))};
}

} // namespace

Loads readLoads() {
    Loads loads;
    const std::filesystem::path file = shippedFile("verify/loads.json");
    loads.folder = file.parent_path();
    const std::string fileName = file.string();
    const nlohmann::json document = readJsonFile(file);
    constexpr std::array<std::string_view, 2> keys{"version", "loads"};
    const JsonObject object({&document, &fileName}, keys);
    loads.version = readVersion(object);
    for (const JsonNode &load : object.elements("loads", maxLoadCount))
        loads.loads.push_back(readLoad(load));
    if (loads.loads.empty())
        object.at("loads").refuse("at least one load");
    return loads;
}

PreparedScene prepareLoad(const Loads &loads, const Load &load, const LoadSize &size) {
    SceneOptions options;
    options.scene = (loads.folder / (load.scene + ".json")).string();
    options.width = size.width;
    options.height = size.height;
    options.settings.push_back({[&](RenderSettings &settings) {
        settings.integrator = load.integrator;
        settings.samplesPerPixel = size.samplesPerPixel;
    }});
    return prepareScene(options, Source::Dropped, nobody());
}

} // namespace hyalite::core
