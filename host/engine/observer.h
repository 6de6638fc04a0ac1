// Observer: receives progress and messages of preparation and rendering, and may request a stop. Nothing below it
// prints.
#pragma once

#include "host/base/error.h"
#include "host/gpu/processor_use.h"

#include <optional>
#include <string>

namespace hyalite::core {

/// A request to end a render, and how the render then counts.
struct Stop {
    std::string by; ///< "SIGINT"
    ErrorKind kind;
};

/// Does nothing itself. Texts are sentences for people, without a full stop; names in them may have control characters.
class Observer {
  public:
    virtual ~Observer() = default;

    /// A task begins, "load" or "render". `mayCompile`: a driver may compile for long before the first progress.
    virtual void begin(const std::string & /*task*/, bool /*mayCompile*/) {}
    /// The share of the task that is finished, in [0, 1]. Called by one thread at a time.
    virtual void progress(double /*share*/) {}
    /// The noise of the present picture (host/film/noise.h), and what it is to be, while the task goes on.
    virtual void noise(double /*reached*/, double /*wanted*/) {}
    virtual void end() {}

    // These three may be called by any thread.

    /// Something in the input is lost, or damages the picture.
    virtual void warning(const std::string & /*text*/) {}
    /// Something goes on otherwise than it was asked for.
    virtual void note(const std::string & /*text*/) {}
    /// The picture may be other than people expect, for a reason that is in the scene.
    virtual void advice(const std::string & /*text*/) {}

    /// Whether the render is to end with what is finished, which is kept. Asked often, by any thread.
    [[nodiscard]] virtual std::optional<Stop> wantsStop() { return std::nullopt; }

    /// Before a driver is loaded, by the thread that prepares: the time to set environment variables for it.
    virtual void beforeDriver(const gpu::ProcessorUse & /*use*/) {}
};

/// Nobody watches.
[[nodiscard]] inline Observer &nobody() {
    static Observer observer;
    return observer;
}

/// A task of an observer, as long as it lives.
class ObservedTask {
  public:
    ObservedTask(Observer &observer, const std::string &name, bool mayCompile = false) : observer_(observer) {
        observer_.begin(name, mayCompile);
    }
    ~ObservedTask() { observer_.end(); }
    ObservedTask(const ObservedTask &) = delete;
    ObservedTask &operator=(const ObservedTask &) = delete;

    void update(double share) { observer_.progress(share); }
    void noise(double reached, double wanted) { observer_.noise(reached, wanted); }

  private:
    Observer &observer_;
};

} // namespace hyalite::core
