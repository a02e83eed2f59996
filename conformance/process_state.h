// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace kerf::conformance {

/// What a library shares with its process and must leave as it is.
struct ProcessState {
    std::uint32_t rounding = 0;            ///< of the processor: rounding, flush to zero, which faults trap
    std::vector<std::uintptr_t> handlers;  ///< of each signal
    std::vector<std::string> files;        ///< open descriptors, each with what it is
    std::string locale, folder;
    std::vector<std::string> environment;
    unsigned mask = 0;  ///< of files that are made
    int threads = 0;
};
[[nodiscard]] ProcessState process_state();  // [main]

/// Returns those of `after` that are not among `before`.   [any] pure
[[nodiscard]] std::vector<std::string> further(const std::vector<std::string>& before,
                                               const std::vector<std::string>& after);

/// The control bits of the floating-point unit, without the flags that every calculation sets.   [any]
[[nodiscard]] std::uint32_t floating_point_control() noexcept;

/// The number of threads of this process, counted again for up to 0.2 s while one may be ending.   [main]
[[nodiscard]] int count_threads();

}  // namespace kerf::conformance
