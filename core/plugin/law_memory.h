// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/plugin/guarded_memory.h"
#include "kerf/abi.h"

namespace kerf {

/// The memory that the functions of a law may write. Each array ends at a page that may not be touched, so a law that
/// writes beyond one crashes in its call, and the crash names the array (misuse_of()). In front of each array lie bytes
/// that stay zero: see take_underrun().
class LawMemory {
public:
    /// Makes memory for laws with a state of up to `state_size` bytes. Throws std::bad_alloc.   [main]
    explicit LawMemory(std::size_t state_size);

    /// Fits the sizes of state and signals to a law, and sets its signals to zero. Pre: its `state_size`, rounded up to
    /// its `state_align`, is not above that of the constructor.   [main]
    void fit(const kerf_force& force) noexcept;
    [[nodiscard]] std::byte* state() const noexcept { return state_; }
    [[nodiscard]] const double* signals() const noexcept { return signals_; }

    /// Returns the outputs of `resist`, zero.   [haptic, nonblocking]
    [[nodiscard]] kerf_law& new_law() noexcept;
    /// Returns the outputs of `commit`, zero but for the signals, which keep their values.   [haptic, nonblocking]
    [[nodiscard]] kerf_commit_out& new_commit_out() noexcept;

    /// Returns the array in front of which a call wrote, of the 64 bytes there, and forgets it; null: none.
    /// [haptic, nonblocking]
    [[nodiscard]] const char* take_underrun() noexcept;

private:
    GuardedMemory memory_;
    std::byte *state_end_, *state_;
    double *signals_end_, *signals_;
    kerf_law* law_;
    kerf_channel* channel_;
    kerf_commit_out* out_;
    kerf_action* action_;
    kerf_thread* thread_;
};

}  // namespace kerf
