#include "host/farm/part_origin.h"

#include "host/base/clean_text.h"
#include "host/base/error.h"
#include "host/packing/light_planes.h"
#include "host/report/provenance.h"
#include "host/scene/names.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <unistd.h>

namespace hyalite::core {

namespace {

constexpr std::string_view denoiserPrefix = "denoising_"; // as the layers of files

/// Whether a word of a command line can be shown as it is.
bool isPlain(const std::string &word) {
    return std::ranges::none_of(word, [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 127; });
}

int sideOf(const nlohmann::ordered_json &value) {
    constexpr std::int64_t most = 1 << 20;
    if (!value.is_number_integer() || value.get<std::int64_t>() < 1 || value.get<std::int64_t>() > most)
        throw Error(ErrorKind::BadInput,
                    fmt::format("its picture cannot have a side of {} pixels", value.dump()));
    return static_cast<int>(value.get<std::int64_t>());
}

Projection projectionOf(const nlohmann::ordered_json &json) {
    Projection projection;
    for (const auto &[key, matrix] : {std::pair{"worldToCamera", &projection.worldToCamera},
                                      std::pair{"worldToNdc", &projection.worldToNdc}}) {
        const auto values = json.at(key).get<std::vector<double>>();
        if (values.size() != matrix->size())
            throw Error(ErrorKind::BadInput,
                        fmt::format("its {} has {} numbers, not 16", key, values.size()));
        std::ranges::copy(values, matrix->begin());
    }
    projection.screenWindowWidth = json.at("screenWindowWidth").get<double>();
    return projection;
}

} // namespace

std::string PartOrigin::maker() const {
    return fmt::format("{} ({})", excerpt(host, 80), excerpt(device, 160));
}

std::vector<Integrator> PartOrigin::views() const {
    std::vector<Integrator> views;
    for (const PartLayer &layer : layers)
        if (!layer.isOfDenoiser)
            views.push_back(layer.view);
    return views;
}

std::string hostName() {
    std::array<char, 256> name{};
    return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown host";
}

std::string toText(const PartOrigin &origin) {
    nlohmann::ordered_json json{{"host", origin.host},
                                {"folder", origin.folder},
                                {"words", origin.words},
                                {"wholeWidth", origin.wholeWidth},
                                {"wholeHeight", origin.wholeHeight},
                                {"layers", nlohmann::ordered_json::array()},
                                {"provenance", nlohmann::ordered_json::parse(origin.provenance)}};
    for (const PartLayer &layer : origin.layers) {
        json["layers"].push_back((layer.isOfDenoiser ? std::string(denoiserPrefix) : std::string()) +
                                 std::string(nameOf(layer.view)));
        if (!layer.names.empty())
            json["names"][std::string(nameOf(layer.view))] = layer.names;
    }
    if (!origin.lightPlanes.empty())
        json["lightPlanes"] = origin.lightPlanes;
    if (origin.projection)
        json["projection"] = {{"worldToCamera", origin.projection->worldToCamera},
                              {"worldToNdc", origin.projection->worldToNdc},
                              {"screenWindowWidth", origin.projection->screenWindowWidth}};
    return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

PartOrigin readPartOrigin(std::string_view text) {
    try {
        constexpr int deepest = 16;
        const nlohmann::ordered_json json =
            nlohmann::ordered_json::parse(text, [](int depth, auto, const nlohmann::ordered_json &) {
                if (depth > deepest)
                    throw Error(ErrorKind::BadInput,
                                "it does not say how it was made: it is nested too deeply");
                return true;
            });
        PartOrigin origin;
        origin.host = json.at("host").get<std::string>();
        origin.folder = json.at("folder").get<std::string>();
        origin.words = json.at("words").get<std::vector<std::string>>();
        if (origin.words.size() < 2 || origin.words[1] != "render" ||
            !std::ranges::all_of(origin.words, isPlain))
            throw Error(ErrorKind::BadInput, "it does not say by which render it was made");
        origin.wholeWidth = sideOf(json.at("wholeWidth"));
        origin.wholeHeight = sideOf(json.at("wholeHeight"));
        const nlohmann::ordered_json &provenance = json.at("provenance");
        if (!hasKnownAttributes(provenance))
            throw Error(ErrorKind::BadInput, "it says of itself what no render says");
        origin.provenance = provenance.dump();
        const auto integratorOf = [](const nlohmann::ordered_json &word) {
            const auto row =
                std::ranges::find(integratorTable, word.get<std::string>(), &IntegratorRow::name);
            if (row == integratorTable.end())
                throw Error(ErrorKind::BadInput, fmt::format("there is no integrator {}", word.dump()));
            return row->integrator;
        };
        for (const nlohmann::ordered_json &word : json.at("layers")) {
            const std::string name = word.get<std::string>();
            const bool isOfDenoiser = name.starts_with(denoiserPrefix);
            PartLayer layer{
                integratorOf(isOfDenoiser ? name.substr(denoiserPrefix.size()) : name), {}, isOfDenoiser};
            if (rowOf(layer.view).isOfNumbers() && json.contains("names"))
                layer.names = json.at("names").value(word.get<std::string>(), layer.names);
            origin.layers.push_back(std::move(layer));
        }
        origin.lightPlanes = json.value("lightPlanes", origin.lightPlanes);
        if (!std::ranges::all_of(origin.lightPlanes, isLightPlaneName))
            throw Error(ErrorKind::BadInput, "its layers of light have names that no render gives");
        if (json.contains("projection"))
            origin.projection = projectionOf(json.at("projection"));
        const nlohmann::ordered_json &settings = provenance.at("settings");
        origin.integrator = integratorOf(settings.at("integrator"));
        origin.exposureStops = settings.at("exposure").get<double>();
        origin.hasAlpha = settings.value("alpha", false); // older parts have neither this nor the next
        origin.areLayersThrough = settings.value("layersThrough", false);
        origin.isDenoised = settings.value("denoise", false);
        const nlohmann::ordered_json &device = provenance.at("device");
        origin.device = fmt::format("{}, {}", device.at("name").get<std::string>(),
                                    device.at("driver").get<std::string>());
        return origin;
    } catch (const nlohmann::json::exception &error) {
        throw Error(ErrorKind::BadInput, fmt::format("it does not say how it was made: {}", error.what()));
    }
}

} // namespace hyalite::core
