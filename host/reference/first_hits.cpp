#include "host/reference/first_hits.h"

#include "host/reference/closest_hit.h"

#include <vector>

namespace hyalite::core::reference {

namespace {

FirstHit firstHit(const SceneView<float> &scene, const Ray<float> &ray) {
    NoCounter counter;
    const Hit<float> hit = closestHit(scene, ray, counter);
    if (hit.primitive == layout::noPrimitive)
        return {};
    const bool isOfTriangle = isTriangle(scene, hit.primitive);
    const double u = isOfTriangle ? double{hit.u} : 0.0;
    const double v = isOfTriangle ? double{hit.v} : 0.0;
    return {hit.primitive, u, v,
            isOfTriangle ? pointIn(hitTriangle(scene, hit), u, v)
                         : glm::dvec3(ray.origin) + glm::dvec3(ray.direction) * double{hit.distance}};
}

} // namespace

void visitFirstHits(const PackedScene &scene, const Crop &crop, const VisitRow &visit) {
    SceneView<float> view(scene, layout::samplerCentre);
    if ((view.camera & layout::kindOfCamera) == layout::cameraLens)
        view.camera = (view.camera & ~layout::kindOfCamera) | layout::cameraPinhole;
#pragma omp parallel for schedule(dynamic)
    for (int y = crop.y0; y < crop.y1; ++y) {
        std::vector<FirstHit> hits;
        for (int x = crop.x0; x < crop.x1; ++x) {
            const glm::uvec2 pixel(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y));
            const auto primary = primaryRay(view, pixel, 0);
            const Ray<float> ray{primary.origin, primary.direction, layout::noPrimitive, {pixel, 0, 2}};
            hits.push_back(firstHit(view, ray));
        }
#pragma omp critical(hyaliteFirstHits)
        visit(y, hits);
    }
}

} // namespace hyalite::core::reference
