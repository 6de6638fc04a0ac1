// Glass around the plain path tracer's paths, where solids lie in each other or overlap: Schmidt and Budge, "Simple
// Nested Dielectrics in Ray Traced Images", JGT 7(2), 2002.
#pragma once

#include "tests/images/plain_geometry.h"

#include <optional>
#include <vector>

namespace hyalite::core::testing::plain {

/// How many surfaces of each material of glass a path has entered and not left.
class Media {
  public:
    /// What is around the eye of the scene's camera: the oracle knows of spheres.
    explicit Media(const Scene &scene);

    /// The glass of highest priority, of equal ones the first in the scene; or none.
    [[nodiscard]] const Material *around() const;

    /// Light is of this wavelength from now on, in micrometres.
    void setWavelength(double wavelength) { wavelength_ = wavelength; }

    /// Refractive index of what is around: without a wavelength that of yellow light.
    [[nodiscard]] double index() const;

    /// What is left of light after a distance in what is around: Beer's law.
    [[nodiscard]] Vec transmittance(double distance) const;

    void enter(std::uint32_t materialIndex) { ++counts_[materialIndex]; }
    void leave(std::uint32_t materialIndex) { --counts_[materialIndex]; }
    [[nodiscard]] bool isIn(std::uint32_t materialIndex) const { return counts_[materialIndex] > 0; }

  private:
    const Scene *scene_;
    std::optional<double> wavelength_;
    std::vector<int> counts_;
};

/// Both sides of a surface of glass.
struct Crossing {
    Media before;
    Media beyond;

    [[nodiscard]] double indexRatio() const { return before.index() / beyond.index(); }
    /// Whether glass of higher priority is on both sides, or equal indices: light passes as if nothing were there.
    [[nodiscard]] bool isNullInterface() const {
        return before.around() == beyond.around() || indexRatio() == 1.0;
    }
};

/// Leaving glass that was not entered changes nothing.
[[nodiscard]] Crossing crossing(const Media &around, std::uint32_t materialIndex, bool isEntering);

} // namespace hyalite::core::testing::plain
