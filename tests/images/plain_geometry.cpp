#include "tests/images/plain_geometry.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace hyalite::core::testing::plain {

namespace {

/// Cramer's rule.
std::optional<Hit> intersectTriangle(const Shape &shape, const Vec &origin, const Vec &direction) {
    const Vec side1 = shape.corners[1] - shape.corners[0];
    const Vec side2 = shape.corners[2] - shape.corners[0];
    const Vec p = glm::cross(direction, side2);
    const double determinant = glm::dot(side1, p);
    const Vec s = origin - shape.corners[0];
    const Vec q = glm::cross(s, side1);
    const double u = glm::dot(s, p) / determinant;
    const double v = glm::dot(direction, q) / determinant;
    const double distance = glm::dot(side2, q) / determinant;
    if (!(u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 1e-9))
        return {};
    return Hit{&shape, distance, {1.0 - u - v, u, v}};
}

/// The quadratic formula; of a ray that starts on the sphere one root is 0.
std::optional<Hit> intersectSphere(const Shape &shape, const Vec &origin, const Vec &direction,
                                   bool startsOnIt) {
    const Vec f = origin - shape.centre;
    const double half = glm::dot(f, direction);
    if (startsOnIt)
        return half < 0.0 ? std::optional(Hit{&shape, -2.0 * half}) : std::nullopt;
    const double radicand = half * half - glm::dot(f, f) + shape.radius * shape.radius;
    if (radicand <= 0.0)
        return {};
    const double root = std::sqrt(radicand);
    const double distance = -half - root > 1e-9 ? -half - root : -half + root;
    return distance > 1e-9 ? std::optional(Hit{&shape, distance}) : std::nullopt;
}

/// Directions of growing u and v by the chain rule: e1 = s.x U + s.y V and e2 = t.x U + t.y V, solved for U and V.
void findTangents(const Shape &shape, SurfacePoint &point) {
    const Vec e1 = shape.corners[1] - shape.corners[0];
    const Vec e2 = shape.corners[2] - shape.corners[0];
    const Vec2 s = shape.uvs[1] - shape.uvs[0];
    const Vec2 t = shape.uvs[2] - shape.uvs[0];
    const double determinant = s.x * t.y - t.x * s.y;
    if (determinant == 0.0)
        return;
    point.alongU = (e1 * t.y - e2 * s.y) / determinant;
    point.alongV = (e2 * s.x - e1 * t.x) / determinant;
}

void addTriangles(const Scene &scene, const TriangleMesh &mesh, std::vector<Shape> &shapes) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        const MeshTriangle &triangle = mesh.triangles[i];
        Shape shape;
        shape.materialIndex = mesh.materialOf(i);
        const Material &material = scene.materials[shape.materialIndex];
        shape.isAlphaTested = material.alphaMode != AlphaMode::Opaque;
        shape.isCulled = material.isCulled;
        shape.isSmooth = triangle.normals.x != MeshTriangle::noNormal;
        const bool hasUvs = !mesh.triangleUvs.empty() && mesh.triangleUvs[i].x != TriangleMesh::noUv;
        for (glm::length_t k = 0; k < 3; ++k) {
            const auto corner = static_cast<std::size_t>(k);
            shape.corners[corner] = mesh.positions[triangle.positions[k]];
            if (shape.isSmooth)
                shape.normals[corner] = mesh.normals[triangle.normals[k]];
            if (hasUvs)
                shape.uvs[corner] = mesh.uvs[mesh.triangleUvs[i][k]];
        }
        shapes.push_back(shape);
    }
}

} // namespace

double Shape::area() const {
    if (isSphere)
        return 4.0 * std::numbers::pi * radius * radius;
    return glm::length(glm::cross(corners[1] - corners[0], corners[2] - corners[0])) / 2.0;
}

Vec Shape::randomPoint(Generator &generator) const {
    if (isSphere) { // Archimedes: heights are uniformly distributed
        const double z = 2.0 * uniform(generator) - 1.0;
        const double turn = 2.0 * std::numbers::pi * uniform(generator);
        const double r = std::sqrt(1.0 - z * z);
        return centre + radius * Vec(r * std::cos(turn), r * std::sin(turn), z);
    }
    double u = uniform(generator); // a parallelogram, one half of it folded onto the other
    double v = uniform(generator);
    if (u + v > 1.0) {
        u = 1.0 - u;
        v = 1.0 - v;
    }
    return corners[0] + u * (corners[1] - corners[0]) + v * (corners[2] - corners[0]);
}

std::vector<Shape> shapesOf(const Scene &scene) {
    std::vector<Shape> shapes;
    for (const Sphere &sphere : scene.spheres) {
        Shape shape;
        shape.materialIndex = sphere.materialIndex;
        shape.isSphere = true;
        shape.centre = sphere.centre;
        shape.radius = sphere.radius;
        shape.isInward = sphere.inwardNormal;
        shapes.push_back(shape);
    }
    for (const TriangleMesh &mesh : scene.meshes)
        addTriangles(scene, mesh, shapes);
    return shapes;
}

std::optional<Hit> intersect(const Shape &shape, const Vec &origin, const Vec &direction, const Shape *left) {
    if (shape.isSphere)
        return intersectSphere(shape, origin, direction, &shape == left);
    return &shape == left ? std::nullopt : intersectTriangle(shape, origin, direction);
}

Vec2 uvOf(const Hit &hit, const Vec &position) {
    const Shape &shape = *hit.shape;
    if (!shape.isSphere)
        return hit.weights.x * shape.uvs[0] + hit.weights.y * shape.uvs[1] + hit.weights.z * shape.uvs[2];
    // Longitude from the middle at +z to the right as seen from outside, latitude from the bottom.
    const Vec outward = (position - shape.centre) / shape.radius;
    return {0.5 + std::atan2(outward.x, outward.z) / (2.0 * std::numbers::pi),
            0.5 + std::asin(std::clamp(outward.y, -1.0, 1.0)) / std::numbers::pi};
}

SurfacePoint pointAt(const Hit &hit, const Vec &origin, const Vec &direction) {
    const Shape &shape = *hit.shape;
    SurfacePoint point{};
    point.position = origin + hit.distance * direction;
    point.uv = uvOf(hit, point.position);
    if (shape.isSphere) {
        const Vec outward = (point.position - shape.centre) / shape.radius;
        point.normal = shape.isInward ? -outward : outward;
        point.geometricNormal = point.normal;
        point.alongU = glm::cross(Vec(0.0, 1.0, 0.0), outward);
        point.alongV = glm::cross(outward, point.alongU);
        return point;
    }
    point.geometricNormal =
        glm::normalize(glm::cross(shape.corners[1] - shape.corners[0], shape.corners[2] - shape.corners[0]));
    point.normal = point.geometricNormal;
    if (shape.isSmooth) {
        point.normal = glm::normalize(hit.weights.x * shape.normals[0] + hit.weights.y * shape.normals[1] +
                                      hit.weights.z * shape.normals[2]);
        if (glm::dot(point.normal, point.geometricNormal) < 0.0)
            point.geometricNormal = -point.geometricNormal;
    }
    findTangents(shape, point);
    return point;
}

Frame::Frame(const Vec &normal) : z_(normal) {
    const Vec other = std::abs(normal.x) < 0.6 ? Vec(1.0, 0.0, 0.0) : Vec(0.0, 1.0, 0.0);
    x_ = glm::normalize(glm::cross(other, normal));
    y_ = glm::cross(normal, x_);
}

Vec Frame::toLocal(const Vec &v) const { return {glm::dot(v, x_), glm::dot(v, y_), glm::dot(v, z_)}; }

Vec Frame::toWorld(const Vec &v) const { return v.x * x_ + v.y * y_ + v.z * z_; }

} // namespace hyalite::core::testing::plain
