#include "host/base/atomic_file.h"
#include "host/base/json_text.h"
#include "host/cli/diff_options.h"
#include "host/cli/options.h"
#include "host/cli/statistical.h"
#include "host/report/provenance.h"

#include <fmt/format.h>

#include <optional>

namespace hyalite::core {

void requireSameSize(const Image &a, const std::string &pathA, const Image &b, const std::string &pathB) {
    if (a.width() != b.width() || a.height() != b.height())
        throw Error(
            ErrorKind::BadInput,
            fmt::format("'{}' has {} x {} pixels but '{}' has {} x {}; images are compared pixel by pixel",
                        pathA, a.width(), a.height(), pathB, b.width(), b.height()));
}

ExitCode runStatisticalDiff(const DiffOptions &options, const std::string &commandLine) {
    requireDistinctFiles({{"--report", options.report}}, {options.reference, options.test});
    std::optional<AtomicFile> reportFile;
    if (!options.report.empty())
        reportFile.emplace(options.report);
    const Estimate reference = readEstimate(options.reference);
    const Estimate test = readEstimate(options.test);
    requireSameSize(reference.mean, options.reference, test.mean, options.test);
    const WelchResult result = testAndPrint(reference, test, options.welch,
                                            fmt::format("'{}' and '{}'", options.reference, options.test));
    if (reportFile) {
        nlohmann::ordered_json report = programToJson(commandLine);
        report["reference"] = options.reference;
        report["test"] = options.test;
        report["statistical"] = welchToJson(result, options.welch);
        report["passed"] = result.isPassed();
        reportFile->write(jsonText(report));
        reportFile->commit();
    }
    return result.isPassed() ? ExitCode::Ok : ExitCode::AnswerIsNo;
}

} // namespace hyalite::core
