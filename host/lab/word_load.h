// A load of a soak that exercises the words of a device: its memory, or its arithmetic.
#pragma once

#include "host/gpu/word_exercise.h"
#include "host/lab/running_load.h"

#include <memory>
#include <string_view>

namespace hyalite::core {

[[nodiscard]] std::string_view nameOfWork(gpu::WordWork work);

[[nodiscard]] std::unique_ptr<RunningLoad> newWordLoad(Soak &soak, gpu::WordWork work,
                                                       const gpu::DeviceInfo &device);

} // namespace hyalite::core
