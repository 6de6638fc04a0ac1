#include "report_oracle.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace hyalite::oracle {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Hits nearer than this are the surface just left, seen again through rounding. Points lie within 1e-12 of
// their surface in a room of size 100, so that even at grazing angles this is ample.
constexpr double nearestDistance = 1e-9;

// World units by which a shadow ray that leaves a triangle starts above its plane, so that a coplanar
// neighbour on the other side of an edge cannot block it.
constexpr double planeOffset = 1e-7;

constexpr std::uint32_t leafTriangleCount = 4;

constexpr std::size_t noPrimitive = std::numeric_limits<std::size_t>::max();

Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
Vec3 operator*(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
Vec3 operator*(Vec3 a, double s) { return {a.x * s, a.y * s, a.z * s}; }
double dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
double length(Vec3 a) { return std::sqrt(dot(a, a)); }
Vec3 normalize(Vec3 a) { return a * (1 / length(a)); }

double component(Vec3 a, int axis) { return axis == 0 ? a.x : axis == 1 ? a.y : a.z; }
Vec3 lowest(Vec3 a, Vec3 b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3 highest(Vec3 a, Vec3 b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

Vec3 centroid(const Triangle &triangle) {
    return (triangle.vertices[0] + triangle.vertices[1] + triangle.vertices[2]) * (1.0 / 3);
}

// The primitive that a ray starts on. At most one of the two is set.
struct Start {
    std::size_t sphereIndex = noPrimitive;
    std::size_t triangleIndex = noPrimitive;
};

struct Ray {
    Vec3 origin{};
    Vec3 direction{}; // unit
    Vec3 sideU{};     // unit; sideU, sideV, direction are orthogonal
    Vec3 sideV{};
    Start start{};
};

// direction is a unit vector.
Ray makeRay(Vec3 origin, Vec3 direction, Start start) {
    const Vec3 across = std::abs(direction.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec3 sideU = normalize(cross(across, direction));
    return {origin, direction, sideU, cross(direction, sideU), start};
}

struct Hit {
    double distance = infinity;
    Vec3 point{};
    Vec3 normal{};      // shading normal N, unit
    Vec3 planeNormal{}; // geometric normal on the side of N, unit
    const Material *material = nullptr;
    Start primitive{};
};

struct TriangleHit {
    double distance = infinity;
    std::array<double, 3> weights{}; // barycentric, of vertices 0, 1, 2
};

// Nearest distance beyond nearestDistance, or infinity.
//
// For a sphere that the ray starts on, one root is zero by construction and the other is -2 b, exactly: no
// offset is needed, however large the sphere or close its neighbour. Otherwise the discriminant comes from
// the distance between line and centre and the smaller root from the product of the roots (Haines et al.,
// "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems, chapter 7).
double intersectSphere(const Sphere &sphere, const Ray &ray, bool startsHere) {
    const Vec3 fromCentre = ray.origin - sphere.centre;
    const double b = dot(fromCentre, ray.direction);
    if (startsHere) {
        const double chord = -2 * b;
        if (chord > nearestDistance) {
            return chord;
        }
        return infinity;
    }
    const Vec3 toLine = fromCentre - ray.direction * b;
    const double discriminant = sphere.radius * sphere.radius - dot(toLine, toLine);
    if (discriminant < 0) {
        return infinity;
    }
    const double centreDistance = length(fromCentre);
    const double product = (centreDistance - sphere.radius) * (centreDistance + sphere.radius);
    const double root = std::sqrt(discriminant);
    const double larger = b > 0 ? -b - root : -b + root;
    const double other = larger != 0 ? product / larger : 0;
    const double nearRoot = std::min(larger, other);
    const double farRoot = std::max(larger, other);
    if (nearRoot > nearestDistance) {
        return nearRoot;
    }
    if (farRoot > nearestDistance) {
        return farRoot;
    }
    return infinity;
}

// Looks along the ray at the triangle: it is hit if its three edges pass the ray, now the point (0, 0), on
// the same side (Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection", JCGT 2013, with a rotation
// in place of the shear). A vertex lands on the same point for each of its triangles, and a difference of two
// rounded products never has the wrong sign, it is at worst zero, which counts as inside. So no ray slips
// through an edge or a vertex, as long as products are not fused. Edge volumes d.(a x b) without the
// projection were tried and let rays through at vertices. Both sides are hit.
std::optional<TriangleHit> intersectTriangle(const Triangle &triangle, const Ray &ray) {
    const Vec3 a = triangle.vertices[0] - ray.origin;
    const Vec3 b = triangle.vertices[1] - ray.origin;
    const Vec3 c = triangle.vertices[2] - ray.origin;
    const double au = dot(a, ray.sideU);
    const double av = dot(a, ray.sideV);
    const double bu = dot(b, ray.sideU);
    const double bv = dot(b, ray.sideV);
    const double cu = dot(c, ray.sideU);
    const double cv = dot(c, ray.sideV);
    const double area0 = bu * cv - bv * cu;
    const double area1 = cu * av - cv * au;
    const double area2 = au * bv - av * bu;
    const bool anyNegative = area0 < 0 || area1 < 0 || area2 < 0;
    const bool anyPositive = area0 > 0 || area1 > 0 || area2 > 0;
    if (anyNegative == anyPositive) {
        return std::nullopt;
    }
    const double scale = 1 / (area0 + area1 + area2);
    const std::array<double, 3> weights{area0 * scale, area1 * scale, area2 * scale};
    const double distance = dot(a, ray.direction) * weights[0] + dot(b, ray.direction) * weights[1] +
                            dot(c, ray.direction) * weights[2];
    if (!(distance > nearestDistance)) {
        return std::nullopt;
    }
    return TriangleHit{distance, weights};
}

// Of the median-split tree: a leaf holds order[first, first + count), an inner node (count 0) has its
// children at first and first + 1.
struct Node {
    Vec3 low{};
    Vec3 high{};
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};

// Distance at which the ray enters the box, or infinity if it misses it within [0, farthest]. The comparisons
// drop the NaN of a ray that runs in a slab's plane; the far side is widened by the rounding of its three
// operations (Ize, "Robust BVH Ray Traversal").
double enterBox(const Node &node, const Ray &ray, Vec3 inverse, double farthest) {
    constexpr double widen = 1 + 8 * std::numeric_limits<double>::epsilon();
    double enter = 0;
    double leave = farthest;
    for (int axis = 0; axis < 3; ++axis) {
        const double scale = component(inverse, axis);
        const double start = component(ray.origin, axis);
        const double t0 = (component(scale < 0 ? node.high : node.low, axis) - start) * scale;
        const double t1 = (component(scale < 0 ? node.low : node.high, axis) - start) * scale * widen;
        enter = t0 > enter ? t0 : enter;
        leave = t1 < leave ? t1 : leave;
    }
    if (enter <= leave) {
        return enter;
    }
    return infinity;
}

// Calls work(py) for every row of an image, in parallel where the compiler can.
template <typename Work> void forEachRow(int height, const Work &work) {
#ifdef _OPENMP
#pragma omp parallel for schedule(dynamic, 1)
#endif
    for (int py = 0; py < height; ++py) {
        work(py);
    }
}

struct CameraFrame {
    Vec3 right{};
    Vec3 upImage{};
    Vec3 forward{};
    double halfWidth = 0;
    double halfHeight = 0;
    double planeDistance = 0; // in pixels

    CameraFrame(const Camera &camera, int width, int height) {
        const Vec3 sideways = cross(camera.forward, camera.up);
        assert(length(sideways) > 0);
        assert(camera.fovRadians > 0 && camera.fovRadians < std::numbers::pi);
        forward = normalize(camera.forward);
        right = normalize(sideways);
        upImage = cross(right, forward);
        halfWidth = 0.5 * width;
        halfHeight = 0.5 * height;
        planeDistance = halfWidth / std::tan(0.5 * camera.fovRadians);
    }

    // x to the right and y down, in pixels from the top left corner. Not normalised.
    [[nodiscard]] Vec3 direction(double x, double y) const {
        return right * (x - halfWidth) + upImage * (halfHeight - y) + forward * planeDistance;
    }
};

bool differs(Rgb a, Rgb b, double tolerance) {
    return std::abs(displayValue(a.x) - displayValue(b.x)) > tolerance ||
           std::abs(displayValue(a.y) - displayValue(b.y)) > tolerance ||
           std::abs(displayValue(a.z) - displayValue(b.z)) > tolerance;
}

} // namespace

struct Tracer::State {
    const Scene &scene;
    std::vector<Node> nodes;
    std::vector<std::uint32_t> order; // triangle indices, as the leaves name them

    explicit State(const Scene &tracedScene) : scene(tracedScene) {
        if (scene.triangles.empty()) {
            return;
        }
        assert(scene.triangles.size() < std::numeric_limits<std::uint32_t>::max() / 2);
        const auto triangleCount = static_cast<std::uint32_t>(scene.triangles.size());
        order.resize(triangleCount);
        std::iota(order.begin(), order.end(), 0U);
        nodes.resize(1);
        buildNode(0, 0, triangleCount);
    }

    // Splits at the median centroid along the axis in which the centroids spread widest.
    void buildNode(std::uint32_t nodeIndex, std::uint32_t first, std::uint32_t count) {
        Vec3 low{infinity, infinity, infinity};
        Vec3 high = -low;
        Vec3 centroidLow = low;
        Vec3 centroidHigh = high;
        for (std::uint32_t i = first; i < first + count; ++i) {
            const Triangle &triangle = scene.triangles[order[i]];
            for (const Vec3 &vertex : triangle.vertices) {
                low = lowest(low, vertex);
                high = highest(high, vertex);
            }
            centroidLow = lowest(centroidLow, centroid(triangle));
            centroidHigh = highest(centroidHigh, centroid(triangle));
        }
        if (count <= leafTriangleCount) {
            nodes[nodeIndex] = {low, high, first, count};
            return;
        }
        const Vec3 spread = centroidHigh - centroidLow;
        const int axis = spread.x >= spread.y && spread.x >= spread.z ? 0 : spread.y >= spread.z ? 1 : 2;
        const std::uint32_t lowerCount = count / 2;
        const auto begin = order.begin() + static_cast<std::ptrdiff_t>(first);
        std::nth_element(begin, begin + static_cast<std::ptrdiff_t>(lowerCount),
                         begin + static_cast<std::ptrdiff_t>(count), [&](std::uint32_t a, std::uint32_t b) {
                             return component(centroid(scene.triangles[a]), axis) <
                                    component(centroid(scene.triangles[b]), axis);
                         });
        const auto child = static_cast<std::uint32_t>(nodes.size());
        nodes.resize(nodes.size() + 2);
        nodes[nodeIndex] = {low, high, child, 0};
        buildNode(child, first, lowerCount);
        buildNode(child + 1, first + lowerCount, count - lowerCount);
    }

    // Calls visit(triangleIndex) for all triangles in boxes that the ray enters before `farthest`, which the
    // visitor may shrink, nearer boxes first. The visitor returns false to end the walk.
    template <typename Visit>
    void walkTriangles(const Ray &ray, const double &farthest, const Visit &visit) const {
        if (nodes.empty()) {
            return;
        }
        struct Entry {
            std::uint32_t nodeIndex;
            double enter;
        };
        // The split halves the count, so that a 32-bit count is used up after 32 levels, each of which leaves
        // at most one sibling behind.
        std::array<Entry, 64> stack;
        std::size_t stackCount = 0;
        const Vec3 inverse{1 / ray.direction.x, 1 / ray.direction.y, 1 / ray.direction.z};
        const double rootEnter = enterBox(nodes[0], ray, inverse, farthest);
        if (rootEnter < infinity) {
            stack[stackCount++] = {0, rootEnter};
        }
        while (stackCount > 0) {
            const Entry entry = stack[--stackCount];
            if (entry.enter > farthest) {
                continue;
            }
            const Node &node = nodes[entry.nodeIndex];
            if (node.count > 0) {
                for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
                    if (order[i] != ray.start.triangleIndex && !visit(std::size_t{order[i]})) {
                        return;
                    }
                }
                continue;
            }
            Entry nearer{node.first, enterBox(nodes[node.first], ray, inverse, farthest)};
            Entry farther{node.first + 1, enterBox(nodes[node.first + 1], ray, inverse, farthest)};
            if (farther.enter < nearer.enter) {
                std::swap(nearer, farther);
            }
            assert(stackCount + 2 <= stack.size());
            if (farther.enter < infinity) {
                stack[stackCount++] = farther;
            }
            if (nearer.enter < infinity) {
                stack[stackCount++] = nearer;
            }
        }
    }

    [[nodiscard]] std::optional<Hit> findNearest(const Ray &ray) const {
        Hit hit;
        for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
            const double distance = intersectSphere(scene.spheres[i], ray, i == ray.start.sphereIndex);
            if (distance < hit.distance) {
                hit.distance = distance;
                hit.primitive.sphereIndex = i;
            }
        }
        TriangleHit nearestTriangle;
        walkTriangles(ray, hit.distance, [&](std::size_t i) {
            const std::optional<TriangleHit> candidate = intersectTriangle(scene.triangles[i], ray);
            if (candidate && candidate->distance < hit.distance) {
                hit.distance = candidate->distance;
                hit.primitive = {noPrimitive, i};
                nearestTriangle = *candidate;
            }
            return true;
        });
        if (hit.primitive.triangleIndex != noPrimitive) {
            describeTriangleHit(ray, nearestTriangle, hit);
            return hit;
        }
        if (hit.primitive.sphereIndex != noPrimitive) {
            const Sphere &sphere = scene.spheres[hit.primitive.sphereIndex];
            const Vec3 outward = normalize(ray.origin + ray.direction * hit.distance - sphere.centre);
            // Back onto the sphere, which the exact chord of the next segment relies on.
            hit.point = sphere.centre + outward * sphere.radius;
            hit.normal = sphere.inwardNormal ? -outward : outward;
            hit.planeNormal = hit.normal;
            hit.material = &sphere.material;
            return hit;
        }
        return std::nullopt;
    }

    void describeTriangleHit(const Ray &ray, const TriangleHit &triangleHit, Hit &hit) const {
        const Triangle &triangle = scene.triangles[hit.primitive.triangleIndex];
        const auto &[v0, v1, v2] = triangle.vertices;
        hit.point = ray.origin + ray.direction * hit.distance;
        hit.material = &triangle.material;
        hit.planeNormal = normalize(cross(v1 - v0, v2 - v0));
        hit.normal = hit.planeNormal;
        if (triangle.normals) {
            const auto &[n0, n1, n2] = *triangle.normals;
            const auto &[w0, w1, w2] = triangleHit.weights;
            const Vec3 blend = n0 * w0 + n1 * w1 + n2 * w2;
            if (length(blend) > 0) {
                hit.normal = normalize(blend);
            }
        }
        if (dot(hit.planeNormal, hit.normal) < 0) {
            hit.planeNormal = -hit.planeNormal;
        }
    }

    // 0 behind anything opaque, else glassShadow behind any number of dielectrics, else 1.
    [[nodiscard]] double visibility(const Hit &hit) const {
        Vec3 origin = hit.point;
        if (hit.primitive.triangleIndex != noPrimitive) {
            // The ray starts above the triangle and has to pass its plane to reach a light below.
            if (dot(hit.planeNormal, scene.light.position - hit.point) <= 0) {
                return 0;
            }
            origin = hit.point + hit.planeNormal * planeOffset;
        }
        const Vec3 toLight = scene.light.position - origin;
        const double lightDistance = length(toLight);
        const Ray ray = makeRay(origin, toLight * (1 / lightDistance), hit.primitive);

        bool throughGlass = false;
        for (std::size_t i = 0; i < scene.spheres.size(); ++i) {
            const Sphere &sphere = scene.spheres[i];
            if (intersectSphere(sphere, ray, i == ray.start.sphereIndex) < lightDistance) {
                if (sphere.material.kind != MaterialKind::dielectric) {
                    return 0;
                }
                throughGlass = true;
            }
        }
        bool blocked = false;
        walkTriangles(ray, lightDistance, [&](std::size_t i) {
            const Triangle &triangle = scene.triangles[i];
            const std::optional<TriangleHit> candidate = intersectTriangle(triangle, ray);
            if (candidate && candidate->distance < lightDistance) {
                blocked = triangle.material.kind != MaterialKind::dielectric;
                throughGlass = true;
            }
            return !blocked;
        });
        return blocked ? 0 : throughGlass ? scene.glassShadow : 1;
    }

    // Lambert: power / (4 pi d^2) * albedo / pi * max(0, N.L) * visibility. N is not turned to the viewer.
    [[nodiscard]] Rgb shadeDiffuse(const Hit &hit) const {
        const Vec3 toLight = scene.light.position - hit.point;
        const double distanceSquared = dot(toLight, toLight);
        const double cosine = dot(hit.normal, toLight) / std::sqrt(distanceSquared);
        if (!(cosine > 0)) {
            return {};
        }
        const double irradiance =
            scene.light.power / (4 * std::numbers::pi * distanceSquared) * cosine * visibility(hit);
        return hit.material->albedo * (irradiance / std::numbers::pi);
    }

    // Snell's law, and Schlick ("An Inexpensive BRDF Model for Physically-based Rendering", section 4) for
    // the share of the mirror direction. The cosine is the one on the thinner side, so that the share rises
    // to 1 at the critical angle instead of jumping there.
    [[nodiscard]] Rgb shadeDielectric(const Ray &ray, const Hit &hit, int segmentsLeft) const {
        const Material &glass = *hit.material;
        const bool inside = dot(ray.direction, hit.normal) > 0;
        const Vec3 normal = inside ? -hit.normal : hit.normal;
        const double n1 = inside ? glass.index : 1;
        const double n2 = inside ? 1 : glass.index;
        const double eta = n1 / n2;
        const double cosIncident = -dot(ray.direction, normal);
        const double radicand = 1 - eta * eta * (1 - cosIncident * cosIncident);

        const Vec3 mirrored = ray.direction + normal * (2 * cosIncident);
        const Rgb reflected = follow(hit, mirrored, segmentsLeft);
        Rgb result = reflected;
        if (radicand >= 0) {
            const double cosTransmitted = std::sqrt(radicand);
            const double cosThin = n1 <= n2 ? cosIncident : cosTransmitted;
            const double normalIncidence = ((n1 - n2) / (n1 + n2)) * ((n1 - n2) / (n1 + n2));
            const double share = normalIncidence + (1 - normalIncidence) * std::pow(1 - cosThin, 5);
            const Vec3 bent = ray.direction * eta + normal * (eta * cosIncident - cosTransmitted);
            result = reflected * share + follow(hit, bent, segmentsLeft) * (1 - share);
        }
        return inside ? result * glass.segmentTint : result;
    }

    [[nodiscard]] Rgb follow(const Hit &hit, Vec3 direction, int segmentsLeft) const {
        return trace(makeRay(hit.point, normalize(direction), hit.primitive), segmentsLeft);
    }

    // segmentsLeft counts this ray; at 0 the radiance is black.
    [[nodiscard]] Rgb trace(const Ray &ray, int segmentsLeft) const {
        if (segmentsLeft <= 0) {
            return {};
        }
        const std::optional<Hit> hit = findNearest(ray);
        if (!hit) {
            return scene.background;
        }
        switch (hit->material->kind) {
        case MaterialKind::diffuse:
            return shadeDiffuse(*hit);
        case MaterialKind::mirror: {
            const Vec3 mirrored = ray.direction - hit->normal * (2 * dot(ray.direction, hit->normal));
            return follow(*hit, mirrored, segmentsLeft - 1);
        }
        case MaterialKind::dielectric:
            return shadeDielectric(ray, *hit, segmentsLeft - 1);
        }
        assert(false);
        return {};
    }
};

Material makeDiffuse(Rgb albedo) {
    Material material;
    material.albedo = albedo;
    return material;
}

Material makeMirror() {
    Material material;
    material.kind = MaterialKind::mirror;
    return material;
}

Material makeDielectric(double index, Rgb segmentTint) {
    assert(index > 0);
    Material material;
    material.kind = MaterialKind::dielectric;
    material.index = index;
    material.segmentTint = segmentTint;
    return material;
}

Tracer::Tracer(const Scene &scene) : state_(std::make_shared<const State>(scene)) {}

Rgb Tracer::radiance(Vec3 origin, Vec3 direction) const {
    assert(length(direction) > 0);
    return state_->trace(makeRay(origin, normalize(direction), {}), state_->scene.maxDepth);
}

Image render(const Scene &scene, const Camera &camera, int width, int height) {
    assert(width > 0 && height > 0);
    const Tracer tracer(scene);
    const CameraFrame frame(camera, width, height);
    Image image;
    image.width = width;
    image.height = height;
    image.radiance.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    forEachRow(height, [&](int py) {
        const std::size_t row = static_cast<std::size_t>(py) * static_cast<std::size_t>(width);
        for (int px = 0; px < width; ++px) {
            image.radiance[row + static_cast<std::size_t>(px)] =
                tracer.radiance(camera.position, frame.direction(px + 0.5, py + 0.5));
        }
    });
    return image;
}

void markUnstable(const Scene &scene, const Camera &camera, Image &image, const StabilityProbe &probe) {
    assert(image.radiance.size() ==
           static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    const Tracer tracer(scene);
    const CameraFrame frame(camera, image.width, image.height);

    struct Move {
        double right;
        double down;
        Vec3 eye;
    };
    std::vector<Move> moves;
    if (probe.pixelOffset > 0) {
        // The corners of a square: an edge that crosses it within pixelOffset of the centre parts two of
        // them.
        for (const double right : {-probe.pixelOffset, probe.pixelOffset}) {
            for (const double down : {-probe.pixelOffset, probe.pixelOffset}) {
                moves.push_back({right, down, {}});
            }
        }
    }
    if (probe.eyeOffset > 0) {
        for (const Vec3 axis : {frame.right, frame.upImage, frame.forward}) {
            moves.push_back({0, 0, axis * probe.eyeOffset});
            moves.push_back({0, 0, axis * -probe.eyeOffset});
        }
    }

    image.unstable.assign(image.radiance.size(), 0);
    forEachRow(image.height, [&](int py) {
        const std::size_t row = static_cast<std::size_t>(py) * static_cast<std::size_t>(image.width);
        for (int px = 0; px < image.width; ++px) {
            const std::size_t pixelIndex = row + static_cast<std::size_t>(px);
            const bool unstable = std::any_of(moves.begin(), moves.end(), [&](const Move &move) {
                const Vec3 direction = frame.direction(px + 0.5 + move.right, py + 0.5 + move.down);
                const Rgb moved = tracer.radiance(camera.position + move.eye, direction);
                return differs(moved, image.radiance[pixelIndex], probe.tolerance);
            });
            image.unstable[pixelIndex] = unstable ? 1 : 0;
        }
    });
}

double displayValue(double radiance) {
    assert(!std::isnan(radiance));
    return 255 * std::pow(std::clamp(radiance, 0.0, 1.0), 1 / 2.2);
}

std::uint8_t toEightBit(double radiance) {
    return static_cast<std::uint8_t>(std::lround(displayValue(radiance)));
}

Scene catRoom() {
    Scene scene;
    scene.maxDepth = 5;
    scene.spheres = {
        {{0, 0, -1000}, 940, false, makeDiffuse({0.4, 0.8, 0.7})},
        {{0, 0, 1000}, 940, false, makeDiffuse({0.9, 0.4, 0.3})},
        {{0, -1000, 0}, 990, false, makeDiffuse({0.3, 0.4, 0.7})},
        {{-1000, 0, 0}, 940, false, makeDiffuse({0.5, 0.5, 0.6})},
        {{1000, 0, 0}, 940, false, makeDiffuse({0.6, 0.5, 0.1})},
        {{0, 1000, 0}, 940, false, makeDiffuse({0.2, 0.5, 0.9})},
    };
    return scene;
}

Material catMaterial() { return makeDiffuse({0.95, 0.95, 0.98}); }

Scene spheresScene() {
    Scene scene = catRoom();
    scene.maxDepth = 7;
    const Material glass = makeDielectric(1.8, {0.95, 0.95, 0.98});
    scene.spheres.push_back({{-20, 0, 0}, 10, false, makeMirror()});
    scene.spheres.push_back({{0, 0, 0}, 10, false, glass});
    scene.spheres.push_back({{20, 0, 0}, 10, false, glass});
    scene.spheres.push_back({{20, 0, 0}, 9.9, true, glass});
    return scene;
}

Scene spheresNestedScene() {
    Scene scene = spheresScene();
    scene.maxDepth = 12;
    const Material glass = scene.spheres.back().material;
    scene.spheres.push_back({{20, 0, 0}, 9.8, false, glass});
    scene.spheres.push_back({{20, 0, 0}, 9.7, true, glass});
    scene.spheres.push_back({{20, 0, 0}, 9.6, false, glass});
    return scene;
}

} // namespace hyalite::oracle
