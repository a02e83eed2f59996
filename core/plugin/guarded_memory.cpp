// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/guarded_memory.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <new>

namespace kerf {

namespace {

std::size_t page_size() noexcept { return static_cast<std::size_t>(sysconf(_SC_PAGESIZE)); }

/// A range of addresses and what is wrong about touching it. Signal handlers read it at any time; null: unused.
struct NamedRange {
    std::atomic<std::uintptr_t> begin{0};
    std::atomic<std::size_t> size{0};
    std::atomic<const char*> misuse{nullptr};
};
std::array<NamedRange, 4096> ranges;
std::mutex naming;

void name_range(const void* begin, std::size_t size, const char* misuse) noexcept {
    const auto at = reinterpret_cast<std::uintptr_t>(begin);
    const std::lock_guard lock(naming);
    const auto is_of = [at](const NamedRange& range) {
        return range.misuse.load() != nullptr && range.begin.load() == at;
    };
    auto range = std::find_if(ranges.begin(), ranges.end(), is_of);
    if (range == ranges.end())
        range = std::find_if(ranges.begin(), ranges.end(), [](const auto& r) { return r.misuse.load() == nullptr; });
    if (range == ranges.end()) return;
    range->begin.store(at);
    range->size.store(size);
    range->misuse.store(misuse);
}

/// Forgets the names of all ranges within this one.
void forget_names(const void* begin, std::size_t size) noexcept {
    const auto at = reinterpret_cast<std::uintptr_t>(begin);
    const std::lock_guard lock(naming);
    for (NamedRange& range : ranges)
        if (range.begin.load() >= at && range.begin.load() < at + size) range.misuse.store(nullptr);
}

}  // namespace

GuardedMemory::~GuardedMemory() {
    for (const Pages& pages : all_) {
        forget_names(pages.begin, pages.size);
        munmap(pages.begin, pages.size);
    }
}

void* GuardedMemory::allocate(std::size_t size, std::size_t alignment, const char* beyond) {
    const std::size_t page = page_size(), pages = std::max<std::size_t>(1, (size + page - 1) / page);
    void* const begin = mmap(nullptr, (pages + 1) * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (begin == MAP_FAILED) throw std::bad_alloc();
    auto* const guard = static_cast<char*>(begin) + pages * page;
    mprotect(guard, page, PROT_NONE);
    name_range(guard, page, beyond);
    all_.push_back({begin, (pages + 1) * page});
    const std::size_t whole = (size + alignment - 1) / alignment * alignment;
    return guard - whole;
}

void GuardedMemory::make_read_only(const char* written) {
    const Pages& last = all_.back();
    mprotect(last.begin, last.size - page_size(), PROT_READ);
    name_range(last.begin, last.size - page_size(), written);
}

void GuardedMemory::forbid(const char* touched) {
    for (const Pages& pages : all_) {
        mprotect(pages.begin, pages.size, PROT_NONE);
        forget_names(pages.begin, pages.size);
        name_range(pages.begin, pages.size, touched);
    }
}

const char* misuse_of(const void* address) noexcept {
    const auto at = reinterpret_cast<std::uintptr_t>(address);
    for (const NamedRange& range : ranges)
        if (const char* misuse = range.misuse.load();
            misuse != nullptr && at >= range.begin.load() && at < range.begin.load() + range.size.load())
            return misuse;
    return nullptr;
}

}  // namespace kerf
