#include "assets/cat/dual_mesh.h"

#include <algorithm>
#include <cassert>
#include <map>

namespace hyalite::cat {
namespace {

// Corner c of a cell has the offset (c & 1, c >> 1 & 1, c >> 2 & 1). Edge 4 a + n runs along axis a; n counts
// the offsets along the two other axes, the cyclically next one first.
struct CellEdge {
    int lowCorner;
    int highCorner;
};

constexpr int nextAxis(int axis) { return (axis + 1) % 3; }

constexpr CellEdge cellEdge(int edge) {
    const int axis = edge / 4;
    const int b = nextAxis(axis);
    const int c = nextAxis(b);
    const int low = ((edge & 1) << b) | (((edge >> 1) & 1) << c);
    return {low, low | (1 << axis)};
}

constexpr int edgeBetween(int lowCorner, int highCorner) {
    for (int edge = 0; edge < 12; ++edge)
        if (cellEdge(edge).lowCorner == lowCorner && cellEdge(edge).highCorner == highCorner)
            return edge;
    return -1;
}

// The four corners around each face, and the edge from each to the next.
struct CellFace {
    std::array<int, 4> corners{};
    std::array<int, 4> edges{};
};

constexpr std::array<CellFace, 6> makeCellFaces() {
    std::array<CellFace, 6> faces{};
    for (int f = 0; f < 6; ++f) {
        const int axis = f / 2;
        const int base = (f & 1) << axis;
        const int b = 1 << nextAxis(axis);
        const int c = 1 << nextAxis(nextAxis(axis));
        CellFace &face = faces[static_cast<std::size_t>(f)];
        face.corners = {base, base | b, base | b | c, base | c};
        for (std::size_t i = 0; i < 4; ++i) {
            const int from = face.corners[i];
            const int to = face.corners[(i + 1) % 4];
            face.edges[i] = from < to ? edgeBetween(from, to) : edgeBetween(to, from);
        }
    }
    return faces;
}

constexpr std::array<CellFace, 6> cellFaces = makeCellFaces();

using EdgePieces =
    std::array<std::int8_t, 12>; // which piece of surface each edge belongs to; -1 if not crossed

class Builder {
  public:
    Builder(const Field &field, const SparseGrid &grid) : field_(field), grid_(grid) {}

    DualMesh build() {
        const std::size_t blockCount = grid_.blocks().size();
        firstVertices_.assign(blockCount * cellsPerBlock, 0);
        for (std::uint32_t block = 0; block < blockCount; ++block)
            for (int k = 0; k < n; ++k)
                for (int j = 0; j < n; ++j)
                    for (int i = 0; i < n; ++i)
                        addVertices(block, {i, j, k});
        for (const SparseGrid::Block &block : grid_.blocks())
            for (int k = 0; k < n; ++k)
                for (int j = 0; j < n; ++j)
                    for (int i = 0; i < n; ++i)
                        for (int axis = 0; axis < 3; ++axis)
                            addQuad(block, {i, j, k}, axis);
        return std::move(mesh_);
    }

  private:
    static constexpr int n = SparseGrid::blockCells;
    static constexpr std::size_t cellsPerBlock = n * n * n;

    [[nodiscard]] static std::size_t localCell(const GridIndex &cell) {
        return static_cast<std::size_t>((cell[2] * n + cell[1]) * n + cell[0]);
    }

    // Two pieces of surface meet a face whose corners alternate. The field at the middle of the face says which
    // corners belong together; it depends on the face alone, so both of its cells agree.
    [[nodiscard]] bool joinsInside(const SparseGrid::Block &block, const GridIndex &cell,
                                   const CellFace &face) const {
        Vec3 sum;
        for (const int corner : {face.corners[0], face.corners[2]})
            sum = sum + grid_.position({block.firstCell[0] + cell[0] + (corner & 1),
                                        block.firstCell[1] + cell[1] + ((corner >> 1) & 1),
                                        block.firstCell[2] + cell[2] + ((corner >> 2) & 1)});
        return field_.value(block.selection, sum * 0.5) < 0.0;
    }

    // Follows the marching-cubes segments on the faces of a cell; returns the number of pieces.
    int findPieces(const SparseGrid::Block &block, const GridIndex &cell, const std::array<double, 8> &values,
                   EdgePieces &pieces) {
        for (int edge = 0; edge < 12; ++edge) {
            const CellEdge ends = cellEdge(edge);
            const bool crossed = (values[static_cast<std::size_t>(ends.lowCorner)] < 0.0) !=
                                 (values[static_cast<std::size_t>(ends.highCorner)] < 0.0);
            pieces[static_cast<std::size_t>(edge)] = static_cast<std::int8_t>(crossed ? edge : -1);
        }
        const auto join = [&pieces](int a, int b) {
            const std::int8_t keep = pieces[static_cast<std::size_t>(a)];
            const std::int8_t drop = pieces[static_cast<std::size_t>(b)];
            std::replace(pieces.begin(), pieces.end(), drop, keep);
        };
        for (const CellFace &face : cellFaces) {
            std::array<int, 4> crossed{};
            std::size_t crossedCount = 0;
            for (const int edge : face.edges)
                if (pieces[static_cast<std::size_t>(edge)] >= 0)
                    crossed[crossedCount++] = edge;
            if (crossedCount == 2) {
                join(crossed[0], crossed[1]);
            } else if (crossedCount == 4) {
                mesh_.hasAmbiguousFaces = true;
                // Edges i and i + 1 meet at corner i + 1: cut off the corners that the middle does not belong to.
                const bool secondInside = values[static_cast<std::size_t>(face.corners[1])] < 0.0;
                const bool cutsSecond = secondInside != joinsInside(block, cell, face);
                join(face.edges[cutsSecond ? 0 : 1], face.edges[cutsSecond ? 1 : 2]);
                join(face.edges[cutsSecond ? 2 : 3], face.edges[cutsSecond ? 3 : 0]);
            }
        }
        // Number the pieces 0, 1, ... by their lowest edge.
        EdgePieces numbered;
        numbered.fill(-1);
        std::int8_t count = 0;
        for (std::size_t edge = 0; edge < 12; ++edge) {
            if (pieces[edge] < 0 || numbered[edge] >= 0)
                continue;
            for (std::size_t other = edge; other < 12; ++other)
                if (pieces[other] == pieces[edge])
                    numbered[other] = count;
            ++count;
        }
        pieces = numbered;
        return count;
    }

    void addVertices(std::uint32_t blockIndex, const GridIndex &cell) {
        const SparseGrid::Block &block = grid_.blocks()[blockIndex];
        std::array<double, 8> values{};
        int insideCount = 0;
        for (int corner = 0; corner < 8; ++corner) {
            const double value = block.values[SparseGrid::valueIndex(
                cell[0] + (corner & 1), cell[1] + ((corner >> 1) & 1), cell[2] + ((corner >> 2) & 1))];
            values[static_cast<std::size_t>(corner)] = value;
            insideCount += value < 0.0 ? 1 : 0;
        }
        if (insideCount == 0 || insideCount == 8)
            return;
        EdgePieces pieces{};
        const int pieceCount = findPieces(block, cell, values, pieces);
        const std::size_t cellIndex = blockIndex * cellsPerBlock + localCell(cell);
        firstVertices_[cellIndex] = static_cast<std::uint32_t>(mesh_.positions.size());
        if (pieceCount > 1)
            splitCells_.emplace(cellIndex, pieces);
        const Vec3 low = grid_.position(
            {block.firstCell[0] + cell[0], block.firstCell[1] + cell[1], block.firstCell[2] + cell[2]});
        for (int piece = 0; piece < pieceCount; ++piece) {
            mesh_.positions.push_back(low + meanCrossing(values, pieces, piece) * grid_.spacing());
            mesh_.vertexBlocks.push_back(blockIndex);
        }
    }

    // The mean of a piece's crossings, by linear interpolation, in the unit cube.
    [[nodiscard]] static Vec3 meanCrossing(const std::array<double, 8> &values, const EdgePieces &pieces,
                                           int piece) {
        Vec3 sum;
        int count = 0;
        for (int edge = 0; edge < 12; ++edge) {
            if (pieces[static_cast<std::size_t>(edge)] != piece)
                continue;
            const CellEdge ends = cellEdge(edge);
            const double low = values[static_cast<std::size_t>(ends.lowCorner)];
            const double high = values[static_cast<std::size_t>(ends.highCorner)];
            const double t = low / (low - high);
            Vec3 crossing{static_cast<double>(ends.lowCorner & 1),
                          static_cast<double>((ends.lowCorner >> 1) & 1),
                          static_cast<double>((ends.lowCorner >> 2) & 1)};
            (edge / 4 == 0 ? crossing.x : edge / 4 == 1 ? crossing.y : crossing.z) = t;
            sum = sum + crossing;
            ++count;
        }
        return sum * (1.0 / count);
    }

    // The vertex of the piece that crosses edge `edge` of a cell, given by its index in the whole grid.
    [[nodiscard]] std::uint32_t vertexAt(const GridIndex &cell, int edge) const {
        const std::uint32_t block = grid_.blockOf(cell);
        const std::size_t cellIndex =
            block * cellsPerBlock + localCell({cell[0] % n, cell[1] % n, cell[2] % n});
        const auto split = splitCells_.find(cellIndex);
        const int piece = split == splitCells_.end() ? 0 : split->second[static_cast<std::size_t>(edge)];
        return firstVertices_[cellIndex] + static_cast<std::uint32_t>(piece);
    }

    //      c
    //      ^  3 | 2      The four cells around an edge along axis a, which points at the reader:
    //      | ---+---     counter-clockwise from outside when the edge leaves the solid.
    //      |  0 | 1
    //      +-------> b
    void addQuad(const SparseGrid::Block &block, const GridIndex &point, int axis) {
        GridIndex other = point;
        ++other[static_cast<std::size_t>(axis)];
        const bool startsInside = block.values[SparseGrid::valueIndex(point[0], point[1], point[2])] < 0.0;
        const bool endsInside = block.values[SparseGrid::valueIndex(other[0], other[1], other[2])] < 0.0;
        if (startsInside == endsInside)
            return;
        const auto b = static_cast<std::size_t>(nextAxis(axis));
        const auto c = static_cast<std::size_t>(nextAxis(nextAxis(axis)));
        std::array<std::uint32_t, 4> quad{};
        for (std::size_t i = 0; i < 4; ++i) {
            const int backB = i == 0 || i == 3 ? 1 : 0;
            const int backC = i < 2 ? 1 : 0;
            GridIndex cell{block.firstCell[0] + point[0], block.firstCell[1] + point[1],
                           block.firstCell[2] + point[2]};
            cell[b] -= backB;
            cell[c] -= backC;
            quad[startsInside ? i : 3 - i] = vertexAt(cell, 4 * axis + backB + 2 * backC);
        }
        mesh_.quads.push_back(quad);
    }

    const Field &field_;
    const SparseGrid &grid_;
    std::vector<std::uint32_t> firstVertices_;     // by block and cell
    std::map<std::size_t, EdgePieces> splitCells_; // the few cells with more than one piece
    DualMesh mesh_;
};

} // namespace

DualMesh buildDualMesh(const Field &field, const SparseGrid &grid) { return Builder(field, grid).build(); }

bool isManifold(const DualMesh &mesh) {
    if (!mesh.hasAmbiguousFaces)
        return true;
    // The dual of a closed surface pairs every directed edge with its opposite; only repeats are to be found.
    std::vector<std::array<std::uint32_t, 2>> edges;
    edges.reserve(mesh.quads.size() * 4);
    for (const auto &quad : mesh.quads)
        for (std::size_t i = 0; i < 4; ++i)
            edges.push_back({quad[i], quad[(i + 1) % 4]});
    std::sort(edges.begin(), edges.end());
    return std::adjacent_find(edges.begin(), edges.end()) == edges.end();
}

} // namespace hyalite::cat
