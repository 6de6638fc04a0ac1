#include "host/lab/verify_report.h"

#include "host/base/hash.h"
#include "host/lab/comparison_run.h"
#include "host/report/junit.h"
#include "host/report/provenance.h"
#include "host/scene/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace hyalite::core {

namespace {

nlohmann::ordered_json toJson(const FilmVerdict &verdict) {
    nlohmann::ordered_json json;
    json["scene"] = verdict.film.scene;
    json["integrator"] = nameOf(verdict.film.integrator);
    if (!verdict.kernel.empty())
        json["kernel"] = verdict.kernel;
    if (verdict.isSkipped()) {
        json["skipped"] = verdict.lack;
        return json;
    }
    json["seconds"] = verdict.seconds;
    json["hash"] = hashText(verdict.hash);
    json["shippedHash"] = hashText(verdict.film.hash);
    json["isEqual"] = verdict.hash == verdict.film.hash;
    if (!verdict.failure.empty())
        json["failure"] = verdict.failure;
    if (!verdict.difference)
        return json;
    const FilmDifference &difference = *verdict.difference;
    nlohmann::ordered_json found;
    found["differingPixels"] = difference.pixelCount;
    if (difference.pixelCount > 0)
        found.update(divergenceToJson(difference.pixel, difference.divergence));
    if (const auto &dispatch = difference.dispatch)
        found["tile"] = {{"x", dispatch->tileX},
                         {"y", dispatch->tileY},
                         {"width", dispatch->tileWidth},
                         {"height", dispatch->tileHeight}};
    json["differenceFromCpu"] = found;
    return json;
}

TestCase toCase(const DeviceVerdict &device, const FilmVerdict &verdict) {
    TestCase test{device.device,
                  nameOf(verdict.film) + (verdict.kernel.empty() ? std::string() : ", " + verdict.kernel),
                  verdict.seconds};
    if (verdict.isSkipped())
        test.skipped = verdict.lack;
    else if (verdict.isFaulty())
        test.failure = !verdict.failure.empty() ? verdict.failure : describe(*verdict.difference);
    return test;
}

} // namespace

std::string nameOf(const ShippedFilm &film) {
    return fmt::format("{}, {}", film.scene, nameOf(film.integrator));
}

std::string describe(const FilmDifference &difference) {
    if (difference.pixelCount == 0)
        return "it equals the CPU's film, whose bits are not the shipped ones: this build of the program "
               "computes otherwise";
    std::string text = fmt::format("{} pixels differ from the CPU's", difference.pixelCount);
    if (const auto &dispatch = difference.dispatch)
        text += fmt::format("; tile ({}, {}) of {}x{}", dispatch->tileX, dispatch->tileY, dispatch->tileWidth,
                            dispatch->tileHeight);
    text += fmt::format("; pixel ({}, {})", difference.pixel.x, difference.pixel.y);
    if (const auto &divergence = difference.divergence)
        return text + fmt::format(", sample {}, bounce {}: {}: {} on the device, {} on the CPU",
                                  divergence->sampleIndex, divergence->rayDepth - 1, divergence->quantity,
                                  divergence->valueA, divergence->valueB);
    return text + ": the paths agree in every step; what differs is how work is cut or summed";
}

std::string verificationToJunit(std::span<const DeviceVerdict> devices) {
    std::vector<TestSuite> suites;
    for (const DeviceVerdict &device : devices) {
        TestSuite suite{device.description, {}};
        for (const FilmVerdict &film : device.films)
            suite.cases.push_back(toCase(device, film));
        suites.push_back(std::move(suite));
    }
    return junitText("hyalite verify", suites);
}

nlohmann::ordered_json verificationToJson(const ShippedFilms &shipped, std::span<const DeviceVerdict> devices,
                                          const std::string &commandLine) {
    nlohmann::ordered_json json = programToJson(commandLine);
    json["filmsVersion"] = shipped.version;
    json["devices"] = nlohmann::ordered_json::array();
    for (const DeviceVerdict &device : devices) {
        nlohmann::ordered_json entry;
        entry["name"] = device.device;
        entry["description"] = device.description;
        entry["equalBits"] = gpu::describe(device.bits);
        entry["passed"] = device.isPassed();
        entry["films"] = nlohmann::ordered_json::array();
        for (const FilmVerdict &film : device.films)
            entry["films"].push_back(toJson(film));
        json["devices"].push_back(entry);
    }
    json["passed"] = std::ranges::all_of(devices, &DeviceVerdict::isPassed);
    return json;
}

} // namespace hyalite::core
