#include "tests/bench/rendering.h"

#include "host/image/image_file.h"
#include "tests/bench/race.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace hyalite::core::bench {

namespace {

nlohmann::json readReport(const std::filesystem::path &file) {
    return nlohmann::json::parse(std::ifstream(file));
}

} // namespace

Rendering::Rendering(const Frame &frame, const Target &target)
    : arguments_{"render",   frame.scene,      "--quiet",  "--device",       target.device,
                 "--output", image().string(), "--report", report().string()},
      environment_(target.environment) {
    arguments_.insert(arguments_.end(), frame.options.begin(), frame.options.end());
    environment_.push_back("MESA_SHADER_CACHE_DIR=" + kernels().string());
}

double Rendering::run() {
    processSeconds_ = runHyalite(arguments_, environment_);
    if (areProcessorSecondsCounted())
        return processSeconds_;
    return readReport(report()).at("seconds").at("render").get<double>();
}

void Rendering::forgetKernels() { std::filesystem::remove_all(kernels()); }

Image Rendering::picture() const { return readImage(image()).image; }

double Rendering::rayCount() const { return readReport(report()).at("rays").at("total").get<double>(); }

std::string Rendering::driver() const {
    return readReport(report()).at("device").at("driver").get<std::string>();
}

bool haveEqualPictures(Rendering &rendering, Rendering &reference, benchmark::State &state) {
    reference.run();
    rendering.run();
    const bool areEqual = std::ranges::equal(rendering.picture().pixels(), reference.picture().pixels());
    if (!areEqual)
        state.SkipWithError("the image differs from the reference's");
    return areEqual;
}

} // namespace hyalite::core::bench
