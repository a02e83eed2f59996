// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <csignal>
#include <string>

namespace kerf {

/// While this object exists, a crash, an abort or an `exit` prints to stderr the path of the plugin that is being
/// loaded. The process then ends with the exit code 3. Loading runs a plugin's own code (static constructors), from
/// which this process cannot protect itself. So the user must at least see which plugin it was. Any other end, such as
/// `_exit`, prints nothing.   [main] one object at a time
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
