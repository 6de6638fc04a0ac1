#include "host/scene/contacts.h"

#include "host/scene/instances.h"
#include "host/scene/solids.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <tuple>

namespace hyalite::core {

namespace {

constexpr double unitOfRounding = 1.0 / 16777216.0;
constexpr double maxGap = 32.0 * unitOfRounding; // of a contact, of the largest coordinate
constexpr double shift = 64.0 * unitOfRounding;

struct Extent {
    glm::dvec3 lower{std::numeric_limits<double>::infinity()};
    glm::dvec3 upper{-std::numeric_limits<double>::infinity()};

    void extend(const glm::dvec3 &point) {
        lower = glm::min(lower, point);
        upper = glm::max(upper, point);
    }
    [[nodiscard]] double reach() const {
        const glm::dvec3 largest = glm::max(glm::abs(lower), glm::abs(upper));
        return std::max({largest.x, largest.y, largest.z});
    }
    /// With the gap that still is a contact.
    [[nodiscard]] Extent widened() const {
        const glm::dvec3 gap(maxGap * reach());
        return {lower - gap, upper + gap};
    }
    [[nodiscard]] bool meets(const Extent &other) const {
        return glm::all(glm::lessThanEqual(lower, other.upper)) &&
               glm::all(glm::lessThanEqual(other.lower, upper));
    }
};

using Corners = std::array<glm::dvec3, 3>;

glm::dvec3 unitNormal(const Corners &corners) {
    const glm::dvec3 area = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
    const double length = glm::length(area);
    return length > 0.0 ? area / length : glm::dvec3(0.0);
}

// ---- Which surface moves

/// The order in which surfaces give way: opaque ones never, then glass by descending priority, as its materials are
/// packed, then those with a smaller `place`.
using Rank = std::tuple<bool, int, std::uint32_t, std::uint32_t>;

Rank rankOf(const std::vector<Material> &materials, std::uint32_t material, std::uint32_t place) {
    const bool isOfGlass = holdsMedium(materials[material]);
    return {isOfGlass, isOfGlass ? -materials[material].priority : 0, isOfGlass ? material : 0, place};
}

// ---- Spheres: one that shares centre and radius with another gets a radius of its own.

void partSpheres(Scene &scene) {
    std::vector<std::uint32_t> order(scene.spheres.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(
        order, {}, [&](std::uint32_t i) { return scene.spheres[i].centre.x + scene.spheres[i].radius; });
    std::vector<double> shifts(scene.spheres.size(), 0.0);
    for (std::size_t first = 0; first < order.size(); ++first)
        for (std::size_t second = first + 1; second < order.size(); ++second) {
            std::uint32_t mover = order[first];
            std::uint32_t other = order[second];
            const auto rank = [&](std::uint32_t i) {
                return rankOf(scene.materials, scene.spheres[i].materialIndex, i);
            };
            if (rank(mover) < rank(other))
                std::swap(mover, other);
            const Sphere &a = scene.spheres[mover];
            const Sphere &b = scene.spheres[other];
            const glm::dvec3 reach =
                glm::max(glm::abs(a.centre), glm::abs(b.centre)) + std::max(a.radius, b.radius);
            const double largest = std::max({reach.x, reach.y, reach.z});
            const double gap = maxGap * largest;
            if (std::abs(a.centre.x + a.radius - b.centre.x - b.radius) > gap)
                break;
            if (!std::get<0>(rank(mover)) ||
                glm::distance(a.centre, b.centre) + std::abs(a.radius - b.radius) > gap)
                continue;
            const bool isOpposite = a.inwardNormal != b.inwardNormal;
            shifts[mover] = isOpposite != a.inwardNormal ? shift * largest : -shift * largest;
        }
    for (std::size_t i = 0; i < shifts.size(); ++i)
        scene.spheres[i].radius =
            std::max(scene.spheres[i].radius + shifts[i], 0.5 * scene.spheres[i].radius);
}

// ---- Triangles

/// A mesh, or an instance of a prototype.
struct Item {
    const TriangleMesh *mesh = nullptr;
    const Placement *toWorld = nullptr; ///< of an instance
    Extent box{};
    Solids solids{};
    std::uint32_t firstSolid = 0; ///< its opaque surfaces; its solids follow
    std::vector<Extent> places{}; ///< where it may touch something

    [[nodiscard]] glm::dvec3 placed(std::uint32_t corner) const {
        const glm::vec3 &position = mesh->positions[corner];
        return toWorld != nullptr ? placedPoint(*toWorld, position) : position;
    }
    [[nodiscard]] Corners cornersOf(std::uint32_t triangle) const {
        const glm::uvec3 &corners = mesh->triangles[triangle].positions;
        return {placed(corners.x), placed(corners.y), placed(corners.z)};
    }
};

struct Face {
    Extent box;
    std::uint32_t item = 0;
    std::uint32_t triangle = 0;
    std::uint32_t solid = 0;
};

/// Of triangles that have to move, by item and triangle: how far along their normals.
using Shifts = std::map<std::pair<std::uint32_t, std::uint32_t>, double>;

/// The part of a polygon where `plane` is at least 0.
template <class Plane>
std::vector<glm::dvec3> clipped(const std::vector<glm::dvec3> &polygon, const Plane &plane) {
    std::vector<glm::dvec3> kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 &a = polygon[i];
        const glm::dvec3 &b = polygon[(i + 1) % polygon.size()];
        const double atA = plane(a);
        const double atB = plane(b);
        if (atA >= 0.0)
            kept.push_back(a);
        if (atA >= 0.0 ? atB < 0.0 : atB >= 0.0)
            kept.push_back(a + (b - a) * (atA / (atA - atB)));
    }
    return kept;
}

struct Size {
    double area = 0.0;
    double perimeter = 0.0;
};

Size sizeOf(const std::vector<glm::dvec3> &polygon) {
    glm::dvec3 area(0.0);
    Size size;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec3 &next = polygon[(i + 1) % polygon.size()];
        area += glm::cross(polygon[i] - polygon[0], next - polygon[0]);
        size.perimeter += glm::distance(polygon[i], next);
    }
    size.area = 0.5 * glm::length(area);
    return size;
}

/// Whether two nearly parallel triangles are at most `gap` from each other in a quarter of where they face each other.
/// Where they only have an edge in common, or cross each other, they do not touch.
bool touch(const Corners &a, const glm::dvec3 &normal, const Corners &b, double gap) {
    std::vector<glm::dvec3> facing(b.begin(), b.end());
    for (std::size_t i = 0; i < 3; ++i) {
        const glm::dvec3 inward = glm::cross(normal, a[(i + 1) % 3] - a[i]);
        facing = clipped(facing, [&](const glm::dvec3 &p) { return glm::dot(inward, p - a[i]); });
    }
    const auto height = [&](const glm::dvec3 &p) { return glm::dot(normal, p - a[0]); };
    std::vector<glm::dvec3> near = clipped(facing, [&](const glm::dvec3 &p) { return gap - height(p); });
    near = clipped(near, [&](const glm::dvec3 &p) { return gap + height(p); });
    const Size size = sizeOf(near);
    return size.area > 2.0 * gap * size.perimeter && size.area >= 0.25 * sizeOf(facing).area;
}

class ContactSearch {
  public:
    explicit ContactSearch(const Scene &scene) : scene_(scene) {
        addItems();
        findPlaces();
        addFaces();
        std::vector<std::uint32_t> all(faces_.size());
        std::iota(all.begin(), all.end(), 0u);
        visit(std::move(all), 0);
    }

    [[nodiscard]] const Shifts &shifts() const { return shifts_; }
    [[nodiscard]] const std::vector<Item> &items() const { return items_; }

  private:
    void addItem(const TriangleMesh &mesh, const Solids &solids, const Placement *toWorld) {
        Item item{&mesh, toWorld};
        item.solids = solids;
        for (const MeshTriangle &triangle : mesh.triangles)
            for (int k = 0; k < 3; ++k)
                item.box.extend(item.placed(triangle.positions[k]));
        item.box = item.box.widened();
        item.firstSolid = solidCount_;
        solidCount_ += 1 + solids.count;
        items_.push_back(std::move(item));
    }

    void addItems() {
        items_.reserve(scene_.meshes.size() + scene_.instances.size());
        for (const TriangleMesh &mesh : scene_.meshes)
            addItem(mesh, solidsOf(mesh, scene_.materials), nullptr);
        std::vector<Solids> solids;
        for (const TriangleMesh &mesh : scene_.prototypes)
            solids.push_back(solidsOf(mesh, scene_.materials));
        for (const Instance &instance : scene_.instances)
            addItem(scene_.prototypes[instance.prototype], solids[instance.prototype], &instance.toWorld);
    }

    /// Items touch only where their boxes meet.
    void findPlaces() {
        std::vector<std::uint32_t> order(items_.size());
        std::iota(order.begin(), order.end(), 0u);
        std::ranges::sort(order, {}, [&](std::uint32_t i) { return items_[i].box.lower.x; });
        for (std::size_t first = 0; first < order.size(); ++first) {
            Item &a = items_[order[first]];
            if (a.solids.count > 1)
                a.places.push_back(a.box);
            for (std::size_t second = first + 1; second < order.size(); ++second) {
                Item &b = items_[order[second]];
                if (b.box.lower.x > a.box.upper.x)
                    break;
                if ((a.solids.count == 0 && b.solids.count == 0) || !a.box.meets(b.box))
                    continue;
                const Extent common{glm::max(a.box.lower, b.box.lower), glm::min(a.box.upper, b.box.upper)};
                addPlace(a, common);
                addPlace(b, common);
            }
        }
    }

    static void addPlace(Item &item, const Extent &place) {
        constexpr std::size_t mostPlaces = 8;
        if (item.places.size() < mostPlaces) {
            item.places.push_back(place);
            return;
        }
        item.places.back().extend(place.lower);
        item.places.back().extend(place.upper);
    }

    void addFaces() {
        for (std::uint32_t i = 0; i < items_.size(); ++i) {
            const Item &item = items_[i];
            for (std::uint32_t triangle = 0; !item.places.empty() && triangle < item.mesh->triangles.size();
                 ++triangle) {
                Face face{{}, i, triangle, item.firstSolid};
                for (const glm::dvec3 &corner : item.cornersOf(triangle))
                    face.box.extend(corner);
                face.box = face.box.widened();
                if (item.solids.ofTriangles[triangle] != noSolid)
                    face.solid += 1 + item.solids.ofTriangles[triangle];
                if (std::ranges::any_of(item.places,
                                        [&](const Extent &place) { return place.meets(face.box); }))
                    faces_.push_back(face);
            }
        }
    }

    [[nodiscard]] bool isGlassFace(const Face &face) const {
        return face.solid != items_[face.item].firstSolid;
    }

    /// Halves the space until few faces share a part of it.
    void visit(std::vector<std::uint32_t> faces, int depth) {
        const auto isAlone = [&](std::uint32_t i) { return faces_[i].solid == faces_[faces[0]].solid; };
        if (std::ranges::none_of(faces, [&](std::uint32_t i) { return isGlassFace(faces_[i]); }) ||
            std::ranges::all_of(faces, isAlone))
            return;
        Extent box;
        for (const std::uint32_t i : faces)
            box.extend(0.5 * (faces_[i].box.lower + faces_[i].box.upper));
        const glm::dvec3 size = box.upper - box.lower;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const double middle = 0.5 * (box.lower[axis] + box.upper[axis]);
        std::vector<std::uint32_t> below;
        std::vector<std::uint32_t> above;
        for (const std::uint32_t i : faces) {
            if (faces_[i].box.lower[axis] <= middle)
                below.push_back(i);
            if (faces_[i].box.upper[axis] >= middle)
                above.push_back(i);
        }
        constexpr std::size_t fewFaces = 16;
        constexpr int deepest = 48;
        const bool isHalved = 10 * std::max(below.size(), above.size()) < 9 * faces.size();
        if (faces.size() <= fewFaces || depth >= deepest || !isHalved) {
            compareAll(std::move(faces));
            return;
        }
        faces = {};
        visit(std::move(below), depth + 1);
        visit(std::move(above), depth + 1);
    }

    void compareAll(std::vector<std::uint32_t> faces) {
        std::ranges::sort(faces, {}, [&](std::uint32_t i) { return std::pair(faces_[i].box.lower.x, i); });
        for (std::size_t first = 0; first < faces.size(); ++first)
            for (std::size_t second = first + 1; second < faces.size(); ++second) {
                const Face &a = faces_[faces[first]];
                const Face &b = faces_[faces[second]];
                if (b.box.lower.x > a.box.upper.x)
                    break;
                if (a.solid != b.solid && (isGlassFace(a) || isGlassFace(b)) && a.box.meets(b.box))
                    compare(a, b);
            }
    }

    /// Meshes give way to instances.
    [[nodiscard]] Rank rank(const Face &face) const {
        const Item &item = items_[face.item];
        const std::uint32_t place = item.toWorld != nullptr ? face.solid : face.solid + solidCount_;
        return rankOf(scene_.materials, item.mesh->materialOf(face.triangle), place);
    }

    void compare(const Face &a, const Face &b) {
        const bool isMovingA = rank(b) < rank(a);
        const Face &mover = isMovingA ? a : b;
        const Face &other = isMovingA ? b : a;
        const Corners corners = items_[mover.item].cornersOf(mover.triangle);
        const Corners otherCorners = items_[other.item].cornersOf(other.triangle);
        const glm::dvec3 normal = unitNormal(corners);
        const double cosine = glm::dot(normal, unitNormal(otherCorners));
        const double reach = std::max(mover.box.reach(), other.box.reach());
        constexpr double leastCosine = 0.999;
        if (std::abs(cosine) < leastCosine || !touch(corners, normal, otherCorners, maxGap * reach))
            return;
        double &kept = shifts_[{mover.item, mover.triangle}];
        const double found = cosine < 0.0 ? shift * reach : -shift * reach;
        // The same in every order: the larger of two, and outward if faces on both sides want it otherwise.
        if (std::pair(std::abs(found), found) > std::pair(std::abs(kept), kept))
            kept = found;
    }

    const Scene &scene_;
    std::vector<Item> items_;
    std::uint32_t solidCount_ = 0;
    std::vector<Face> faces_;
    Shifts shifts_;
};

/// The least squares of how far faces around a corner are from where they should be.
struct CornerFit {
    glm::dmat3 products{0.0};
    glm::dvec3 sums{0.0};
    double largestShift = 0.0;

    void add(const glm::dvec3 &normal, double wanted, double weight) {
        products += weight * glm::outerProduct(normal, normal);
        sums += weight * wanted * normal;
        largestShift = std::max(largestShift, std::abs(wanted));
    }

    /// At the tip of a wedge the corner of two faces would move far.
    [[nodiscard]] glm::dvec3 displacement() const {
        constexpr double shortest = 1e-6; // of equal squares, the weight of the shortest way
        constexpr double furthest = 32.0;
        const glm::dvec3 way = glm::inverse(products + glm::dmat3(shortest)) * sums;
        const double length = glm::length(way);
        return length > furthest * largestShift ? way * (furthest * largestShift / length) : way;
    }
};

struct PositionLess {
    bool operator()(const glm::vec3 &a, const glm::vec3 &b) const {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    }
};

/// Moves faces of a mesh, each with its solid: corners that have a place in common keep it.
void move(TriangleMesh &mesh, const Solids &solids, const std::map<std::uint32_t, double> &shifts) {
    const auto solidOf = [&](std::uint32_t triangle) { return solids.ofTriangles[triangle]; };
    std::map<std::uint32_t, std::map<glm::vec3, CornerFit, PositionLess>> corners; // of solids that move
    for (const auto &[triangle, wanted] : shifts)
        for (int k = 0; k < 3; ++k)
            corners[solidOf(triangle)][mesh.positions[mesh.triangles[triangle].positions[k]]];
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> moved; // by solid and corner
    for (const bool isMoving : {false, true})
        for (std::uint32_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
            const auto ofSolid = corners.find(solidOf(triangle));
            if (solidOf(triangle) == noSolid || ofSolid == corners.end())
                continue;
            glm::uvec3 &indices = mesh.triangles[triangle].positions;
            const glm::dvec3 normal =
                unitNormal({mesh.positions[indices.x], mesh.positions[indices.y], mesh.positions[indices.z]});
            constexpr double weightOfOthers = 1e-5; // they should stay where they are, if they can
            const auto wanted = shifts.find(triangle);
            for (int k = 0; k < 3; ++k) {
                const auto corner = ofSolid->second.find(mesh.positions[indices[k]]);
                if (corner == ofSolid->second.end())
                    continue;
                if (!isMoving) {
                    corner->second.add(normal, wanted != shifts.end() ? wanted->second : 0.0,
                                       wanted != shifts.end() ? 1.0 : weightOfOthers);
                    continue;
                }
                const auto [place, isNew] = moved.try_emplace(
                    {solidOf(triangle), indices[k]}, static_cast<std::uint32_t>(mesh.positions.size()));
                if (isNew)
                    mesh.positions.emplace_back(glm::dvec3(corner->first) + corner->second.displacement());
                indices[k] = place->second;
            }
        }
}

} // namespace

void partContacts(Scene &scene) {
    if (std::ranges::none_of(scene.materials, holdsMedium))
        return;
    partSpheres(scene);
    ContactSearch search(scene);
    std::vector<bool> isFlattened(scene.instances.size(), false);
    bool isAnyFlattened = false;
    for (const auto &[face, wanted] : search.shifts())
        if (face.first >= scene.meshes.size())
            isAnyFlattened = isFlattened[face.first - scene.meshes.size()] = true;
    if (isAnyFlattened) {
        flattenInstances(scene, [&](std::size_t instance) { return isFlattened[instance]; });
        partContacts(scene);
        return;
    }
    std::map<std::uint32_t, std::map<std::uint32_t, double>> ofMeshes;
    for (const auto &[face, wanted] : search.shifts())
        ofMeshes[face.first][face.second] = wanted;
    for (const auto &[mesh, shifts] : ofMeshes)
        move(scene.meshes[mesh], search.items()[mesh].solids, shifts);
}

} // namespace hyalite::core
