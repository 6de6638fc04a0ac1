// OBJ meshes: the reader's promises, its two ways of reading a statement, and a bare mesh's way into a scene.
#include "host/import/obj.h"
#include "host/scene/framing.h"
#include "host/scene/validate.h"
#include "tests/fuzz/harness.h"
#include "tests/fuzz/heap_peak.h"
#include "tests/fuzz/mesh_promises.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hyalite::core::fuzz {
namespace {

struct Outcome {
    std::optional<std::string> refusal;
    ObjMesh loaded; ///< where it is not refused
};

Outcome load(const std::filesystem::path &file) {
    Outcome outcome;
    outcome.refusal = refusalOf([&] { outcome.loaded = loadObj(file); });
    return outcome;
}

/// The same text with a blank in front of each line. It means the same, and no statement is plain any more.
std::string indented(std::string_view text) {
    constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";
    std::string result;
    if (text.starts_with(byteOrderMark)) {
        result = byteOrderMark;
        text.remove_prefix(byteOrderMark.size());
    }
    bool beginsLine = true;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (beginsLine)
            result += ' ';
        result += text[i];
        beginsLine = text[i] == '\n' || (text[i] == '\r' && (i + 1 == text.size() || text[i + 1] != '\n'));
    }
    return result;
}

template <class T> bool haveSameBits(const std::vector<T> &a, const std::vector<T> &b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

void requireSame(const Outcome &a, const Outcome &b) {
    require(a.refusal == b.refusal, "refused otherwise when indented:\n" + a.refusal.value_or("taken") +
                                        '\n' + b.refusal.value_or("taken"));
    const TriangleMesh &meshA = a.loaded.mesh;
    const TriangleMesh &meshB = b.loaded.mesh;
    require(haveSameBits(meshA.positions, meshB.positions), "other positions when indented");
    require(haveSameBits(meshA.normals, meshB.normals), "other normals when indented");
    require(haveSameBits(meshA.triangles, meshB.triangles), "other triangles when indented");
    require(haveSameBits(meshA.uvs, meshB.uvs) && haveSameBits(meshA.triangleUvs, meshB.triangleUvs),
            "other texture coordinates when indented");
    const MeshReport &reportA = a.loaded.report;
    const MeshReport &reportB = b.loaded.report;
    require(reportA.faceCount == reportB.faceCount && reportA.polygonCount == reportB.polygonCount &&
                reportA.degenerateTriangleCount == reportB.degenerateTriangleCount &&
                reportA.lostNormalCount == reportB.lostNormalCount &&
                reportA.unusedStatementCount == reportB.unusedStatementCount,
            "another report when indented");
}

void run(std::string_view text) {
    static const TemporaryFolder folder;
    const std::filesystem::path file = folder.write("input.obj", text);
    Outcome outcome;
    {
        const HeapPeak peak;
        outcome = load(file);
        requireBoundedMemory(peak, text.size());
    }
    // What other files begin with, such as gzip, is that at the beginning alone.
    if (outcome.refusal.value_or("").find("this is not OBJ text") == std::string::npos)
        requireSame(outcome, load(folder.write("input.obj", indented(text))));
    if (outcome.refusal)
        return;
    requireSound(outcome.loaded.mesh);
    (void)refusalOf([&] { validateScene(frameMesh(std::move(outcome.loaded.mesh)), "input.obj"); });
}

} // namespace
} // namespace hyalite::core::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t sizeBytes) {
    hyalite::core::fuzz::run(hyalite::core::fuzz::textOf(data, sizeBytes));
    return 0;
}
