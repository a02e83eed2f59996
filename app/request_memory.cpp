// SPDX-License-Identifier: Apache-2.0
#include "app/request_memory.h"

#include <sys/mman.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>

namespace kerf::app {
namespace {

constexpr std::size_t unit = 16, page = 4096;
constexpr std::size_t max_regions = 16;  // one, and those with blocks that were never freed
constexpr std::uintptr_t first_address = 0x100000000000;

/// Blocks up to a page are reused, the last freed one first. Larger ones return their pages and are not reused.
struct Region {
    char *begin = nullptr, *next = nullptr, *end = nullptr;
    std::size_t blocks = 0;  ///< not freed
    std::array<void*, page / unit + 1> free{};

    void* take(std::size_t size) noexcept {
        if (size <= page)
            if (void*& first = free[size / unit]; first != nullptr) {
                void* const block = first;
                first = *static_cast<void**>(block);
                ++blocks;
                return block;
            }
        if (static_cast<std::size_t>(end - next) < size) return nullptr;
        char* const block = next;
        next += size;
        ++blocks;
        return block;
    }
    void give_back(void* block, std::size_t size) noexcept {
        --blocks;
        if (size <= page) {
            *static_cast<void**>(block) = free[size / unit];
            free[size / unit] = block;
            return;
        }
        const auto at = reinterpret_cast<std::uintptr_t>(block);
        const std::uintptr_t from = (at + page - 1) / page * page, to = (at + size) / page * page;
        if (from < to) madvise(reinterpret_cast<void*>(from), to - from, MADV_DONTNEED);
    }
    void clear() noexcept {
        madvise(begin, static_cast<std::size_t>(next - begin), MADV_DONTNEED);
        next = begin;
        free.fill(nullptr);
    }
    void trim() noexcept {
        const auto at = reinterpret_cast<std::uintptr_t>(next);
        char* const unused = begin + ((at + page - 1) / page * page - reinterpret_cast<std::uintptr_t>(begin));
        if (unused < end) munmap(unused, static_cast<std::size_t>(end - unused));
        end = std::min(end, unused);
    }
};

Region regions[max_regions];
thread_local Region* current = nullptr;  // null: between requests, on other threads, and without a free region
std::atomic_flag is_in_use = ATOMIC_FLAG_INIT;

/// Other threads of a library may free memory of this one.
struct Lock {
    Lock() noexcept {
        while (is_in_use.test_and_set(std::memory_order_acquire)) {
        }
    }
    ~Lock() { is_in_use.clear(std::memory_order_release); }
    Lock(const Lock&) = delete;
    Lock& operator=(const Lock&) = delete;
};

/// Reserves up to 64 GB; less if the address space is limited.
bool reserve(Region& region, std::uintptr_t address) noexcept {
    for (std::size_t size = std::size_t{1} << 36; size >= std::size_t{1} << 26; size /= 4) {
        void* const at = mmap(reinterpret_cast<void*>(address), size, PROT_READ | PROT_WRITE,
                              MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_FIXED_NOREPLACE, -1, 0);
        if (at == MAP_FAILED) continue;
        if (at != reinterpret_cast<void*>(address)) {  // an old kernel takes the address as a hint
            munmap(at, size);
            return false;
        }
        region.begin = region.next = static_cast<char*>(at);
        region.end = region.begin + size;
        return true;
    }
    return false;
}

struct Head {  // before each block
    std::size_t size;
    Region* region;  ///< null: from the heap
};
static_assert(sizeof(Head) == unit);

void* allocate(std::size_t bytes) {
    if (bytes > SIZE_MAX - 2 * unit) throw std::bad_alloc();
    const std::size_t size = (bytes + sizeof(Head) + unit - 1) / unit * unit;
    Region* region = current;
    void* block = nullptr;
    if (region != nullptr) {
        const Lock lock;
        block = region->take(size);
    }
    if (block == nullptr) {
        region = nullptr;
        block = std::malloc(size);
        if (block == nullptr) throw std::bad_alloc();
    }
    Head* const head = static_cast<Head*>(block);
    *head = {size, region};
    return head + 1;
}

void release(void* bytes) noexcept {
    if (bytes == nullptr) return;
    Head* const head = static_cast<Head*>(bytes) - 1;
    if (head->region == nullptr) return std::free(head);
    const Lock lock;
    head->region->give_back(head, head->size);
}

}  // namespace

void begin_request_memory() noexcept {
    for (std::size_t n = 0; n < max_regions && current == nullptr; ++n) {
        Region& region = regions[n];
        if (region.begin == nullptr && !reserve(region, first_address + (n << 37))) return;
        if (region.blocks > 0) {  // a library keeps a block: the rest of the region is returned
            region.trim();
            continue;
        }
        region.clear();
        current = &region;
    }
}

void end_request_memory() noexcept { current = nullptr; }

}  // namespace kerf::app

void* operator new(std::size_t bytes) { return kerf::app::allocate(bytes); }
void* operator new[](std::size_t bytes) { return kerf::app::allocate(bytes); }
void operator delete(void* bytes) noexcept { kerf::app::release(bytes); }
void operator delete[](void* bytes) noexcept { kerf::app::release(bytes); }
void operator delete(void* bytes, std::size_t) noexcept { kerf::app::release(bytes); }
void operator delete[](void* bytes, std::size_t) noexcept { kerf::app::release(bytes); }
