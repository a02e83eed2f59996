// SPDX-License-Identifier: Apache-2.0
#include "tests/support/count_allocations.h"

#include <cstdlib>
#include <new>

// In a file of its own: a compiler that sees both sides of these in one place warns of a mismatch that is none.
static thread_local std::size_t allocation_count = 0;

std::size_t kerf::test::allocations_here() noexcept { return allocation_count; }

void* operator new(std::size_t size) {
    ++allocation_count;
    if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
    throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
