#include "host/base/json_text.h"
#include "host/cli/diff_options.h"
#include "host/cli/options.h"
#include "host/cli/requested_file.h"
#include "host/cli/statistical.h"
#include "host/film/timeline.h"
#include "host/report/junit.h"
#include "host/report/provenance.h"

#include <fmt/format.h>

#include <vector>

namespace hyalite::core {

void requireSameSize(const Image &a, const std::string &pathA, const Image &b, const std::string &pathB) {
    if (a.width() != b.width() || a.height() != b.height())
        throw Error(
            ErrorKind::BadInput,
            fmt::format("'{}' has {} x {} pixels but '{}' has {} x {}; images are compared pixel by pixel",
                        pathA, a.width(), a.height(), pathB, b.width(), b.height()));
}

std::string diffToJunit(const DiffOptions &options, double seconds, const std::string &failure) {
    const std::vector<TestSuite> suites{
        {"hyalite diff",
         {{"hyalite diff", fmt::format("{} and {}", options.reference, options.test), seconds, failure}}}};
    return junitText("hyalite diff", suites);
}

ExitCode runStatisticalDiff(const DiffOptions &options, const std::string &commandLine) {
    requireDistinctFiles({{"--report", options.report}, {"--junit", options.junit}},
                         {options.reference, options.test});
    RequestedFile reportFile(options.report);
    RequestedFile junitFile(options.junit);
    Stopwatch watch;
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
        reportFile.store(jsonText(report));
    }
    if (junitFile)
        junitFile.store(diffToJunit(options, watch.lap().seconds(), failureOf(result)));
    return result.isPassed() ? ExitCode::Ok : ExitCode::AnswerIsNo;
}

} // namespace hyalite::core
