#include "host/report/render_report.h"

#include "host/report/json_text.h"
#include "host/scene/names.h"
#include "host/version.h"

namespace hyalite {

std::string formatReport(const RenderReport &report) {
    nlohmann::ordered_json json;
    json["program"] = "hyalite " HYALITE_VERSION;
    json["commandLine"] = report.commandLine;
    json["scene"] = report.scene;
    json["output"] = report.output;
    json["device"] = {
        {"name", report.deviceName}, {"driver", report.deviceDriver}, {"arithmetic", report.arithmetic}};
    json["image"] = {{"width", report.width}, {"height", report.height}};
    const RenderSettings &settings = report.settings;
    json["settings"] = {{"integrator", nameOf(settings.integrator)},
                        {"spp", settings.samplesPerPixel},
                        {"maxDepth", settings.maxDepth},
                        {"bvh", nameOf(settings.tree)},
                        {"leafSize", settings.leafSize},
                        {"sampler", nameOf(settings.sampler)},
                        {"seed", settings.seed},
                        {"exposure", settings.exposureStops}};
    json["triangles"] = report.triangleCount;
    json["rays"] = {{"primary", report.rays.primary},
                    {"shadow", report.rays.shadow},
                    {"reflection", report.rays.reflection},
                    {"refraction", report.rays.refraction},
                    {"total", report.rays.total()}};
    json["dispatches"] = report.timing.dispatchCount;
    json["seconds"] = {{"load", report.loadSeconds},
                       {"build", report.buildSeconds},
                       {"upload", report.timing.uploadSeconds},
                       {"pipeline", report.timing.pipelineSeconds},
                       {"render", report.timing.renderSeconds},
                       {"write", report.writeSeconds},
                       {"total", report.totalSeconds}};
    return jsonText(json);
}

} // namespace hyalite
