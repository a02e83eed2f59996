// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace kerf {

/// A queue of fixed size from one thread to one other. Neither side ever waits for the other, allocates or locks.
template <class T>
class SpscRing {
    static_assert(std::is_trivially_copyable_v<T>, "a row is copied by bytes; keep strings out of it");

public:
    /// Pre: `capacity` is a power of two.   [main] allocates and touches every page, so that the loop faults none in.
    explicit SpscRing(std::size_t capacity) : slots_(capacity), mask_(capacity - 1) {}

    /// False when full: the row is not stored.   [producer, nonblocking]
    bool push(const T& row) noexcept {
        const std::size_t head = head_.load(std::memory_order_relaxed);
        if (head - tail_.load(std::memory_order_acquire) == slots_.size()) return false;
        slots_[head & mask_] = row;
        head_.store(head + 1, std::memory_order_release);
        return true;
    }

    /// The oldest row, or null. It stays valid until `pop`.   [consumer]
    const T* front() const noexcept {
        const std::size_t tail = tail_.load(std::memory_order_relaxed);
        return tail == head_.load(std::memory_order_acquire) ? nullptr : &slots_[tail & mask_];
    }
    /// Pre: `front()` gave a row.   [consumer]
    void pop() noexcept { tail_.store(tail_.load(std::memory_order_relaxed) + 1, std::memory_order_release); }

    /// Rows waiting; exact only on the two threads of the queue.   [producer or consumer]
    std::size_t size() const noexcept {
        const std::size_t tail = tail_.load(std::memory_order_acquire);
        return head_.load(std::memory_order_acquire) - tail;
    }
    std::size_t capacity() const noexcept { return slots_.size(); }

private:
    std::vector<T> slots_;
    std::size_t mask_;
    // Apart, so that the two threads do not fight for one cache line.
    alignas(64) std::atomic<std::size_t> head_{0};
    alignas(64) std::atomic<std::size_t> tail_{0};
};

}  // namespace kerf
