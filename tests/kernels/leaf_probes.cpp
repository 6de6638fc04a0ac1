#include "tests/kernels/leaf_probes.h"

#include <algorithm>

namespace hyalite::core::testing {
namespace {

using namespace leaves;

#include "leaf_words.h"

#include "leaf_probe_table.h"

} // namespace

const std::vector<LeafProbe> &leafProbes() { return probeTable; }

const LeafStruct *leafStruct(const std::string &type) {
    const auto found = std::ranges::find(structTable, type, &LeafStruct::name);
    return found != structTable.end() ? &*found : nullptr;
}

} // namespace hyalite::core::testing
