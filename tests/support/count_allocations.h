// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace kerf::test {

/// How often the calling thread has asked the heap for memory since it began.
std::size_t allocations_here() noexcept;

}  // namespace kerf::test
