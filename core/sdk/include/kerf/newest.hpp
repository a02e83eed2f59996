// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace kerf {

/// Passes the newest value from one thread to another. Neither waits, and the reader never sees half a value. Values
/// that the reader was too slow for are lost.
template <class T>
class Newest {
    static_assert(std::is_trivially_copyable_v<T>);

public:
    explicit Newest(const T& first = {}) noexcept : slots_{first, first, first} {}

    /// Replaces the value.   [the writer's thread, nonblocking]
    void put(const T& value) noexcept {
        slots_[written_] = value;
        written_ = middle_.exchange(written_ | fresh, std::memory_order_acq_rel) & index;
    }
    /// Returns the newest value.   [the reader's thread, nonblocking]
    [[nodiscard]] const T& get() noexcept {
        if ((middle_.load(std::memory_order_relaxed) & fresh) != 0)
            read_ = middle_.exchange(read_, std::memory_order_acq_rel) & index;
        return slots_[read_];
    }

private:
    static constexpr std::uint32_t fresh = 4, index = 3;
    std::array<T, 3> slots_;
    std::uint32_t written_ = 0;             ///< slot that the writer fills next
    std::atomic<std::uint32_t> middle_{1};  ///< slot that changes hands, with `fresh` if it was not read yet
    std::uint32_t read_ = 2;                ///< slot of the reader
};

}  // namespace kerf
