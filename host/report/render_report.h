// Report of a render, as JSON.
#pragma once

#include "host/film/film.h"
#include "host/film/noise.h"
#include "host/film/ray_counts.h"
#include "host/film/render_timing.h"
#include "host/report/provenance.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hyalite::core {

/// The finished part of an image, or of a part of one.
struct FinishedWork {
    std::uint64_t wantedPixelCount = 0;
    std::uint64_t pixelCount = 0; ///< with all of their samples
    std::uint64_t sampleCount = 0;
    std::uint32_t fewestSamples = 0; ///< of a pixel
    std::uint32_t mostSamples = 0;
    bool isComplete = false;             ///< all samples of all pixels are
    std::optional<PictureNoise> noise{}; ///< of an adaptive render

    [[nodiscard]] double meanSamples() const {
        return wantedPixelCount > 0 ? static_cast<double>(sampleCount) / static_cast<double>(wantedPixelCount)
                                    : 0.0;
    }
};

/// The finished samples of these squares of `film`, of `samplesPerPixel` samples in each pixel.
[[nodiscard]] FinishedWork finishedWork(const Film &film, std::span<const Crop> squares, int samplesPerPixel);

/// The same of a picture with these settings. The squares of an adaptive one are of whole blocks (noise.h).
[[nodiscard]] FinishedWork finishedWork(const Film &film, std::span<const Crop> squares,
                                        const RenderSettings &settings);

/// A noisy pixel of the whole image.
struct NoisyPixelReport {
    int x = 0;
    int y = 0;
    double noise = 0.0;              ///< relative standard deviation of its mean, as of independent samples
    std::uint32_t sample = 0;        ///< the brightest one
    glm::vec3 radiance{0.0f};        ///< of it
    double share = 0.0;              ///< of it in the sum of all samples
    std::vector<std::string> path{}; ///< of it: what it met, from the eye on, and where its light came from
};

/// The checkpoint that a render continued.
struct ResumedWork {
    std::string checkpoint; ///< path of the file
    std::uint64_t sampleCount = 0;
    RayCounts rays;
};

struct RenderReport {
    Provenance origin;
    RendererIdentity device;
    std::string output;
    FinishedWork finished;
    /// Failed Vulkan calls; the render continued after each, except perhaps the last.
    std::vector<std::string> faults;
    std::string stoppedBy; ///< what ended the render early, or empty
    std::optional<ResumedWork> resumed;
    std::string denoiser;              ///< that made the colours of the file, or empty
    std::vector<RendererShare> shares; ///< of several renderers, if there are several
    /// Of layers of numbers: the layer's name, and the names of the numbers from 1 on.
    std::vector<std::pair<std::string, std::vector<std::string>>> numbers;
    std::vector<NoisyPixelReport> noisiest{}; ///< pixels, the noisiest first
    RayCounts rays;                           ///< traced for the image, before and now
    std::uint64_t deviceBytes = 0;            ///< peak memory on a device; 0: on the CPU
    double loadSeconds = 0.0;
    double buildSeconds = 0.0;
    RenderTiming timing;
    double denoiseSeconds = 0.0;
    double writeSeconds = 0.0;
    double totalSeconds = 0.0;
};

/// JSON for reports.
[[nodiscard]] nlohmann::ordered_json raysToJson(const RayCounts &rays);
/// An object of names by their numbers, from 1 on.
[[nodiscard]] nlohmann::ordered_json namesToJson(const std::vector<std::string> &names);

/// Of a picture that was to have this noise; null where it is not known yet.
[[nodiscard]] nlohmann::ordered_json noiseToJson(const PictureNoise &noise, double wanted);

[[nodiscard]] std::string formatReport(const RenderReport &report);

} // namespace hyalite::core
