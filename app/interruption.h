// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <csignal>

namespace kerf::app {

/// While this lives, the first Ctrl-C (SIGINT, SIGTERM, SIGHUP) only sets a flag, so that a run can end in order. A
/// second one ends the program. A signal that was ignored before, as by `nohup`, stays ignored.   [main] one at a time
class Interruption {
public:
    Interruption();
    ~Interruption();
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;

    [[nodiscard]] bool has_come() const noexcept;  // [any]
    /// Sets the flag, as a Ctrl-C does.   [any]
    void come() const noexcept;

private:
    static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP};
    std::array<struct sigaction, signals.size()> before_{};
    std::array<bool, signals.size()> is_taken_{};
};

}  // namespace kerf::app
