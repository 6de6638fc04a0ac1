#include "hyalite/settings.h"

#include "host/api/contents.h"
#include "host/engine/scene_options.h"
#include "host/scene/names.h"

#include <algorithm>

namespace hyalite {

namespace {

/// The command line's word for a name.
std::string wordOf(std::string name) {
    std::ranges::replace(name, '_', '-');
    return name;
}

/// The views that have layers, by their names.
std::vector<core::Name<core::Integrator>> viewNames() {
    std::vector<core::Name<core::Integrator>> names;
    for (const core::IntegratorRow &row : core::integratorTable)
        if (!row.layerChannels.empty())
            names.emplace_back(row.name, row.integrator);
    return names;
}

} // namespace

std::vector<std::string> settingNames() {
    std::vector<std::string> names;
    for (const std::string_view word : core::sceneOptionNames()) {
        std::string &name = names.emplace_back(word);
        std::ranges::replace(name, '-', '_');
    }
    return names;
}

core::SceneOptions sceneOptionsOf(const Scene &scene, const Settings &settings,
                                  const std::vector<std::string> &layers) {
    core::SceneOptions options;
    options.scene = scene.content()->source;
    options.document = scene.content()->document;
    for (const auto &[name, value] : settings.values())
        core::setSceneOption(options, wordOf(name), value.get());
    for (const std::string &layer : layers)
        options.views.push_back(core::chosenFrom(viewNames(), layer, "layers"));
    return options;
}

} // namespace hyalite
