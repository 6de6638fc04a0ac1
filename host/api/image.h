// Images: what a render gives. Pixels are linear float32 RGB, row by row from the top left.
#pragma once

#include "hyalite/version.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite {

/// A view of what primary rays meet, beside the colours: "albedo", "depth", "normal", ...
struct Layer {
    std::string name;
    std::string channels;          ///< a letter for each value of a pixel: "RGB", "XYZ", "Z"
    std::span<const float> values; ///< height x width x channels; it lives as long as the image
};

/// How an image is stored.
struct SaveOptions {
    std::string tone = "gamma"; ///< curve of a PNG: "gamma", "srgb", "aces" or "agx"
    bool half = false;          ///< colours of an EXR as 16-bit floats, at most 65504
    /// Of an EXR, by OpenEXR's names: "none", "rle", "zips", "zip" or "piz", which keep every bit; or "pxr24", "b44",
    /// "b44a", "dwaa" or "dwab", which are lossy.
    std::string compression = "zip";
    std::function<void(const std::string &text)> warning{}; ///< gets what the file has lost, a sentence each
};

/// Rays that were traced for an image.
struct RayCounts {
    std::uint64_t primary = 0;
    std::uint64_t shadow = 0;
    std::uint64_t reflection = 0;
    std::uint64_t refraction = 0;
    std::uint64_t bounce = 0;
};

/// A handle: copies share the same pixels, which do not change, so that all threads may read them.
class HYALITE_API Image {
  public:
    /// An image of one's own pixels: linear radiance, height x width x 3 numbers. Throws Error{Usage} unless there are
    /// so many, and at least one pixel.
    Image(int width, int height, std::span<const float> pixels);
    /// The same with alpha, height x width numbers in [0, 1], by which the pixels are multiplied already.
    Image(int width, int height, std::span<const float> pixels, std::span<const float> alpha);
    /// Reads colours and alpha of a PNG, OpenEXR, Radiance or PFM file. Throws Error{BadInput} and Error{LimitExceeded}.
    [[nodiscard]] static Image load(const std::string &path);

    [[nodiscard]] int width() const noexcept;
    [[nodiscard]] int height() const noexcept;

    /// Whether the numbers are those of a PNG: display-encoded, in [0, 1], instead of proportional to light.
    [[nodiscard]] bool isDisplayEncoded() const noexcept;

    /// The means of the samples, or the denoised colours if the settings ask for them: height x width x 3.
    [[nodiscard]] std::span<const float> pixels() const noexcept;
    /// Opacity, height x width; or empty if the image is opaque. `pixels` are multiplied by it (premultiplied) unless they
    /// are display-encoded.
    [[nodiscard]] std::span<const float> alpha() const noexcept;
    /// The unbiased estimate of the variance of the means of the samples; NaN below two samples a pixel. Of the same
    /// shape, or empty if the image was not rendered.
    [[nodiscard]] std::span<const float> variance() const;
    /// Samples of each pixel, height x width; or empty if the image was not rendered.
    [[nodiscard]] std::span<const std::uint32_t> samples() const;
    /// Those of light and of the denoiser, if the settings keep them, by their names in an EXR: "noisy", "denoising_albedo",
    /// ...; and those that were asked for, in that order.
    [[nodiscard]] const std::vector<Layer> &layers() const noexcept;

    /// Whether all samples are there: false if a callback or the time limit has ended the render.
    [[nodiscard]] bool isFinished() const noexcept;
    [[nodiscard]] RayCounts rays() const noexcept;
    /// Time in the renderer, in seconds, from the first ray to the last.
    [[nodiscard]] double seconds() const noexcept;
    /// What was rendered, how, and by what: a JSON object, as files have it in their attributes.
    [[nodiscard]] std::string provenance() const;

    /// Writes a .png, .exr, .hdr or .pfm file, which appears whole or not at all, as `hyalite render` does: an EXR has
    /// the layers, and the exposure is a PNG's; both have alpha. Throws Error{OutputNotWritten}, and Error{Usage} for
    /// other names.
    void save(const std::string &path, const std::string &tone = "gamma") const;
    void save(const std::string &path, const SaveOptions &options) const;
    /// The bytes of such a PNG.
    [[nodiscard]] std::string png(const std::string &tone = "gamma") const;

    struct Content; ///< of the library alone
    explicit Image(std::shared_ptr<const Content> content);
    [[nodiscard]] const Content &content() const noexcept { return *content_; }

  private:
    std::shared_ptr<const Content> content_;
};

} // namespace hyalite
