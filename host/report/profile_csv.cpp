#include "host/report/profile_csv.h"

#include <fmt/format.h>

namespace hyalite::core {

namespace {

/// A field, in quotes if RFC 4180 requires them.
std::string field(const std::string &text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos)
        return text;
    std::string quoted = "\"";
    for (const char letter : text) {
        if (letter == '"')
            quoted += '"';
        quoted += letter;
    }
    return quoted + "\"";
}

std::string spanFields(const std::optional<Span> &span, std::int64_t epochNanos) {
    if (!span)
        return ",";
    return fmt::format("{:.6f},{:.6f}", Span{epochNanos, span->beginNanos}.millis(), span->millis());
}

} // namespace

std::string profileCsv(const Profile &profile) {
    std::string text =
        "frame,measured,dispatch,kernel,tile_x,tile_y,tile_width,tile_height,sample_begin,sample_end,resumed,"
        "invocations,";
    for (const RayKind &kind : rayKinds)
        text += fmt::format("{}_rays,", kind.name);
    text += "host_begin_ms,host_ms,device_begin_ms,device_ms\r\n";
    const std::int64_t epoch = profile.frames.front().span.beginNanos;
    for (const Frame &frame : profile.frames) {
        std::size_t index = 0;
        for (const DispatchRecord &dispatch : frame.timeline.dispatches) {
            text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},", field(frame.label),
                                frame.isMeasured ? 1 : 0, index++, field(dispatch.kernel), dispatch.tileX,
                                dispatch.tileY, dispatch.tileWidth, dispatch.tileHeight, dispatch.sampleBegin,
                                dispatch.sampleEnd, dispatch.isResumed ? 1 : 0, dispatch.invocations);
            for (const RayKind &kind : rayKinds)
                text += fmt::format("{},", dispatch.rays.*kind.count);
            text += fmt::format("{},{}\r\n", spanFields(dispatch.times.host, epoch),
                                spanFields(dispatch.times.device, epoch));
        }
    }
    return text;
}

} // namespace hyalite::core
