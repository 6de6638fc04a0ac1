// A profile made by hand, for tests of what is written about it.
#pragma once

#include "host/report/profile.h"

#include <string>
#include <vector>

namespace hyalite::testing {

inline Span millisSpan(double begin, double end) {
    return {static_cast<std::int64_t>(begin * 1e6), static_cast<std::int64_t>(end * 1e6)};
}

/// A frame of two dispatches of kernel "a" and one of "b", which take 10, 30 and 20 times `scale` milliseconds on the
/// device, and one more on the host. Stages: "upload" of 5 ms, then "dispatches".
inline Frame handMadeFrame(const std::string &label, bool isMeasured, double beginMillis, double scale) {
    Frame frame;
    frame.label = label;
    frame.isMeasured = isMeasured;
    frame.timeline.clock = "a clock";
    double now = beginMillis + 5.0;
    frame.timeline.stages.push_back({"upload", millisSpan(beginMillis, now), 1000});
    const double dispatchesBegin = now;
    int tileX = 0;
    for (const auto &[kernel, millis] : {std::pair("a", 10.0), std::pair("a", 30.0), std::pair("b", 20.0)}) {
        DispatchRecord dispatch;
        dispatch.kernel = kernel;
        dispatch.tileX = tileX++ * 16;
        dispatch.tileY = 8;
        dispatch.tileWidth = 16;
        dispatch.tileHeight = 12;
        dispatch.sampleEnd = 4;
        dispatch.isResumed = millis == 30.0;
        dispatch.rays = {1000, 2000, 300, 40};
        dispatch.invocations = 192;
        dispatch.times.host = millisSpan(now, now + millis * scale + 1.0);
        dispatch.times.device = millisSpan(now + 0.5, now + 0.5 + millis * scale);
        now += millis * scale + 1.0;
        frame.timeline.dispatches.push_back(dispatch);
    }
    frame.timeline.stages.push_back({"dispatches", millisSpan(dispatchesBegin, now), 2500});
    frame.span = millisSpan(beginMillis, now + 2.0);
    return frame;
}

/// A frame that is not measured, and one for each scale that is, a second after each other.
inline Profile handMadeProfile(const std::vector<double> &scales) {
    Profile profile;
    profile.origin.commandLine = "hyalite profile a.json";
    profile.origin.scene = "a.json";
    profile.device.name = "the device";
    profile.device.driver = "the driver 1.0";
    profile.device.arithmetic = "own";
    profile.verification = "equal";
    profile.isVerified = true;
    profile.origin.width = 64;
    profile.origin.height = 48;
    profile.origin.settings.samplesPerPixel = 4;
    profile.origin.triangleCount = 12;
    profile.sceneBytes = 345;
    profile.hostStages = {{"load", millisSpan(1.0, 3.0)}, {"write", millisSpan(99'000.0, 99'007.0)}};
    profile.frames.push_back(handMadeFrame("warm-up 1", false, 1000.0, 3.0));
    for (std::size_t i = 0; i < scales.size(); ++i)
        profile.frames.push_back(handMadeFrame("repeat " + std::to_string(i + 1), true,
                                               2000.0 + 1000.0 * static_cast<double>(i), scales[i]));
    return profile;
}

} // namespace hyalite::testing
