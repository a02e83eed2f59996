// SPDX-License-Identifier: Apache-2.0
#include "run/clock/thread_watch.h"

#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <string>

#include "run/clock/realtime_thread.h"

namespace kerf::run {

namespace {

constexpr std::size_t max_samples = 8192, dropped_samples = 4096;
constexpr std::size_t max_slowest = 10;
constexpr std::int64_t slow_fraction = 4;  // a tick is slow if it ends later than a period divided by this

/// A file of /proc that is read again and again.
class CounterFile {
public:
    explicit CounterFile(const std::string& path) : file_(open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
    ~CounterFile() {
        if (file_ >= 0) close(file_);
    }
    CounterFile(const CounterFile&) = delete;
    CounterFile& operator=(const CounterFile&) = delete;
    /// Returns the text, empty if it cannot be read.
    [[nodiscard]] const char* read() const noexcept {
        const ssize_t size = file_ < 0 ? -1 : pread(file_, text_.data(), text_.size() - 1, 0);
        text_[static_cast<std::size_t>(std::max<ssize_t>(size, 0))] = '\0';
        return text_.data();
    }

private:
    int file_;
    mutable std::array<char, 1024> text_{};
};

}  // namespace

struct ThreadWatch::Counters {
    explicit Counters(const std::string& thread) : schedule(thread + "/schedstat"), state(thread + "/stat") {}

    /// Returns a sample; nothing if the system does not tell the counters.
    [[nodiscard]] std::optional<ThreadSample> sample(const std::atomic<bool>& is_asleep) const noexcept {
        ThreadSample sample;
        sample.begun = monotonic_time();
        long long ran = 0, waited = 0, switched = 0;
        if (std::sscanf(schedule.read(), "%lld %lld %lld", &ran, &waited, &switched) != 3 || switched == 0)
            return std::nullopt;
        sample.waited = waited;
        const bool was_asleep = is_asleep.load(std::memory_order_acquire);
        // The name of the thread may contain blanks; the fields after it begin behind its last parenthesis.
        const char* fields = state.read();
        for (const char* c = fields; *c != '\0'; ++c)
            if (*c == ')') fields = c + 1;
        unsigned long long minor = 0, major = 0;
        char activity = 'R';
        if (std::sscanf(fields, " %c %*d %*d %*d %*d %*d %*u %llu %*u %llu", &activity, &minor, &major) != 3)
            return std::nullopt;
        sample.faults = minor + major;
        sample.is_blocked =
            (activity == 'S' || activity == 'D') && !was_asleep && !is_asleep.load(std::memory_order_acquire);
        sample.at = monotonic_time();
        return sample;
    }

    CounterFile schedule, state;
};

ThreadWatch::ThreadWatch(std::int64_t period) : period_(period) { samples_.reserve(max_samples); }

ThreadWatch::~ThreadWatch() {
    is_ending_ = true;
    if (thread_.joinable()) thread_.join();
}

void ThreadWatch::watch_this_thread() {
    counters_ = std::make_unique<Counters>("/proc/self/task/" + std::to_string(gettid()));
    int policy = SCHED_OTHER;
    sched_param parameters{};
    const bool is_in_real_time =
        pthread_getschedparam(pthread_self(), &policy, &parameters) == 0 && policy == SCHED_FIFO;
    thread_ = std::thread([this, is_in_real_time] {
        if (is_in_real_time) static_cast<void>(take_fifo_priority(helper_priority));
        run(*counters_);
    });
}

void ThreadWatch::report(const TickTrace& tick) noexcept {
    if (tick.missed == 0 && tick.response() * slow_fraction < period_) return;
    if (!slow_.push(tick)) dropped_.fetch_add(tick.missed > 0 ? 1 : 0, std::memory_order_relaxed);
}

LateTicks ThreadWatch::finish() {
    is_ending_ = true;
    if (thread_.joinable()) thread_.join();
    found_.causes[static_cast<std::size_t>(LateCause::unknown)] += dropped_;
    dropped_ = 0;
    return found_;
}

void ThreadWatch::run(const Counters& counters) {
    while (!is_ending_) {
        take_sample(counters);
        explain_until(samples_.empty() ? monotonic_time() - period_ : samples_.back().begun, false);
        std::this_thread::sleep_for(std::chrono::nanoseconds(period_));
    }
    take_sample(counters);
    explain_until(0, true);
}

void ThreadWatch::take_sample(const Counters& counters) {
    if (samples_.size() == max_samples) samples_.erase(samples_.begin(), samples_.begin() + dropped_samples);
    if (const auto sample = counters.sample(is_asleep_)) samples_.push_back(*sample);
}

/// Explains the slow ticks that ended before a time, at the end all of them.
void ThreadWatch::explain_until(std::int64_t time, bool is_last) {
    for (const TickTrace* tick = slow_.front(); tick != nullptr && (is_last || tick->done <= time);
         tick = slow_.front()) {
        const bool follows = last_.done != 0 && last_.tick + 1 == tick->tick && last_.done > tick->due;
        add(explain(*tick, follows ? &last_ : nullptr, samples_, period_));
        last_ = *tick;
        slow_.pop();
    }
}

void ThreadWatch::add(const ExplainedTick& tick) {
    if (tick.trace.missed > 0) ++found_.causes[static_cast<std::size_t>(tick.cause)];
    const auto at = std::upper_bound(
        found_.slowest.begin(), found_.slowest.end(), tick,
        [](const ExplainedTick& a, const ExplainedTick& b) { return a.trace.response() > b.trace.response(); });
    found_.slowest.insert(at, tick);
    if (found_.slowest.size() > max_slowest) found_.slowest.pop_back();
}

}  // namespace kerf::run
