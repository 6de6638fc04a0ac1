#include "host/report/render_report.h"

#include "host/film/partition.h"

#include "host/base/json_text.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hyalite::core {

nlohmann::ordered_json raysToJson(const RayCounts &rays) {
    nlohmann::ordered_json json;
    for (const RayKind &kind : rayKinds)
        json[kind.name] = rays.*kind.count;
    json["total"] = rays.total();
    return json;
}

nlohmann::ordered_json namesToJson(const std::vector<std::string> &names) {
    // As a list of its entries: the object would look each name up.
    nlohmann::ordered_json::object_t json;
    json.reserve(names.size());
    for (std::size_t i = 0; i < names.size(); ++i)
        json.Container::emplace_back(std::to_string(i + 1), names[i]);
    return json;
}

FinishedWork finishedWork(const Film &film, std::span<const Crop> squares, int samplesPerPixel) {
    FinishedWork finished;
    finished.fewestSamples = std::numeric_limits<std::uint32_t>::max();
    visitRowsIn(film, squares, [&](std::span<const layout::FilmPixel> row) {
        finished.wantedPixelCount += row.size();
        for (const layout::FilmPixel &pixel : row) {
            finished.pixelCount += pixel.sampleCount == static_cast<std::uint32_t>(samplesPerPixel);
            finished.sampleCount += pixel.sampleCount;
            finished.fewestSamples = std::min(finished.fewestSamples, pixel.sampleCount);
            finished.mostSamples = std::max(finished.mostSamples, pixel.sampleCount);
        }
    });
    finished.isComplete = finished.pixelCount == finished.wantedPixelCount;
    return finished;
}

FinishedWork finishedWork(const Film &film, std::span<const Crop> squares, const RenderSettings &settings) {
    FinishedWork finished = finishedWork(film, squares, settings.samplesPerPixel);
    if (isAdaptive(settings)) {
        finished.noise = noiseOf(film, blocksInFilm(film.crop, squares), noiseTargetOf(settings));
        finished.pixelCount = finished.noise->finishedPixels;
        finished.isComplete = finished.pixelCount == finished.wantedPixelCount;
    }
    return finished;
}

namespace {

/// Null for what is not known yet.
nlohmann::ordered_json numberOrNull(double number) {
    return std::isfinite(number) ? nlohmann::ordered_json(number) : nlohmann::ordered_json();
}

} // namespace

nlohmann::ordered_json noiseToJson(const PictureNoise &noise, double wanted) {
    return {{"wanted", wanted},
            {"highest", numberOrNull(noise.highest)},
            {"mean", numberOrNull(noise.mean)},
            {"blocks", noise.blockCount},
            {"blocksAtTarget", noise.atTarget},
            {"blocksAtLimit", noise.atLimit}};
}

std::string formatReport(const RenderReport &report) {
    nlohmann::ordered_json json = provenanceToJson(report.origin, report.device);
    json["output"] = report.output;
    nlohmann::ordered_json &finished = json["finished"];
    finished = {{"isComplete", report.finished.isComplete},
                {"pixels", report.finished.pixelCount},
                {"samples", report.finished.sampleCount},
                {"fewestSamples", report.finished.fewestSamples},
                {"mostSamples", report.finished.mostSamples},
                {"noise", nullptr},
                {"stoppedBy", nullptr}};
    if (report.finished.noise)
        finished["noise"] = noiseToJson(*report.finished.noise, report.origin.settings.noise);
    if (!report.stoppedBy.empty())
        finished["stoppedBy"] = report.stoppedBy;
    json["resumed"] = nullptr;
    if (report.resumed)
        json["resumed"] = {{"checkpoint", report.resumed->checkpoint},
                           {"samples", report.resumed->sampleCount},
                           {"rays", raysToJson(report.resumed->rays)}};
    json["denoised"] = nullptr;
    if (!report.denoiser.empty())
        json["denoised"] = report.denoiser;
    json["faults"] = report.faults;
    if (!report.shares.empty()) {
        json["shares"] = nlohmann::ordered_json::array();
        for (const RendererShare &share : report.shares)
            json["shares"].push_back(
                {{"name", share.name},
                 {"tiles", share.tileCount},
                 {"samples", share.sampleCount},
                 {"seconds", share.seconds},
                 {"failure",
                  share.failure.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(share.failure)}});
    }
    for (const auto &[layer, names] : report.numbers)
        json["numbers"][layer] = namesToJson(names);
    json["noisiest"] = nlohmann::ordered_json::array();
    for (const NoisyPixelReport &pixel : report.noisiest)
        json["noisiest"].push_back({{"pixel", {pixel.x, pixel.y}},
                                    {"noise", pixel.noise},
                                    {"sample", pixel.sample},
                                    {"radiance", {pixel.radiance.x, pixel.radiance.y, pixel.radiance.z}},
                                    {"share", pixel.share},
                                    {"path", pixel.path}});
    json["rays"] = raysToJson(report.rays);
    json["dispatches"] = report.timing.dispatchCount;
    json["deviceBytes"] = nullptr;
    if (report.deviceBytes > 0)
        json["deviceBytes"] = report.deviceBytes;
    json["seconds"] = {{"load", report.loadSeconds},
                       {"build", report.buildSeconds},
                       {"upload", report.timing.uploadSeconds},
                       {"pipeline", report.timing.pipelineSeconds},
                       {"render", report.timing.renderSeconds},
                       {"denoise", report.denoiseSeconds},
                       {"write", report.writeSeconds},
                       {"total", report.totalSeconds}};
    return jsonText(json);
}

} // namespace hyalite::core
