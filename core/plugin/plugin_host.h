// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "kerf/abi.h"

namespace kerf {

/// The host as one plugin gets it: the services that it offers, and the plugin's id, printed before each of the
/// plugin's lines.   [main]
class PluginHost {
public:
    static constexpr int max_lines = 100;         ///< maximum number of lines that a plugin may print
    static constexpr std::size_t max_line = 500;  ///< [bytes] a longer line is cut off

    explicit PluginHost(std::string plugin_id);
    PluginHost(const PluginHost&) = delete;
    PluginHost& operator=(const PluginHost&) = delete;

    /// Calls the `open` of a plugin's entry, if it has one. Returns the reason to refuse the plugin if `open` failed,
    /// else an empty text.
    [[nodiscard]] std::string open(const kerf_entry& entry);

private:
    static const void* find(const kerf_host* host, const char* id, std::uint32_t version);
    static void write(const kerf_host* host, std::uint32_t level, const char* text);

    kerf_host table_;  ///< first member: a plugin's pointer to it is also one to this object
    std::string plugin_id_;
    int lines_ = 0;
};

}  // namespace kerf
