#include "tests/bench/rendering.h"

#include "host/image/image_file.h"
#include "tests/bench/race.h"

#include <nlohmann/json.hpp>

#include <fstream>

namespace hyalite::bench {

namespace {

nlohmann::json readReport(const std::filesystem::path &file) {
    return nlohmann::json::parse(std::ifstream(file));
}

} // namespace

std::vector<std::string> argumentsOf(const Frame &frame, const std::string &deviceName,
                                     const std::filesystem::path &image) {
    std::vector<std::string> arguments{"render",   frame.scene, "--quiet",     "--device",
                                       deviceName, "--output",  image.string()};
    arguments.insert(arguments.end(), frame.options.begin(), frame.options.end());
    return arguments;
}

Rendering::Rendering(const Frame &frame, const std::string &deviceName)
    : arguments_(argumentsOf(frame, deviceName, image())) {
    arguments_.insert(arguments_.end(), {"--report", report().string()});
}

double Rendering::run() {
    processSeconds_.push_back(runHyalite(arguments_));
    if (areProcessorSecondsCounted())
        return processSeconds_.back();
    return readReport(report()).at("seconds").at("render").get<double>();
}

Image Rendering::picture() const { return readImage(image()).image; }

double Rendering::rayCount() const { return readReport(report()).at("rays").at("total").get<double>(); }

} // namespace hyalite::bench
