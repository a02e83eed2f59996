// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>

#include "kerf/remesh.h"

namespace kerf::bone {

/// Memory that two processes map. The system allocates each page at its first write.   [main, worker]
class SharedMemory {
public:
    SharedMemory() = default;
    /// Makes a new block with a file descriptor and size 0; `fd()` is −1 if the system refuses it.
    static SharedMemory make(const char* name);
    /// Takes over a descriptor from another process.
    static SharedMemory of(int fd);
    SharedMemory(SharedMemory&& other) noexcept { *this = std::move(other); }
    SharedMemory& operator=(SharedMemory&& other) noexcept;
    ~SharedMemory();

    /// Grows the block to at least `bytes` and maps all of it. Returns false if the system refuses.
    bool grow(std::uint64_t bytes);
    /// Maps the first `bytes`, which the other process has allocated. Returns false if it has not.
    bool map(std::uint64_t bytes);
    [[nodiscard]] int fd() const noexcept { return fd_; }
    [[nodiscard]] kerf_arena arena() const noexcept { return {base_, size_, 0}; }

private:
    void unmap() noexcept;
    int fd_ = -1;
    unsigned char* base_ = nullptr;
    std::uint64_t size_ = 0;
};

}  // namespace kerf::bone
