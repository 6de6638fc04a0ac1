// Checkpoint lock: one render at a time writes a checkpoint.
#pragma once

#include <filesystem>

namespace hyalite::core {

/// Held from the beginning of a render to its end. The lock is one of the system (flock) on the file FILE.lock: it ends
/// with the process, however that ends, and a lock file that is left over blocks nobody. What it says tells it from
/// files that others made, which are neither written nor removed.
class CheckpointLock {
  public:
    /// Throws Error{OutputNotWritten} if another render holds the lock, with its process, or if FILE.lock is not ours
    /// or cannot be created. Where the file system has no locks, nothing is locked.
    explicit CheckpointLock(const std::filesystem::path &checkpoint);
    CheckpointLock(const CheckpointLock &) = delete;
    CheckpointLock &operator=(const CheckpointLock &) = delete;
    /// Removes the lock file.
    ~CheckpointLock();

  private:
    std::filesystem::path path_;
    int descriptor_ = -1;
};

/// The lock file of a checkpoint: FILE.lock.
[[nodiscard]] std::filesystem::path lockOfCheckpoint(const std::filesystem::path &checkpoint);

} // namespace hyalite::core
