#include "host/farm/ranks.h"

#include "host/base/error.h"

#if HYALITE_MPI
#include <mpi.h>
#endif

#include <cassert>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <mutex>
#include <thread>

namespace hyalite::core {

namespace {

/// The number of ranks that Open MPI, MPICH, PMIx or Slurm's srun tells a program before MPI is initialised; 1 if there
/// is none. Slurm tells batch jobs, too, that are no MPI programs: there the step's own manager counts.
int startedRanks() {
    for (const char *name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MPI_LOCALNRANKS"})
        if (const char *text = std::getenv(name))
            return std::atoi(text);
    return 1;
}

#if HYALITE_MPI

constexpr int tag = 1;

/// All calls are made by one thread at a time, and none waits for another process.
class MpiRanks : public Ranks {
  public:
    MpiRanks() {
        int provided = MPI_THREAD_SINGLE;
        MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided); // errors end the program
        MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
        MPI_Comm_size(MPI_COMM_WORLD, &count_);
    }
    ~MpiRanks() override { MPI_Finalize(); }
    MpiRanks(const MpiRanks &) = delete;
    MpiRanks &operator=(const MpiRanks &) = delete;

    [[nodiscard]] int rank() const override { return rank_; }
    [[nodiscard]] int count() const override { return count_; }

    void send(int to, std::span<const std::byte> message) override {
        assert(message.size() <= static_cast<std::size_t>(std::numeric_limits<int>::max()));
        MPI_Request request = MPI_REQUEST_NULL;
        {
            const std::scoped_lock lock(mutex_);
            MPI_Isend(message.data(), static_cast<int>(message.size()), MPI_BYTE, to, tag, MPI_COMM_WORLD,
                      &request);
        }
        for (int isSent = 0;;) {
            {
                const std::scoped_lock lock(mutex_);
                MPI_Test(&request, &isSent, MPI_STATUS_IGNORE);
            }
            if (isSent != 0)
                return;
            std::this_thread::sleep_for(std::chrono::microseconds(200)); // the cores are for rendering
        }
    }

    [[nodiscard]] std::optional<std::vector<std::byte>> poll(int from) override {
        const std::scoped_lock lock(mutex_);
        int isThere = 0;
        MPI_Status status{};
        MPI_Iprobe(from, tag, MPI_COMM_WORLD, &isThere, &status);
        if (isThere == 0)
            return std::nullopt;
        int size = 0;
        MPI_Get_count(&status, MPI_BYTE, &size);
        std::vector<std::byte> message(static_cast<std::size_t>(size));
        MPI_Recv(message.data(), size, MPI_BYTE, from, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
        return message;
    }

  private:
    std::mutex mutex_;
    int rank_ = 0;
    int count_ = 1;
};

#endif

} // namespace

std::unique_ptr<Ranks> joinRanks() {
    if (startedRanks() <= 1)
        return nullptr;
#if HYALITE_MPI
    auto ranks = std::make_unique<MpiRanks>();
    return ranks->count() > 1 ? std::unique_ptr<Ranks>(std::move(ranks)) : nullptr;
#else
    throw Error(ErrorKind::Usage,
                "this program was built without MPI, and each process that mpirun starts would "
                "render the same: build it with -DHYALITE_MPI=ON");
#endif
}

} // namespace hyalite::core
