// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace kerf::test {

/// How a piece of work ended that was done in a process of its own.
struct Guarded {
    std::string fault;   ///< "signal 11", "threw: …", "took longer than 20 s"; empty: it came to its end
    std::string result;  ///< what the work gave
    double ms = 0.0;     ///< [ms] of the wall clock
    double mb = 0.0;     ///< [MB] at most beyond what was there before, in the process or in one that it started
};

/// Does the work in a child of this process, so that nothing of it can end this one, and measures what it took. Its
/// threads and memory are gone afterwards.   Pre: this process has one thread.
[[nodiscard]] Guarded guarded(const std::function<std::string()>& work);

}  // namespace kerf::test
