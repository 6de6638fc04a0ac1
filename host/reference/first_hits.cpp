#include "host/reference/first_hits.h"

#include "host/reference/closest_hit.h"

#include <vector>

namespace hyalite::core::reference {

void visitFirstHits(const PackedScene &scene, const Crop &crop, const VisitRow &visit) {
    SceneView<float> view(scene, layout::samplerCentre);
    if ((view.camera & layout::kindOfCamera) == layout::cameraLens)
        view.camera = (view.camera & ~layout::kindOfCamera) | layout::cameraPinhole;
#pragma omp parallel for schedule(dynamic)
    for (int y = crop.y0; y < crop.y1; ++y) {
        std::vector<std::uint32_t> primitives;
        NoCounter counter;
        for (int x = crop.x0; x < crop.x1; ++x) {
            const glm::uvec2 pixel(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
            const auto primary = primaryRay(view, pixel, 0);
            const Ray<float> ray{primary.origin, primary.direction, layout::noPrimitive, {pixel, 0, 2}};
            primitives.push_back(closestHit(view, ray, counter).primitive);
        }
#pragma omp critical(hyaliteFirstHits)
        visit(y, primitives);
    }
}

} // namespace hyalite::core::reference
