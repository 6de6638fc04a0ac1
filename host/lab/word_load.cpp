#include "host/lab/word_load.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace hyalite::core {

std::string_view nameOfWork(gpu::WordWork work) {
    return work == gpu::WordWork::Memory ? memoryLoad : arithmeticLoad;
}

namespace {

class WordLoad : public RunningLoad {
  public:
    WordLoad(Soak &soak, gpu::WordWork work, const gpu::DeviceInfo &device)
        : RunningLoad(soak, std::string(nameOfWork(work)),
                      work == gpu::WordWork::Memory ? "bytes" : "rounds"),
          work_(work), device_(device) {}

  protected:
    void run(const TimeLimit &slice) override {
        const std::uint64_t most = gpu::exercisableBytes(device_);
        gpu::WordExercise exercise(device_, work_,
                                   std::min(soak_.request.maxMemoryBytes.value_or(most), most));
        const auto shouldStop = [this] { return soak_.isStopped(); };
        do {
            const gpu::WordPass pass = exercise.run(load().passes, shouldStop);
            if (soak_.isStopped())
                return;
            const auto words = static_cast<double>(pass.wordCount);
            if (work_ == gpu::WordWork::Memory) // to compare is to read, which is half of the exercise
                countPass(words * 8.0, pass.fillSeconds + pass.compareSeconds, 0.0);
            else
                countPass(words * exercise.rounds(), pass.fillSeconds, pass.compareSeconds);
            if (pass.wrongCount > 0)
                explain(pass);
        } while (goesOn(slice));
    }

  private:
    void explain(const gpu::WordPass &pass) {
        ++load().wrongPasses;
        SoakFault fault = newFault(SoakFault::Kind::Words);
        fault.wrongCount = pass.wrongCount;
        fault.memory = pass.wrong;
        for (const gpu::WrongMemory &word : pass.wrong)
            soak_.verdict.patterns.addBits(word.found, word.expected);
        soak_.report(std::move(fault));
    }

    gpu::WordWork work_;
    gpu::DeviceInfo device_;
};

} // namespace

std::unique_ptr<RunningLoad> newWordLoad(Soak &soak, gpu::WordWork work, const gpu::DeviceInfo &device) {
    return std::make_unique<WordLoad>(soak, work, device);
}

} // namespace hyalite::core
