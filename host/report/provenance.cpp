#include "host/report/provenance.h"

#include "host/base/clean_text.h"
#include "host/base/hash.h"
#include "host/base/version.h"
#include "host/scene/settings_table.h"

#include <algorithm>

namespace hyalite::core {

namespace {

void appendAttributes(std::vector<Attribute> &attributes, const std::string &path,
                      const nlohmann::ordered_json &value) {
    if (value.is_object()) {
        for (const auto &[key, part] : value.items())
            appendAttributes(attributes, path.empty() ? key : path + "." + key, part);
        return;
    }
    attributes.emplace_back(path == "program" ? "software" : path,
                            cleanText(value.is_string() ? value.get<std::string>() : value.dump()));
}

} // namespace

nlohmann::ordered_json programToJson(const std::string &commandLine) {
    return {{"program", "hyalite " HYALITE_VERSION}, {"commandLine", commandLine}};
}

nlohmann::ordered_json provenanceToJson(const Provenance &provenance) {
    nlohmann::ordered_json json = programToJson(provenance.commandLine);
    json["scene"] = provenance.scene;
    json["sceneHash"] = hashText(provenance.sceneHash);
    json["triangles"] = provenance.triangleCount;
    if (const glm::dvec3 &origin = provenance.coordinateOrigin; origin != glm::dvec3(0.0))
        json["origin"] = {origin.x, origin.y, origin.z};
    json["image"] = {{"width", provenance.width}, {"height", provenance.height}};
    json["settings"] = settingsToJson(provenance.settings);
    return json;
}

nlohmann::ordered_json provenanceToJson(const Provenance &provenance, const RendererIdentity &device) {
    nlohmann::ordered_json json = provenanceToJson(provenance);
    json["device"] = rendererToJson(device);
    return json;
}

nlohmann::ordered_json rendererToJson(const RendererIdentity &renderer) {
    nlohmann::ordered_json json{{"name", renderer.name},
                                {"driver", renderer.driver},
                                {"arithmetic", renderer.arithmetic},
                                {"equalBits", renderer.equalBits}};
    if (!renderer.kernel.empty())
        json["kernel"] = {{"name", renderer.kernel}, {"spirvHash", hashText(renderer.kernelHash)}};
    return json;
}

std::vector<Attribute> attributesOf(const nlohmann::ordered_json &provenance) {
    std::vector<Attribute> attributes;
    appendAttributes(attributes, "", provenance);
    return attributes;
}

bool hasKnownAttributes(const nlohmann::ordered_json &provenance) {
    Provenance all;
    all.coordinateOrigin = glm::dvec3(1.0);
    RendererIdentity renderer;
    renderer.kernel = "any";
    const std::vector<Attribute> known = attributesOf(provenanceToJson(all, renderer));
    return std::ranges::all_of(attributesOf(provenance), [&](const Attribute &attribute) {
        return std::ranges::find(known, attribute.first, &Attribute::first) != known.end();
    });
}

} // namespace hyalite::core
