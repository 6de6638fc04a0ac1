#include "host/cli/terminal_observer.h"

#include "host/base/message.h"
#include "host/process/process.h"

namespace hyalite::core {

void TerminalObserver::begin(const std::string &task, bool mayCompile) {
    line_.emplace(task, isQuiet_);
    if (mayCompile)
        line_->expectCompiler();
}

void TerminalObserver::warning(const std::string &text) { printWarning("{}", text); }

void TerminalObserver::note(const std::string &text) { printMessage("note: {}\n", text); }

void TerminalObserver::advice(const std::string &text) {
    if (!isQuiet_)
        printWarning("{}", text);
}

std::optional<Stop> TerminalObserver::wantsStop() {
    if (!signals_)
        return std::nullopt;
    signals_->keepResults();
    const int signal = signals_->first();
    return signal != 0 ? std::optional(Stop{signalName(signal), errorKindOf(signal)}) : std::nullopt;
}

void TerminalObserver::beforeDriver(const gpu::ProcessorUse &use) { prepareDriver(use); }

} // namespace hyalite::core
