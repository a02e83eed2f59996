// SPDX-License-Identifier: Apache-2.0
#include "app/progress.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <utility>

namespace kerf {

namespace {

constexpr const char* clear_line = "\r\033[K";

bool is_on_terminal() { return isatty(STDERR_FILENO) != 0; }

}  // namespace

void show_progress(double share, const std::string& what) {
    if (!is_on_terminal()) return;
    std::fprintf(stderr, "%s%3.0f %%  %s", clear_line, 100.0 * share, what.c_str());
    if (share >= 1.0) std::fputc('\n', stderr);
}

void show_work(const std::string& what) {
    if (is_on_terminal()) std::fprintf(stderr, "%s%s%s", clear_line, what.c_str(), what.empty() ? "" : " …");
}

StillWorking::StillWorking(std::string what) : what_(std::move(what)) {
    if (!is_on_terminal()) return;
    std::fprintf(stderr, "%s%s …", clear_line, what_.c_str());
    clock_ = std::thread([this] {
        std::unique_lock lock(mutex_);
        for (int seconds = 1; !wake_.wait_for(lock, std::chrono::seconds(1), [this] { return is_over_; }); ++seconds)
            std::fprintf(stderr, "%s%s … %d s", clear_line, what_.c_str(), seconds);
    });
}

StillWorking::~StillWorking() {
    if (!clock_.joinable()) return;
    {
        const std::lock_guard lock(mutex_);
        is_over_ = true;
    }
    wake_.notify_one();
    clock_.join();
    std::fputs(clear_line, stderr);
}

}  // namespace kerf
