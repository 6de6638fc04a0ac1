// A Vulkan layer that makes calls fail, lies about what a device can do, and counts calls and objects.
//
// As any explicit layer it is enabled by VK_ADD_LAYER_PATH and VK_INSTANCE_LAYERS=VK_LAYER_HYALITE_faults, and told
// what to do by
//
//   HYALITE_FAULTS      which calls fail: "vkQueueSubmit:5:VK_ERROR_DEVICE_LOST" is the fifth of the process,
//                       "vkQueueSubmit:5+:..." the fifth and all that follow, "*:5:..." the fifth call of all that
//                       return a VkResult; several are separated by commas
//   HYALITE_FAKES       what a device lacks, separated by commas: see faults.cpp
//   HYALITE_FAULT_TALLY a file that gets the tally when the process ends
//
// A process that links the layer, as tests do that start many renders, tells it by the functions below.
#pragma once

#include <vulkan/vulkan.h>

#define HYALITE_FAULT_API extern "C" __attribute__((visibility("default")))

/// Replaces what was told before, as HYALITE_FAULTS; counts of calls begin again.
HYALITE_FAULT_API void hyaliteSetFaults(const char *faults);
/// The same for HYALITE_FAKES.
HYALITE_FAULT_API void hyaliteSetFakes(const char *fakes);

/// What happened since the last hyaliteSetFaults, a line each: "call vkCreateBuffer 12", how often it was called;
/// "fault vkCreateBuffer 3", the call that failed; and "alive vkCreateBuffer 1", objects made by it that are not yet
/// destroyed. Good until the next call.
HYALITE_FAULT_API const char *hyaliteFaultTally();

/// What the named function has to return now, as a call of it: for calls that no layer can see.
HYALITE_FAULT_API VkResult hyaliteNextFault(const char *function);

/// Whether something is faked, likewise.
HYALITE_FAULT_API bool hyaliteIsFaked(const char *fake);

/// Whether calls of the named function can fail.
HYALITE_FAULT_API bool hyaliteCanFail(const char *function);
