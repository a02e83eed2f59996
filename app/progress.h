// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

/// Signs of life on stderr: on a terminal its present line, written over and over; elsewhere, as in a log, a line of
/// its own after every half minute of work, and none for what is done sooner.
namespace kerf {

/// Percent and a few words.   [main]
void show_progress(double share, const std::string& what);

/// What is being done; nothing clears it from a terminal but the next, or an empty one.   [main]
void show_work(const std::string& what);

/// While this lives, stderr says what is being done and for how long: for work that is silent itself.
/// [main]
class StillWorking {
public:
    explicit StillWorking(const std::string& what);
    ~StillWorking();
    StillWorking(const StillWorking&) = delete;
    StillWorking& operator=(const StillWorking&) = delete;

    /// Which part of it is under way, and how much of that part is done, 0 … 1. Cheap: the next sign of life tells it.
    void is_at(double share, const std::string& part);

private:
    void show_until_over(bool is_written_over) noexcept;
    [[nodiscard]] std::string text(int seconds) const;

    const std::string what_;
    std::mutex mutex_;
    std::condition_variable wake_;
    bool is_over_ = false;
    std::string part_;    ///< empty: nothing is known of parts
    double share_ = 0.0;  ///< of it [–]
    std::thread clock_;
};

}  // namespace kerf
