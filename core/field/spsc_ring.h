// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <type_traits>
#include <vector>

namespace kerf {

/// A queue of fixed capacity from one thread to one other. Neither side waits for the other, allocates or locks.
template <class T>
class SpscRing {
    static_assert(std::is_trivially_copyable_v<T>, "a row is copied by bytes; keep strings out of it");

public:
    /// Allocates and touches every page, so that the loop causes no page fault. Pre: `capacity` is a power of two.
    /// [main]
    explicit SpscRing(std::size_t capacity) : slots_(capacity), mask_(capacity - 1) {}

    /// Appends a row. Returns false if the queue is full; the row is then not stored.   [producer, nonblocking]
    bool push(const T& row) noexcept {
        const std::size_t head = head_.load(std::memory_order_relaxed);
        if (head - tail_.load(std::memory_order_acquire) == slots_.size()) return false;
        slots_[head & mask_] = row;
        head_.store(head + 1, std::memory_order_release);
        return true;
    }

    /// Returns the oldest row, or null. It stays valid until `pop`.   [consumer]
    const T* front() const noexcept {
        const std::size_t tail = tail_.load(std::memory_order_relaxed);
        return tail == head_.load(std::memory_order_acquire) ? nullptr : &slots_[tail & mask_];
    }
    /// Removes the oldest row. Pre: `front()` returned a row.   [consumer]
    void pop() noexcept { tail_.store(tail_.load(std::memory_order_relaxed) + 1, std::memory_order_release); }

    /// Returns the number of waiting rows: on the producer's thread an upper bound, on the consumer's a lower bound.
    /// [producer or consumer]
    std::size_t size() const noexcept {
        const std::size_t tail = tail_.load(std::memory_order_acquire);
        return head_.load(std::memory_order_acquire) - tail;
    }
    std::size_t capacity() const noexcept { return slots_.size(); }

private:
    std::vector<T> slots_;
    std::size_t mask_;
    // On separate cache lines, so that the two threads do not contend for one.
    alignas(64) std::atomic<std::size_t> head_{0};
    alignas(64) std::atomic<std::size_t> tail_{0};
};

}  // namespace kerf
