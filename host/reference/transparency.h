// Transparency of a sample: the share of the background in it, which the picture leaves out. Twin:
// shaders/integrators/alpha.glsl.
#pragma once

#include "host/leaves/leaves.h"
#include "shaders/layout/layout.h"

#include <cstdint>

namespace hyalite::core::reference {
using namespace leaves;

template <class Real> class Transparency {
  public:
    /// `alphaKind` is one of layout::alpha...
    explicit Transparency(std::uint32_t alphaKind) : alphaKind_(alphaKind) {}

    /// A path begins.
    void begin() { value_ = alphaKind_ == layout::alphaOfNothing ? Real(0) : Real(-1); }
    /// Whether the path sees the background, if it meets nothing more.
    [[nodiscard]] bool seesThrough() const { return value_ < 0; }
    [[nodiscard]] bool seesThroughGlass() const {
        return seesThrough() && alphaKind_ == layout::alphaThroughGlass;
    }
    /// The path has met a surface.
    void meetSurface() {
        if (alphaKind_ == layout::alphaOfBackground)
            endSeeingThrough();
    }
    /// The path goes on from what is not transparent.
    void endSeeingThrough() {
        if (seesThrough())
            value_ = 0;
    }
    /// The path has arrived where the picture is transparent.
    void become(const Vec3<Real> &throughput) { value_ = meanComponent(throughput); }
    /// Of the finished sample.
    [[nodiscard]] Real ofSample() const { return greater(value_, Real(0)); }

  private:
    std::uint32_t alphaKind_;
    Real value_ = 0;
};

} // namespace hyalite::core::reference
