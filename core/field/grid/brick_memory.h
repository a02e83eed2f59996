// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

/// Memory for the samples of bricks.
namespace kerf {

/// Address room of at least `bytes`; if it is large, on the machine only where it has been touched, and in huge pages
/// where the system has them. Throws std::bad_alloc.   [main, worker]
[[nodiscard]] void* map_brick_memory(std::size_t bytes);
void unmap_brick_memory(void* memory, std::size_t bytes) noexcept;
/// Asks for huge pages in memory from elsewhere, of which much will soon be touched for the first time.   [main,
/// worker]
void prefer_huge_pages(void* memory, std::size_t bytes) noexcept;

/// Behind the last sample there is so much more that may be read [bytes]: a kernel loads more than it needs.
inline constexpr std::size_t brick_slack = 32;

/// For std::vector: what it reserves costs nothing before it is used, so a vector that reserves all it can ever need
/// grows without moving.
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
