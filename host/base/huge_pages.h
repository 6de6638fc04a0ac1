// Huge pages: memory in pages of 2 MiB instead of 4 KiB. The kernel clears each page when it is first written, and on
// a virtual machine entering the kernel for it takes longer than what is then done with the page. Where huge pages are
// given on request, as in most containers, large arrays request them here: what `operator new` allocates does so by
// itself from 1 MiB on in our programs (host/process/operator_new.cpp), and what drivers allocate by this function.
#pragma once

#include <cstddef>

namespace hyalite::core {

inline constexpr std::size_t hugePageBytes = std::size_t{2} << 20;

/// Requests huge pages for those that lie wholly in the range. Before its first use: pages that are there stay. A
/// system without huge pages does nothing.
void preferHugePages(void *begin, std::size_t sizeBytes) noexcept;

} // namespace hyalite::core
