// SPDX-License-Identifier: Apache-2.0
#include "core/field/grid/brick_memory.h"

#include <cstdint>
#include <new>

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace kerf {

namespace {
constexpr std::size_t huge_page = std::size_t{2} << 20;
}

#ifdef __linux__

// Small blocks come from the ordinary heap: a mapping would be mostly empty.
void* map_brick_memory(std::size_t bytes) {
    if (bytes < huge_page) return ::operator new(bytes);
    // Map one huge page more, so that the samples can begin on a page border, and unmap the rest.
    constexpr std::size_t page = 4096;
    const std::size_t used = (bytes + page - 1) / page * page;
    void* mapped =
        mmap(nullptr, used + huge_page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (mapped == MAP_FAILED) throw std::bad_alloc();
    const std::size_t before = (huge_page - reinterpret_cast<std::uintptr_t>(mapped) % huge_page) % huge_page;
    std::byte* aligned = static_cast<std::byte*>(mapped) + before;
    if (before > 0) munmap(mapped, before);
    if (before < huge_page) munmap(aligned + used, huge_page - before);
    madvise(aligned, used, MADV_HUGEPAGE);  // a hint: without huge pages the pages are small
    return aligned;
}

void unmap_brick_memory(void* memory, std::size_t bytes) noexcept {
    if (bytes < huge_page)
        ::operator delete(memory);
    else
        munmap(memory, bytes);
}

void prefer_huge_pages(void* memory, std::size_t bytes) noexcept {
    if (bytes < huge_page) return;
    constexpr std::uintptr_t page = 4096;
    const std::uintptr_t first = reinterpret_cast<std::uintptr_t>(memory) / page * page;
    madvise(reinterpret_cast<void*>(first), reinterpret_cast<std::uintptr_t>(memory) + bytes - first, MADV_HUGEPAGE);
}

#else

void prefer_huge_pages(void*, std::size_t) noexcept {}
void* map_brick_memory(std::size_t bytes) { return ::operator new(bytes); }
void unmap_brick_memory(void* memory, std::size_t) noexcept { ::operator delete(memory); }

#endif

}  // namespace kerf
