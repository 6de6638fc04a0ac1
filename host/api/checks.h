// Checks: devices, comparisons, profiles and verification. Each result has all of its figures as JSON, the same that
// the command line's reports have.
#pragma once

#include "hyalite/renderer.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace hyalite {

/// A device as the JSON of `hyalite devices` tells of it.
struct Device {
    std::string name;
    std::string type;   ///< "discrete GPU", "software", "reference renderer", ...
    std::string driver; ///< name and version
    bool isUsable = false;
    std::string json; ///< all that is known of it
};

/// The Vulkan devices, by index, and last the CPU twin. Throws Error{NoDevice} if Vulkan has none.
[[nodiscard]] HYALITE_API std::vector<Device> devices();

/// How two images differ.
struct Difference {
    bool isIdentical = false; ///< in every bit
    std::uint64_t differingPixels = 0;
    double psnrDecibels = 0.0;    ///< for a peak of 1; infinite for no error
    std::optional<double> ssim{}; ///< mean structural similarity; none for a side below 11 pixels, or NaN
    double flip = 0.0;            ///< mean FLIP error: HDR-FLIP of linear images
    int width = 0;
    int height = 0;
    std::vector<float> flipMap{};  ///< height x width, in [0, 1]
    std::vector<float> ssimMap{};  ///< height x width: of the window around each pixel; NaN near the edges
    std::vector<float> errorMap{}; ///< height x width: the squared error of the pixel, as PSNR has it
    std::string json{};            ///< all metrics
    double alphaMax = 0.0;         ///< largest difference of alpha; of opaque images 0
    double alphaMean = 0.0;        ///< mean absolute difference of alpha
};

/// Compares images of one size; the first is the reference. Beside one that is display-encoded, a linear one is taken
/// as a PNG of it would be. Colours are compared over black; an image without alpha is opaque. Throws Error{Usage} for two sizes.
[[nodiscard]] HYALITE_API Difference diff(const Image &reference, const Image &test);

/// Two renders of one scene.
struct Comparison {
    bool isEqual = false; ///< bit for bit
    Image first;
    Image second;
    Difference difference; ///< second is the reference
    std::string json;      ///< with both renderers and, if they differ, the first step of a path that does
};

/// Renders the scene by two renderers that are opened for it. Throws as Renderer does.
[[nodiscard]] HYALITE_API Comparison compare(const Scene &scene, const Settings &settings = {},
                                             const std::string &device = "auto",
                                             const std::string &against = "cpu", const Watch &watch = {});

struct ProfileOptions {
    std::string device = "auto";
    int warmups = 1;
    int repeats = 5;
    bool countsWork = false; ///< renders twice more: counts the work of the rays
    bool isUnverified = false;
    std::optional<double> timeLimitSeconds{};
    Watch watch{};
};

struct Profile {
    double medianMillis = 0.0;         ///< of a measured frame
    std::vector<double> frameMillis{}; ///< of each
    double megaraysPerSecond = 0.0;    ///< of the median frame
    std::string json{};                ///< the report of `hyalite profile`
};

/// Measures renders of the scene. Throws as Renderer does, and Error{DeviceLost} if the device differs from the CPU
/// twin.
[[nodiscard]] HYALITE_API Profile profile(const Scene &scene, const Settings &settings = {},
                                          const ProfileOptions &options = {});

/// What a scene is made of, as JSON: bounds, cameras, nodes, materials, lights and more, by the keys of the document of
/// `hyalite inspect`; and, if it is asked for, which objects cover which share of the picture. Throws as Renderer does.
[[nodiscard]] HYALITE_API std::string inspect(const Scene &scene, const Settings &settings = {},
                                              bool withCoverage = false, const Watch &watch = {});

struct Verification {
    bool isPassed = false; ///< each film that a kernel of it can render has the shipped bits
    std::string json{};    ///< the report of `hyalite verify`
};

/// Renders the shipped films by "cpu" or a device, with these kernels (none: all), and compares them with the shipped
/// hashes.
[[nodiscard]] HYALITE_API Verification verify(const std::string &device = "auto",
                                              const std::vector<std::string> &kernels = {},
                                              const Watch &watch = {});

} // namespace hyalite
