// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <string>
#include <thread>

namespace kerf::app {

/// Takes the text that plugins print in a worker, so that none of it is taken for Kerf's. It keeps the first 1 MB and
/// counts the rest.   [main]
class PluginOutput {
public:
    PluginOutput();
    ~PluginOutput();
    PluginOutput(const PluginOutput&) = delete;
    PluginOutput& operator=(const PluginOutput&) = delete;

    /// In the worker: separates the program's streams from those of plugins (core/plugin/own_streams.h).
    void separate();
    /// In the parent, once it has forked: begins to read.
    void begin();
    /// In the parent, once the worker has ended: writes the text to plugins.log in the folder of the record, or prints
    /// its begin, and names the plugin on stderr. Does nothing if no plugin has printed.
    void report();

private:
    void read_all() noexcept;
    void end_reading();

    int ends_[2] = {-1, -1};
    std::thread reader_;
    std::atomic<bool> has_worker_ended_{false};
    std::string text_, plugin_;  ///< of the reader until it ends
    std::size_t size_ = 0;
};

}  // namespace kerf::app
