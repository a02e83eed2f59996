// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

/// Signs of life on a terminal; nothing at all where stderr goes elsewhere.
namespace kerf {

/// Percent and a few words, on the terminal's present line.   [main]
void show_progress(double share, const std::string& what);

/// What is being done, on the terminal's present line; nothing clears it.   [main]
void show_work(const std::string& what);

/// While this lives, the terminal says what is being done and for how long: for work that cannot tell how far it is.
/// [main]
class StillWorking {
public:
    explicit StillWorking(std::string what);
    ~StillWorking();
    StillWorking(const StillWorking&) = delete;
    StillWorking& operator=(const StillWorking&) = delete;

private:
    std::string what_;
    std::mutex mutex_;
    std::condition_variable wake_;
    bool is_over_ = false;
    std::thread clock_;  ///< none where there is no terminal
};

}  // namespace kerf
