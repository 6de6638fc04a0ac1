#include "host/report/trace_json.h"

#include "host/base/version.h"
#include "host/report/render_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <tuple>

namespace hyalite::core {

namespace {

using OrderedJson = nlohmann::ordered_json;

/// A process of the trace, which has one thread.
enum class Track { Host = 1, Device = 2 };

/// Collects events and sorts them as the format requires.
class TraceEvents {
  public:
    explicit TraceEvents(std::int64_t epochNanos) : epochNanos_(epochNanos) {}

    void nameTrack(Track track, const std::string &process, const std::string &thread) {
        names_.push_back(event("M", track, "process_name", {{"args", {{"name", process}}}}));
        names_.push_back(event("M", track, "thread_name", {{"args", {{"name", thread}}}}));
        names_.push_back(
            event("M", track, "process_sort_index", {{"args", {{"sort_index", static_cast<int>(track)}}}}));
    }

    void addSlice(Track track, const std::string &category, const std::string &name, const Span &span,
                  const OrderedJson &args = OrderedJson::object()) {
        add(span, event("X", track, name,
                        {{"cat", category},
                         {"ts", micros(span.beginNanos)},
                         {"dur", static_cast<double>(span.endNanos - span.beginNanos) / 1e3},
                         {"args", args}}));
    }

    void addCounter(Track track, const std::string &name, std::int64_t nanos, const OrderedJson &values) {
        add({nanos, nanos}, event("C", track, name, {{"ts", micros(nanos)}, {"args", values}}));
    }

    /// The events by time; enclosing ones come before those inside them.
    [[nodiscard]] OrderedJson take() {
        std::stable_sort(timed_.begin(), timed_.end(), [](const Timed &a, const Timed &b) {
            return std::tuple(a.span.beginNanos, -a.span.endNanos) <
                   std::tuple(b.span.beginNanos, -b.span.endNanos);
        });
        OrderedJson all = std::move(names_);
        for (Timed &timed : timed_)
            all.push_back(std::move(timed.json));
        return all;
    }

  private:
    struct Timed {
        Span span;
        OrderedJson json;
    };

    static OrderedJson event(const char *phase, Track track, const std::string &name,
                             const OrderedJson &rest) {
        OrderedJson json{{"name", name}, {"ph", phase}, {"pid", static_cast<int>(track)}, {"tid", 1}};
        json.update(rest);
        return json;
    }

    void add(const Span &span, OrderedJson json) { timed_.push_back({span, std::move(json)}); }

    [[nodiscard]] double micros(std::int64_t nanos) const {
        return static_cast<double>(nanos - epochNanos_) / 1e3;
    }

    std::int64_t epochNanos_;
    OrderedJson names_ = OrderedJson::array();
    std::vector<Timed> timed_;
};

/// Rates of each kind of ray during the dispatch.
OrderedJson megaraysPerSecond(const DispatchRecord &dispatch) {
    const double seconds = dispatch.times.best().seconds();
    OrderedJson json;
    for (const RayKind &kind : rayKinds)
        json[kind.name] =
            seconds > 0.0 ? static_cast<double>(dispatch.rays.*kind.count) / 1e6 / seconds : 0.0;
    return json;
}

OrderedJson dispatchArguments(const DispatchRecord &dispatch) {
    return {{"tile", fmt::format("{}x{} at ({}, {})", dispatch.tileWidth, dispatch.tileHeight, dispatch.tileX,
                                 dispatch.tileY)},
            {"samples", fmt::format("{} to {}", dispatch.sampleBegin, dispatch.sampleEnd)},
            {"resumed", dispatch.isResumed},
            {"invocations", dispatch.invocations},
            {"rays", raysToJson(dispatch.rays)}};
}

void addDispatch(TraceEvents &events, const DispatchRecord &dispatch) {
    const Span &best = dispatch.times.best();
    events.addSlice(Track::Host, "submission", "submit and wait", dispatch.times.host);
    events.addSlice(Track::Device, "dispatch", dispatch.kernel, best, dispatchArguments(dispatch));
    events.addCounter(Track::Device, "Mray/s", best.beginNanos, megaraysPerSecond(dispatch));
}

void addFrame(TraceEvents &events, const Frame &frame) {
    OrderedJson args{{"measured", frame.isMeasured}};
    if (frame.finishedShare < 1.0)
        args["finishedShare"] = frame.finishedShare;
    events.addSlice(Track::Host, "frame", frame.label, frame.span, args);
    for (const StageRecord &stage : frame.timeline.stages) {
        events.addSlice(Track::Host, "stage", stage.name, stage.span);
        events.addCounter(Track::Device, "memory (bytes)", stage.span.endNanos,
                          {{"buffers", stage.deviceBytes}});
    }
    for (const DispatchRecord &dispatch : frame.timeline.dispatches)
        addDispatch(events, dispatch);
    // The counters drop to 0 here: nothing is traced until the first dispatch of the next frame, and the buffers of
    // this one are gone.
    if (!frame.timeline.dispatches.empty())
        events.addCounter(Track::Device, "Mray/s", frame.timeline.dispatches.back().times.best().endNanos,
                          megaraysPerSecond({}));
    events.addCounter(Track::Device, "memory (bytes)", frame.span.endNanos, {{"buffers", 0}});
}

std::int64_t beginOf(const Profile &profile) {
    std::int64_t begin = profile.frames.front().span.beginNanos;
    for (const StageRecord &stage : profile.hostStages)
        begin = std::min(begin, stage.span.beginNanos);
    return begin;
}

} // namespace

OrderedJson profileToTrace(const Profile &profile) {
    const std::string &clock = profile.frames.back().timeline.clock;
    TraceEvents events(beginOf(profile));
    events.nameTrack(Track::Host, "hyalite", "host");
    events.nameTrack(Track::Device, profile.device.name, "kernels, by " + clock);
    for (const StageRecord &stage : profile.hostStages)
        events.addSlice(Track::Host, "stage", stage.name, stage.span);
    for (const Frame &frame : profile.frames)
        addFrame(events, frame);
    OrderedJson origin{{"program", "hyalite " HYALITE_VERSION}, {"commandLine", profile.origin.commandLine},
                       {"scene", profile.origin.scene},         {"device", profile.device.name},
                       {"driver", profile.device.driver},       {"clock", clock}};
    if (!profile.leftOut.empty())
        origin["leftOut"] = profile.leftOut;
    return {{"traceEvents", events.take()}, {"displayTimeUnit", "ms"}, {"otherData", origin}};
}

} // namespace hyalite::core
