// SPDX-License-Identifier: Apache-2.0
#include "app/progress.h"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <system_error>

#include "core/plugin/own_streams.h"
#include "text/printable.h"

namespace kerf::app {

namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* clear_line = "\r\033[K";
constexpr int seconds_per_line = 30;  // in a log

bool is_on_terminal() { return isatty(own_error_file()) != 0; }

/// Whether a log gets the next line.
bool is_line_due() {
    static Clock::time_point last = Clock::now();
    const auto now = Clock::now();
    if (now - last < std::chrono::seconds(seconds_per_line)) return false;
    last = now;
    return true;
}

std::string percent(double fraction) { return std::to_string(static_cast<int>(100.0 * fraction)) + " %"; }

}  // namespace

void show_progress(double fraction, const std::string& what) {
    if (is_on_terminal()) {
        std::fprintf(own_errors(), "%s%3d %%  %s", clear_line, static_cast<int>(100.0 * fraction),
                     text::printable(what).c_str());
        if (fraction >= 1.0) std::fputc('\n', own_errors());
    } else if (is_line_due()) {
        std::fprintf(own_errors(), "%s  %s\n", percent(fraction).c_str(), text::printable(what).c_str());
    }
}

void show_work(const std::string& what) {
    if (is_on_terminal())
        std::fprintf(own_errors(), "%s%s%s", clear_line, text::printable(what).c_str(), what.empty() ? "" : " …");
    else if (!what.empty() && is_line_due())
        std::fprintf(own_errors(), "%s …\n", text::printable(what).c_str());
}

StillWorking::StillWorking(const std::string& what) : what_(text::printable(what)) {
    const bool is_written_over = is_on_terminal();
    if (is_written_over) std::fprintf(own_errors(), "%s%s …", clear_line, what_.c_str());
    try {
        clock_ = std::thread([this, is_written_over] { show_until_over(is_written_over); });
    } catch (const std::system_error&) {
        // The system gives no thread: the work continues without a clock.
    }
}

void StillWorking::show_until_over(bool is_written_over) noexcept {
    try {
        std::unique_lock lock(mutex_);
        const int step = is_written_over ? 1 : seconds_per_line;
        for (int seconds = step; !wake_.wait_for(lock, std::chrono::seconds(step), [this] { return is_over_; });
             seconds += step)
            std::fprintf(own_errors(), is_written_over ? "\r\033[K%s" : "%s\n", text(seconds).c_str());
    } catch (const std::exception&) {
        // There is no memory for a line; the work itself reports that.
    }
}

void StillWorking::is_at(double fraction, const std::string& part) {
    const std::lock_guard lock(mutex_);
    fraction_ = fraction;
    part_ = text::printable(part);
}

std::string StillWorking::text(int seconds) const {
    return what_ + (part_.empty() ? "" : ": " + part_ + ", " + percent(fraction_)) + " … " + std::to_string(seconds) +
           " s";
}

StillWorking::~StillWorking() {
    {
        const std::lock_guard lock(mutex_);
        is_over_ = true;
    }
    wake_.notify_one();
    if (clock_.joinable()) clock_.join();
    if (is_on_terminal()) std::fputs(clear_line, own_errors());
}

}  // namespace kerf::app
