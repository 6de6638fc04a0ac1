// Unset vectors: their elements begin without a value, for large arrays that several threads fill. std::vector would
// first set all of them to zero by one thread, which takes as long as to fill them, above all in fresh memory: its
// pages are cleared by the system when they are first written, by the thread that writes.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace hyalite::core {

template <class T> struct UnsetAllocator : std::allocator<T> {
    static_assert(std::is_trivially_copyable_v<T>, "nothing but bytes may be left unset");

    UnsetAllocator() = default;
    template <class Other> explicit(false) UnsetAllocator(const UnsetAllocator<Other> &) noexcept {}

    template <class Other> struct rebind { using other = UnsetAllocator<Other>; };

    void construct(T *) noexcept {}
    template <class... Arguments> void construct(T *at, Arguments &&...arguments) {
        std::construct_at(at, std::forward<Arguments>(arguments)...);
    }
};

/// `(n)`, `resize(n)` and `emplace_back()` leave new elements unset, whatever their members begin with: read them only
/// after they were written. `(n, value)` and `resize(n, value)` set them.
template <class T> using UnsetVector = std::vector<T, UnsetAllocator<T>>;

} // namespace hyalite::core
