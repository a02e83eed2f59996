// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>

#include "kerf/remesh.h"

namespace kerf {

/// Memory that two processes map. It is taken from the machine page by page as it is written.   [main, worker]
class SharedMemory {
public:
    SharedMemory() = default;
    /// Makes a new one that has a file descriptor and no size; `fd()` is −1 where the system refuses it.
    static SharedMemory make(const char* name);
    /// Takes over a descriptor that another process made.
    static SharedMemory of(int fd);
    SharedMemory(SharedMemory&& other) noexcept { *this = std::move(other); }
    SharedMemory& operator=(SharedMemory&& other) noexcept;
    ~SharedMemory();

    /// Makes it at least so large and maps all of it. Returns false where the system refuses that.
    bool grow(std::uint64_t bytes);
    /// Maps the first `bytes`, which the other process has made. Returns false where it has not.
    bool map(std::uint64_t bytes);
    [[nodiscard]] int fd() const noexcept { return fd_; }
    [[nodiscard]] kerf_arena arena() const noexcept { return {base_, size_, 0}; }

private:
    void unmap() noexcept;
    int fd_ = -1;
    unsigned char* base_ = nullptr;
    std::uint64_t size_ = 0;
};

}  // namespace kerf
