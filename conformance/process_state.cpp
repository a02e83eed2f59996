// SPDX-License-Identifier: Apache-2.0
#include "conformance/process_state.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <clocale>
#include <csignal>
#include <filesystem>
#include <system_error>
#include <thread>

#if defined(__x86_64__)
#include <xmmintrin.h>
#endif

extern "C" char** environ;

namespace kerf::conformance {

namespace fs = std::filesystem;

std::uint32_t floating_point_control() noexcept {
#if defined(__x86_64__)
    std::uint16_t x87 = 0;
    __asm__ volatile("fnstcw %0" : "=m"(x87));
    return (_mm_getcsr() & ~0x3fu) | static_cast<std::uint32_t>(x87) << 16;
#else
    return 0;
#endif
}

std::vector<std::string> further(const std::vector<std::string>& before, const std::vector<std::string>& after) {
    std::vector<std::string> more;
    for (const std::string& one : after)
        if (std::find(before.begin(), before.end(), one) == before.end()) more.push_back(one);
    return more;
}

int count_threads() {
    const auto count = [] {
        std::error_code error;
        int threads = 0;
        for (fs::directory_iterator task("/proc/self/task", error), end; !error && task != end; task.increment(error))
            ++threads;
        return threads;
    };
    int threads = count();
    for (int i = 0; i < 20 && threads > 1; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        threads = count();
    }
    return threads;
}

ProcessState process_state() {
    ProcessState state;
    state.rounding = floating_point_control();
    for (int signal = 1; signal < 32; ++signal) {
        struct sigaction action {};
        sigaction(signal, nullptr, &action);
        state.handlers.push_back(reinterpret_cast<std::uintptr_t>(action.sa_handler));
    }
    std::error_code error;
    for (int file = 0; file < 256; ++file) {
        const fs::path target = fs::read_symlink("/proc/self/fd/" + std::to_string(file), error);
        if (!error) state.files.push_back(std::to_string(file) + " " + target.string());
        error.clear();
    }
    state.locale = std::setlocale(LC_ALL, nullptr);
    state.folder = fs::current_path(error).string();
    for (char** variable = environ; variable != nullptr && *variable != nullptr; ++variable)
        state.environment.emplace_back(*variable);
    std::sort(state.environment.begin(), state.environment.end());
    state.mask = umask(0);
    umask(state.mask);
    state.threads = count_threads();
    return state;
}

}  // namespace kerf::conformance
