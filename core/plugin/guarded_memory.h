// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

namespace kerf {

/// Memory that ends where a page ends: what reads or writes beyond it crashes, and the crash is named.   [main]
class GuardedMemory {
public:
    GuardedMemory() = default;
    ~GuardedMemory();
    GuardedMemory(const GuardedMemory&) = delete;
    GuardedMemory& operator=(const GuardedMemory&) = delete;

    /// Returns `size` bytes of zeros aligned to `alignment`, a power of two; up to `alignment` − 1 bytes behind them
    /// may be touched unnoticed. `beyond` describes the mistake of code that touches the page behind; it must outlive
    /// the process. Throws std::bad_alloc.
    void* allocate(std::size_t size, std::size_t alignment, const char* beyond);
    /// The same, with a copy of `values`.
    template <class T>
    T* copy(const T* values, std::size_t count, const char* beyond) {
        auto* const to = static_cast<T*>(allocate(count * sizeof(T), alignof(T), beyond));
        for (std::size_t i = 0; i < count; ++i) to[i] = values[i];
        return to;
    }
    /// Forbids writing to what was allocated last. `written` describes the mistake of code that writes.
    void make_read_only(const char* written);
    /// Forbids touching any of it. `touched` describes the mistake of code that does so.
    void forbid(const char* touched);

private:
    struct Pages {
        void* begin;
        std::size_t size;  ///< with the page behind
    };
    std::vector<Pages> all_;
};

/// Returns the mistake of code that touches this address, or null if no guarded memory has it. Of 4096 ranges; further
/// ones have no name.   [any] async-signal-safe
[[nodiscard]] const char* misuse_of(const void* address) noexcept;

}  // namespace kerf
