// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "kerf/abi.h"

namespace kerf {

/// The host as one plugin gets it: its services, and the name under which its lines are printed.   [main]
class PluginHost {
public:
    static constexpr int max_lines = 100;         ///< max lines that a plugin may print
    static constexpr std::size_t max_line = 500;  ///< [bytes]

    explicit PluginHost(std::string plugin_id);
    PluginHost(const PluginHost&) = delete;
    PluginHost& operator=(const PluginHost&) = delete;

    /// Calls the `open` of a plugin's entry, if it has one. Returns the reason of a refusal; empty if it is not
    /// refused.
    [[nodiscard]] std::string open(const kerf_entry& entry);

private:
    static const void* find(const kerf_host* host, const char* id, std::uint32_t version);
    static void write(const kerf_host* host, std::uint32_t level, const char* text);

    kerf_host table_;  ///< first member: a plugin's pointer to it is also one to this object
    std::string plugin_id_;
    int lines_ = 0;
};

}  // namespace kerf
