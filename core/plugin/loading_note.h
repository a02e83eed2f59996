// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <csignal>
#include <string>

namespace kerf {

/// While this lives, a crash, an abort or an `exit` names the plugin that is being loaded on stderr, and the process
/// ends with 3. Loading runs a plugin's own code (static constructors), which nothing in this process can contain:
/// the user must at least learn whose code it was. What ends the process without a signal and without `exit`, such as
/// `_exit`, goes unnoticed.   [main] one at a time
class LoadingNote {
public:
    explicit LoadingNote(const std::string& path);
    ~LoadingNote();
    LoadingNote(const LoadingNote&) = delete;
    LoadingNote& operator=(const LoadingNote&) = delete;

private:
    static constexpr std::array signals{SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGILL};
    std::array<struct sigaction, signals.size()> before_{};
};

}  // namespace kerf
