// Profile as a timeline in the Trace Event Format, for ui.perfetto.dev and chrome://tracing.
//
// https://docs.google.com/document/d/1CvAClvFfyA5R-PhYUmn5OOQtYMH4h6I0nSsKchNAySU (N. Duca, D. Sinclair, "Trace Event
// Format"). Times are in microseconds since the profile began. There are two tracks,
//
//     host     |load|open|  repeat 1: |upload|pipeline| dispatches: |submit and wait|submit and wait| |readback|
//     device                                            kernel       kernel
//
// and counters of the rays per second and of the memory in use.
#pragma once

#include "host/report/profile.h"

#include <nlohmann/json.hpp>

namespace hyalite::core {

[[nodiscard]] nlohmann::ordered_json profileToTrace(const Profile &profile);

} // namespace hyalite::core
