#include "assets/cat/polygonise.h"

#include "assets/cat/dual_mesh.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace hyalite::cat {
namespace {

constexpr int relaxationCount = 6;
constexpr double relaxationStep = 0.7;
constexpr std::size_t attemptCount = 24;
constexpr std::size_t fitMeshCount = 8; // so many sound meshes are weighed where none is good
constexpr double largestExcess = 1.05;
constexpr double coarsestCount = 8000.0;
constexpr double leastAgreement = 0.05; // cosine of a vertex normal and its triangles
constexpr double goodMerit = 0.03;      // an equilateral triangle facing its normals has 0.29

Vec3 divideByLengthSquared(const Vec3 &v) {
    const double squared = dot(v, v);
    return squared > 0.0 ? v * (1.0 / squared) : v;
}

// Newton's method along the gradient, in steps no longer than `longestStep`. Returns the last gradient met.
Vec3 moveToSurface(const Field &field, const Selection &selection, Vec3 &p, int stepCount,
                   double longestStep) {
    FieldSample sample;
    for (int step = 0; step < stepCount; ++step) {
        sample = field.sample(selection, p);
        const Vec3 move = divideByLengthSquared(sample.gradient) * sample.value;
        const double distance = length(move);
        p = p - (distance > longestStep ? move * (longestStep / distance) : move);
    }
    return sample.gradient;
}

std::vector<Vec3> meanNeighbours(const DualMesh &mesh) {
    std::vector<Vec3> sums(mesh.positions.size());
    std::vector<int> counts(mesh.positions.size(), 0);
    for (const auto &quad : mesh.quads)
        for (std::size_t i = 0; i < 4; ++i) {
            const Vec3 &previous = mesh.positions[quad[(i + 3) % 4]];
            const Vec3 &next = mesh.positions[quad[(i + 1) % 4]];
            sums[quad[i]] = sums[quad[i]] + (previous + next);
            counts[quad[i]] += 2;
        }
    for (std::size_t i = 0; i < sums.size(); ++i)
        sums[i] = sums[i] * (1.0 / counts[i]);
    return sums;
}

// Moves the vertices on to the surface, then evens them out along it.
void relax(const Field &field, const SparseGrid &grid, DualMesh &mesh) {
    const double longestStep = 0.5 * grid.spacing();
    std::vector<Vec3> gradients(mesh.positions.size());
    const auto moveAll = [&](int stepCount) {
        for (std::size_t i = 0; i < mesh.positions.size(); ++i)
            gradients[i] = moveToSurface(field, grid.blocks()[mesh.vertexBlocks[i]].selection,
                                         mesh.positions[i], stepCount, longestStep);
    };
    moveAll(2);
    for (int round = 0; round < relaxationCount; ++round) {
        const std::vector<Vec3> targets = meanNeighbours(mesh);
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const Vec3 shift = targets[i] - mesh.positions[i];
            const Vec3 outOfSurface = gradients[i] * dot(shift, divideByLengthSquared(gradients[i]));
            mesh.positions[i] = mesh.positions[i] + (shift - outOfSurface) * relaxationStep;
        }
        moveAll(round + 1 < relaxationCount ? 1 : 4);
    }
}

std::vector<Vec3> fieldNormals(const Field &field, const SparseGrid &grid, const DualMesh &mesh) {
    std::vector<Vec3> normals(mesh.positions.size());
    for (std::size_t i = 0; i < normals.size(); ++i)
        normals[i] = normalize(
            field.sample(grid.blocks()[mesh.vertexBlocks[i]].selection, mesh.positions[i]).gradient);
    return normals;
}

// How well a triangle's plane agrees with its vertex normals, and how far it is from a sliver: the larger the better.
double triangleMerit(const std::vector<Vec3> &positions, const std::vector<Vec3> &normals, std::uint32_t a,
                     std::uint32_t b, std::uint32_t c) {
    const Vec3 ab = positions[b] - positions[a];
    const Vec3 bc = positions[c] - positions[b];
    const Vec3 ca = positions[a] - positions[c];
    const Vec3 areaNormal = cross(ab, bc);
    const double agreement =
        std::min({dot(areaNormal, normals[a]), dot(areaNormal, normals[b]), dot(areaNormal, normals[c])});
    return agreement / (dot(ab, ab) + dot(bc, bc) + dot(ca, ca));
}

// Where the grid is too coarse for the shape (a rim, a crease) the gradient at a vertex may point to the back of one
// of its triangles. The mean of its triangles' normals serves there.
void replaceContraryNormals(Mesh &mesh) {
    std::vector<Vec3> sums(mesh.positions.size());
    std::vector<bool> isContrary(mesh.positions.size(), false);
    for (const auto &triangle : mesh.triangles) {
        const Vec3 &a = mesh.positions[triangle[0]];
        const Vec3 areaNormal = cross(mesh.positions[triangle[1]] - a, mesh.positions[triangle[2]] - a);
        const double doubleArea = length(areaNormal);
        if (doubleArea == 0.0)
            continue;
        const Vec3 unitNormal = areaNormal * (1.0 / doubleArea);
        for (const std::uint32_t vertex : triangle) {
            sums[vertex] = sums[vertex] + unitNormal;
            if (dot(unitNormal, mesh.normals[vertex]) < leastAgreement)
                isContrary[vertex] = true;
        }
    }
    for (std::size_t i = 0; i < sums.size(); ++i)
        if (isContrary[i])
            mesh.normals[i] = normalize(sums[i]);
}

Mesh triangulate(const DualMesh &dual, std::vector<Vec3> normals) {
    Mesh mesh;
    mesh.triangles.reserve(dual.quads.size() * 2);
    for (const auto &[a, b, c, d] : dual.quads) {
        const double alongAc = std::min(triangleMerit(dual.positions, normals, a, b, c),
                                        triangleMerit(dual.positions, normals, a, c, d));
        const double alongBd = std::min(triangleMerit(dual.positions, normals, a, b, d),
                                        triangleMerit(dual.positions, normals, b, c, d));
        if (alongAc >= alongBd) {
            mesh.triangles.push_back({a, b, c});
            mesh.triangles.push_back({a, c, d});
        } else {
            mesh.triangles.push_back({a, b, d});
            mesh.triangles.push_back({b, c, d});
        }
    }
    mesh.positions = dual.positions;
    mesh.normals = std::move(normals);
    replaceContraryNormals(mesh);
    return mesh;
}

// The least merit of any triangle: positive when every triangle faces outwards.
double worstMerit(const Mesh &mesh) {
    double worst = 1.0;
    for (const auto &[a, b, c] : mesh.triangles)
        worst = std::min(worst, triangleMerit(mesh.positions, mesh.normals, a, b, c));
    return worst;
}

// The number of triangles times the square of the spacing, which hardly depends on the spacing. Found from grids
// that cost little beside the one that is wanted.
double countTimesSpacingSquared(const Field &field, const Box &bounds, double wantedCount) {
    const Vec3 size = bounds.high - bounds.low;
    double product = 0.5 * (size.x * size.y + size.y * size.z + size.z * size.x);
    for (const double count : {coarsestCount, std::max(coarsestCount, wantedCount / 8.0)}) {
        const double spacing = std::sqrt(product / count);
        const SparseGrid grid(field, bounds, spacing);
        product = static_cast<double>(std::max<std::size_t>(grid.crossingCount(), 1) * 2) * spacing * spacing;
    }
    return product;
}

} // namespace

Mesh polygonise(const Field &field, const Box &bounds, std::size_t minimumTriangleCount) {
    const auto wanted = static_cast<double>(minimumTriangleCount);
    // Where a spacing gives an unfit mesh, the next aims at a slightly different count.
    constexpr std::array<double, 8> aims{1.01, 1.02, 1.03, 1.005, 1.04, 1.025, 1.015, 1.035};
    double product = countTimesSpacingSquared(field, bounds, wanted);
    Mesh best;
    double bestMerit = -2.0;
    std::size_t fitCount = 0;
    for (std::size_t attempt = 0; attempt < attemptCount && fitCount < fitMeshCount; ++attempt) {
        const double spacing = std::sqrt(product / (wanted * aims[attempt % aims.size()]));
        const SparseGrid grid(field, bounds, spacing);
        const auto count = static_cast<double>(grid.crossingCount() * 2);
        if (count == 0.0)
            break;
        product = count * spacing * spacing;
        if (count < wanted || count > wanted * largestExcess)
            continue;
        DualMesh dual = buildDualMesh(field, grid);
        // V - E + F with F quads and E = 2 F edges.
        const bool isSphere = dual.positions.size() == dual.quads.size() + 2;
        if (!isSphere || !isManifold(dual))
            continue;
        relax(field, grid, dual);
        Mesh mesh = triangulate(dual, fieldNormals(field, grid, dual));
        const double merit = worstMerit(mesh);
        if (merit >= goodMerit)
            return mesh;
        ++fitCount;
        if (merit > bestMerit) {
            bestMerit = merit;
            best = std::move(mesh);
        }
    }
    if (best.triangles.empty())
        throw std::runtime_error("no grid spacing meshes the shape with " +
                                 std::to_string(minimumTriangleCount) + " triangles; ask for more");
    return best;
}

} // namespace hyalite::cat
