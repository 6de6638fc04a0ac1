// The observer of commands: progress and messages on standard error, signals as a wish to stop, settings for the
// driver.
#pragma once

#include "host/cli/progress.h"
#include "host/engine/observer.h"
#include "host/process/signals.h"

#include <optional>
#include <string>

namespace hyalite::core {

class TerminalObserver : public Observer {
  public:
    /// Quiet: without progress and advice.
    explicit TerminalObserver(bool isQuiet) : isQuiet_(isQuiet) {}

    [[nodiscard]] bool isQuiet() const { return isQuiet_; }

    void begin(const std::string &task, bool mayCompile) override;
    void progress(double share) override { line_->update(share); }
    void noise(double reached, double wanted) override { line_->setNoise(reached, wanted); }
    void end() override { line_.reset(); }
    void warning(const std::string &text) override;
    void note(const std::string &text) override;
    void advice(const std::string &text) override;
    /// The first signal, once signals are caught. Whoever asks ends soon, with what is finished: from then on a signal
    /// is only recorded.
    [[nodiscard]] std::optional<Stop> wantsStop() override;
    void beforeDriver(const gpu::ProcessorUse &use) override;

    /// Until releaseSignals(), which is called when everything is written: until then the most could be lost.
    void catchSignals() {
        if (!signals_)
            signals_.emplace(isQuiet_);
    }
    void releaseSignals() { signals_.reset(); }

  private:
    bool isQuiet_;
    std::optional<ProgressLine> line_;
    std::optional<CaughtSignals> signals_;
};

} // namespace hyalite::core
