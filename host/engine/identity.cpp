#include "host/engine/identity.h"

#include "host/base/hash.h"
#include "host/film/noise.h"
#include "host/packing/light_planes.h"
#include "host/scene/names.h"
#include "host/scene/settings_table.h"

#include "shaders/embedded_kernels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace hyalite::core {

RenderIdentity identityOf(const PreparedScene &scene, const Backend &backend,
                          const std::vector<Integrator> *layers) {
    RenderIdentity identity;
    const layout::FrameRecord &frame = scene.packed.frame;
    const Crop &crop = scene.crop;
    identity.emplace_back("image", fmt::format("{}x{}", frame.imageWidth, frame.imageHeight));
    identity.emplace_back("crop", fmt::format("{},{},{},{}", crop.x0, crop.x1, crop.y0, crop.y1));
    for (const Setting &setting : settingsTable) {
        if (setting.changes != Changes::Samples)
            continue;
        const nlohmann::ordered_json value = settingToJson(setting, scene.loaded.settings);
        identity.emplace_back(setting.key, value.is_string() ? value.get<std::string>() : value.dump());
    }
    const RenderSettings &settings = scene.loaded.settings;
    if (settings.integrator == Integrator::Cost) // a picture of the tree
        identity.emplace_back("tree", fmt::format("{}, leaf size {}, {} instances", nameOf(settings.tree),
                                                  settings.leafSize, scene.packed.instances.size()));
    if (layers != nullptr) {
        std::vector<std::string_view> names;
        for (const Integrator layer : *layers)
            names.push_back(nameOf(layer));
        identity.emplace_back("layers", fmt::format("{}", fmt::join(names, ",")));
        if (std::ranges::any_of(*layers, [](Integrator layer) { return rowOf(layer).isOfNumbers(); }))
            identity.emplace_back("names", hashText(scene.packed.namesHash()));
    }
    identity.emplace_back("denoising data", keepsDenoisingData(settings) ? "true" : "false");
    if (isAdaptive(settings))
        identity.emplace_back("noise", fmt::format("in blocks of {0}x{0} pixels, seen by 2^{1}",
                                                   noiseBlockSide, stopsOfDarkness(settings)));
    if (settings.hasLightGroups)
        identity.emplace_back("light groups", hashText(lightGroupsHash(scene.packed)));
    identity.emplace_back("scene and camera", hashText(scene.contentHash()));
    identity.emplace_back("precision", backend.precision());
    identity.emplace_back("kernels of this program", pixelSources());
    return identity;
}

} // namespace hyalite::core
