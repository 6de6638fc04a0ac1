#include "host/cli/statistical.h"

#include "host/base/message.h"
#include "host/cli/options.h"
#include "host/image/exr.h"

#include <fmt/format.h>

#include <cmath>

namespace hyalite::core {

CLI::Option *addSignificanceOption(CLI::App &command, WelchOptions &options) {
    return addNumber(command, "--significance", options.significance, Interval{0.0, 1.0, false, false},
                     "probability that --statistical fails although both estimate one picture")
        ->default_str("0.01");
}

Estimate readEstimate(const std::string &path) {
    const InputFile file(path);
    if (!isExr(file.head(4)))
        throw file.bad("--statistical needs the variance of an EXR file; render one with -o FILE.exr");
    Estimate estimate{readExr(file), readExr(file, "variance"), std::nullopt};
    if (hasExrLayer(file, "samples"))
        estimate.counts = readExr(file, "samples");
    return estimate;
}

WelchResult testAndPrint(const Estimate &a, const Estimate &b, const WelchOptions &options,
                         const std::string &names) {
    const WelchResult result = welchTest(a, b, options);
    if (result.testCount == 0)
        throw Error(ErrorKind::BadInput,
                    fmt::format("{}: no pixel can be tested: each needs a variance, of {} samples at least",
                                names, options.minSampleCount));
    printResult("tests        {} of channels of pixels and of the image, {} untested; significance {:g}\n",
                result.testCount, result.untestedCount, options.significance);
    const glm::vec3 &meanA = a.mean.at(result.x, result.y);
    const glm::vec3 &meanB = b.mean.at(result.x, result.y);
    const auto deviation = [&](const Estimate &estimate) {
        return std::sqrt(static_cast<double>(estimate.variance.at(result.x, result.y)[result.channel]));
    };
    printResult("largest      |z| = {:.2f} at ({}, {}), {}: {:.6g} +- {:.2g} and {:.6g} +- {:.2g}\n",
                result.largest, result.x, result.y, "RGB"[result.channel], meanA[result.channel],
                deviation(a), meanB[result.channel], deviation(b));
    printResult("image        z = {:.2f}, {:.2f}, {:.2f} of the means of R, G, B\n", result.ofImage[0],
                result.ofImage[1], result.ofImage[2]);
    printResult("failing      {} with |z| above {:.2f}\n", result.failureCount, result.threshold);
    printResult("{}\n", result.isPassed() ? "no difference is significant" : "NOT estimates of one picture");
    return result;
}

std::string failureOf(const WelchResult &result) {
    return result.isPassed()
               ? ""
               : fmt::format(
                     "NOT estimates of one picture: |z| is above {:.2f} in {} of {} tests, at most {:.2f}",
                     result.threshold, result.failureCount, result.testCount, result.largest);
}

nlohmann::ordered_json welchToJson(const WelchResult &result, const WelchOptions &options) {
    nlohmann::ordered_json json{
        {"significance", options.significance},
        {"minSamples", options.minSampleCount},
        {"tests", result.testCount},
        {"untested", result.untestedCount},
        {"threshold", result.threshold},
        {"failing", result.failureCount},
        {"largest", nullptr},
        {"at", {{"x", result.x}, {"y", result.y}, {"channel", std::string(1, "RGB"[result.channel])}}},
        {"image", result.ofImage}};
    if (std::isfinite(result.largest))
        json["largest"] = result.largest;
    return json;
}

} // namespace hyalite::core
