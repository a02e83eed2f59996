// SPDX-License-Identifier: Apache-2.0
#include "app/parent_watch.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <string_view>

#include "core/plugin/fixed_text.h"

namespace kerf::app {

namespace {

std::atomic<pid_t> noted{0};

/// Returns the letter of a process's state in /proc, or 0 if it cannot be read.
char state_letter(pid_t process) noexcept {
    FixedText<40> file;
    file << "/proc/" << static_cast<unsigned long long>(process) << "/stat";
    const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) return 0;
    char text[128];
    const ssize_t size = read(descriptor, text, sizeof text);
    close(descriptor);
    const std::string_view line(text, size > 0 ? static_cast<std::size_t>(size) : 0);
    const std::size_t end_of_name = line.rfind(") ");  // a name has at most 15 bytes
    return end_of_name != std::string_view::npos && end_of_name + 2 < line.size() ? line[end_of_name + 2] : '\0';
}

}  // namespace

void note_parent(pid_t parent) noexcept { noted.store(parent); }

ParentState parent_state() noexcept {
    const pid_t parent = noted.load();
    if (parent == 0) return ParentState::unknown;
    if (getppid() != parent) return ParentState::ended;
    return state_letter(parent) == 'T' ? ParentState::stopped : ParentState::running;
}

void continue_parent() noexcept { kill(noted.load(), SIGCONT); }

}  // namespace kerf::app
