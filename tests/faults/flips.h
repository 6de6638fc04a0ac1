// Bits of a device's memory that flip while it works, as those of faulty hardware do; and the truth about the films
// that come of it, which the layer finds by itself.
#pragma once

#include <vulkan/vulkan.h>

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <map>
#include <mutex>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace hyalite::faults {

/// Told by
///
///   HYALITE_FLIPS         "5:1": before every fifth submission a bit flips; 1 is the seed
///   HYALITE_FLIP_BUFFERS  names of buffers in which bits flip, separated by commas
///   HYALITE_FLIP_LOG      a file that gets a line for each flip, and one for each film that is compared:
///
///       flip BUFFER WORD BIT
///       film equal|PIXEL      the first pixel that is not as it should be
///
/// Only buffers that the host has mapped, as software devices allow for all of them, have flips.
class Flips {
  public:
    Flips();

    [[nodiscard]] bool isWanted() const { return period_ > 0; }
    void noteBuffer(VkBuffer buffer, std::size_t sizeBytes);
    void noteBound(VkBuffer buffer, VkDeviceMemory memory);
    void noteMapped(VkDeviceMemory memory, void *address);
    void noteGone(VkBuffer buffer);
    void noteName(VkObjectType type, std::uint64_t handle, const std::string &name);
    void notePipeline(VkPipeline pipeline);
    /// Flips a bit, if it is time, and then looks at the film, if it is going to be compared.
    void beforeSubmission();

  private:
    struct Buffer {
        std::string name;
        std::size_t sizeBytes = 0;
        VkDeviceMemory memory = VK_NULL_HANDLE;
    };
    [[nodiscard]] std::uint32_t *wordsOf(const Buffer &buffer) const;
    [[nodiscard]] const std::uint32_t *wordsNamed(std::string_view name) const;
    [[nodiscard]] std::size_t sizeOf(std::string_view name) const; ///< in words
    void flip();
    void lookAtFilm();

    std::mutex mutex_;
    long period_ = 0;
    std::set<std::string, std::less<>> names_;
    std::ofstream log_;
    std::mt19937_64 random_;
    long submissions_ = 0;
    std::map<VkBuffer, Buffer> buffers_;
    std::map<VkDeviceMemory, void *> mapped_;
    std::set<std::uint64_t> comparisons_; ///< pipelines
    bool isComparison_ = false;           ///< the next submission
    bool hasCompared_ = false;            ///< a former one
    std::vector<std::uint32_t> film_;     ///< as it should be
};

[[nodiscard]] Flips &flips();

} // namespace hyalite::faults
