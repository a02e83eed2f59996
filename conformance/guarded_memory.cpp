// SPDX-License-Identifier: Apache-2.0
#include "conformance/guarded_memory.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <new>

#include "conformance/sandbox.h"

namespace kerf::conformance {

namespace {
std::size_t page_size() noexcept { return static_cast<std::size_t>(sysconf(_SC_PAGESIZE)); }
}  // namespace

GuardedMemory::~GuardedMemory() {
    for (const Pages& pages : all_) munmap(pages.begin, pages.size);
}

void* GuardedMemory::allocate(std::size_t size, std::size_t alignment, const char* beyond) {
    const std::size_t page = page_size(), pages = std::max<std::size_t>(1, (size + page - 1) / page);
    void* const begin = mmap(nullptr, (pages + 1) * page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (begin == MAP_FAILED) throw std::bad_alloc();
    auto* const guard = static_cast<char*>(begin) + pages * page;
    mprotect(guard, page, PROT_NONE);
    name_memory(guard, page, beyond);
    all_.push_back({begin, (pages + 1) * page});
    const std::size_t whole = (size + alignment - 1) / alignment * alignment;
    return guard - whole;
}

void GuardedMemory::make_read_only(const char* written) {
    const Pages& last = all_.back();
    mprotect(last.begin, last.size - page_size(), PROT_READ);
    name_memory(last.begin, last.size - page_size(), written);
}

void GuardedMemory::forbid(const char* touched) {
    for (const Pages& pages : all_) {
        mprotect(pages.begin, pages.size, PROT_NONE);
        name_memory(pages.begin, pages.size, touched);
    }
}

}  // namespace kerf::conformance
