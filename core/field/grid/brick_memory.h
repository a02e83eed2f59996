// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

/// Memory for the samples of bricks.
namespace kerf {

/// Allocates `bytes`. A block of 2 MiB or more uses physical memory only where it has been touched, and huge pages if
/// the system has them. Throws std::bad_alloc.   [main, worker]
[[nodiscard]] void* map_brick_memory(std::size_t bytes);
void unmap_brick_memory(void* memory, std::size_t bytes) noexcept;
/// Requests huge pages for a block of 2 MiB or more from another allocator, much of which will soon be used for the
/// first time.   [main, worker]
void prefer_huge_pages(void* memory, std::size_t bytes) noexcept;

/// Number of bytes after the last sample that a kernel may read: it loads more than it needs.
inline constexpr std::size_t brick_slack = 32;

/// Allocator for std::vector. Reserved memory costs nothing before it is used. So a vector can reserve its largest size
/// and never move.
template <class Sample>
struct BrickAllocator {
    using value_type = Sample;
    BrickAllocator() = default;
    template <class Other>
    explicit BrickAllocator(const BrickAllocator<Other>&) noexcept {}

    [[nodiscard]] Sample* allocate(std::size_t n) {
        return static_cast<Sample*>(map_brick_memory(n * sizeof(Sample) + brick_slack));
    }
    void deallocate(Sample* p, std::size_t n) noexcept { unmap_brick_memory(p, n * sizeof(Sample) + brick_slack); }
    friend bool operator==(const BrickAllocator&, const BrickAllocator&) noexcept { return true; }
};

template <class Sample>
using BrickSamples = std::vector<Sample, BrickAllocator<Sample>>;

}  // namespace kerf
