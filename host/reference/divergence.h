// First difference between two renderers.
#pragma once

#include "shaders/layout/layout.h"

#include <optional>
#include <string>
#include <vector>

namespace hyalite::core {

/// The first step of a path at which two traces differ in any bit.
struct Divergence {
    std::uint32_t sampleIndex = 0;
    std::uint32_t rayDepth = 0; ///< segment number of the ray: 1 for a primary ray
    std::string quantity;       ///< "hit primitive", "surface normal", ...
    std::string valueA;         ///< in decimal and, for floats, in hexadecimal
    std::string valueB;
    /// A decision went the other way: another primitive, another visibility, total reflection.
    bool isDiscrete = false;
    std::uint32_t eventIndex = 0; ///< in both traces
};

/// A step of a path, in words.
struct TraceStep {
    std::uint32_t rayDepth = 0; ///< segment number of the ray: 1 for a primary ray
    std::string quantity;       ///< "hit", "surface normal", ...
    std::string value;          ///< in decimal and, for floats, in hexadecimal
};

/// The steps of a trace; arguments as below.
[[nodiscard]] std::vector<TraceStep> describeTrace(const std::vector<layout::TraceEvent> &trace,
                                                   std::uint32_t firstTriangleId,
                                                   const glm::dvec3 &origin = glm::dvec3(0.0));

/// Compares two traces of the same sample, step by step. `firstTriangleId` is that of the scene's frame. Points are
/// told in the coordinates of its file: those of the scene + `origin`.
[[nodiscard]] std::optional<Divergence> findDivergence(const std::vector<layout::TraceEvent> &a,
                                                       const std::vector<layout::TraceEvent> &b,
                                                       std::uint32_t firstTriangleId,
                                                       const glm::dvec3 &origin = glm::dvec3(0.0));

/// The first step at which a decision differs, whatever the rounding of the numbers around it.
[[nodiscard]] std::optional<Divergence> findDiscreteDivergence(const std::vector<layout::TraceEvent> &a,
                                                               const std::vector<layout::TraceEvent> &b,
                                                               std::uint32_t firstTriangleId);

} // namespace hyalite::core
