// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>

/// What must not happen between pose read and force out, counted or forbidden.
namespace kerf::test {

/// Of the calling thread since it began. Not counted under a sanitizer, which brings a heap of its own.
struct Forbidden {
    std::size_t allocations = 0;  ///< malloc and its kin, operator new among them; free
    std::size_t locks = 0;        ///< pthread mutexes, read-write locks and condition variables, contended or not
    std::size_t throws = 0;

    bool operator==(const Forbidden&) const = default;
};
[[nodiscard]] Forbidden forbidden_here() noexcept;

/// Only allocations.
[[nodiscard]] inline std::size_t allocations_here() noexcept { return forbidden_here().allocations; }

enum class SystemCalls { none, some, cannot_tell };
/// Runs `work` in a forked child that the kernel kills at its first system call.
[[nodiscard]] SystemCalls system_calls_of(const std::function<void()>& work);

}  // namespace kerf::test
