// Ranks: the processes of one program that mpirun started together.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace hyalite::core {

/// Messages between ranks. Those from one rank to another arrive in their order. May be used by several threads.
class Ranks {
  public:
    virtual ~Ranks() = default;

    [[nodiscard]] virtual int rank() const = 0; ///< of this process, from 0
    [[nodiscard]] virtual int count() const = 0;
    virtual void send(int to, std::span<const std::byte> message) = 0;
    /// The next message from that rank, if it has come.
    [[nodiscard]] virtual std::optional<std::vector<std::byte>> poll(int from) = 0;
};

/// The ranks of this program, or null if it was started alone. Leaves them when it is destroyed. Throws Error{Usage}
/// where it was started by mpirun, and was built without MPI.
[[nodiscard]] std::unique_ptr<Ranks> joinRanks();

} // namespace hyalite::core
