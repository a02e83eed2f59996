// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/resource.h>
#include <sys/time.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/plugin/fixed_text.h"

/// Reads what plugins have in common with their process and must leave as it is.
namespace kerf {

/// Identifies an open file, whatever its name. Two zeros: the descriptor is closed.
struct OpenFile {
    std::uint64_t device = 0, number = 0;
    friend bool operator==(const OpenFile&, const OpenFile&) = default;
};
[[nodiscard]] OpenFile open_file(int descriptor) noexcept;  // [any] async-signal-safe

/// The part that a host can compare while it runs, without memory of the heap.
struct SharedState {
    std::array<rlimit, RLIMIT_NLIMITS> limits{};
    std::array<itimerval, 3> timers{};
    std::array<std::uintptr_t, 32> handlers{};  ///< by signal
    std::array<OpenFile, 3> streams{};          ///< stdin, stdout, stderr
    std::array<char, 4096> folder{};            ///< empty: it cannot be read
    std::array<char, 8> decimal_point{};        ///< of the locale
    int mask = -1;                              ///< of files that are made; -1: it cannot be read
};
[[nodiscard]] SharedState shared_state() noexcept;  // [any] some 30 system calls

/// A difference of two states, for people.
struct StateChange {
    FixedText<80> what;            ///< "the working folder"; empty: there is none
    FixedText<600> before, after;  ///< "unlimited", "1048576"
    [[nodiscard]] bool has_happened() const noexcept { return !what.empty(); }
    /// Returns "the limit RLIMIT_AS from unlimited to 1048576".   [any]
    [[nodiscard]] std::string text() const;
};

/// Returns the first difference that harms a host: a stream that was closed or replaced, a lower limit, a timer,
/// another working folder, decimal point or mask, another handler of a signal that Kerf relies on.   [any] pure
[[nodiscard]] StateChange change_between(const SharedState& before, const SharedState& after) noexcept;

/// The whole state.
struct ProcessState {
    SharedState shared;
    std::uint32_t rounding = 0;      ///< of the processor: rounding, flush to zero, which faults trap
    std::vector<std::string> files;  ///< open descriptors, each with what it is
    std::string locale;
    std::vector<std::string> environment;
    int threads = 0;
};
[[nodiscard]] ProcessState process_state();  // [main]

/// Returns those of `after` that are not among `before`.   [any] pure
[[nodiscard]] std::vector<std::string> further(const std::vector<std::string>& before,
                                               const std::vector<std::string>& after);

/// The number of threads of this process, counted again for up to 0.2 s while one may be ending.   [main]
[[nodiscard]] int count_threads();

}  // namespace kerf
