// The pages of `hyalite inspect`: a scene's summary and what was measured beside it, as text on standard output.
#pragma once

#include "host/lab/coverage.h"
#include "host/lab/scene_summary.h"
#include "host/lab/tree_check.h"

namespace hyalite::core {

/// Of lists at most 32 rows.
void printSummary(const SceneSummary &summary);

/// Likewise.
void printCoverage(const Coverage &coverage);

void printTreeCheck(const TreeCheck &check);

} // namespace hyalite::core
