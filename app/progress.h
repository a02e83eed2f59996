// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

/// Shows progress on stderr. A terminal gets one line, which is overwritten. A log gets a line after every half minute
/// of work, and none for shorter work.
namespace kerf::app {

/// Shows the percentage and the work.   [main]
/// @param fraction   done, 0 … 1 [–]
void show_progress(double fraction, const std::string& what);

/// Shows the work. The next call replaces it on a terminal; an empty one clears it.   [main]
void show_work(const std::string& what);

/// While this lives, stderr shows the work and its duration: for work that reports no progress itself.   [main]
class StillWorking {
public:
    explicit StillWorking(const std::string& what);
    ~StillWorking();
    StillWorking(const StillWorking&) = delete;
    StillWorking& operator=(const StillWorking&) = delete;

    /// Notes the current part of the work. Cheap: the next line shows it.
    /// @param fraction   of the part that is done, 0 … 1 [–]
    void is_at(double fraction, const std::string& part);

private:
    void show_until_over(bool is_written_over) noexcept;
    [[nodiscard]] std::string text(int seconds) const;

    const std::string what_;
    std::mutex mutex_;
    std::condition_variable wake_;
    bool is_over_ = false;
    std::string part_;       ///< empty: unknown
    double fraction_ = 0.0;  ///< of the part that is done [–]
    std::thread clock_;
};

}  // namespace kerf::app
