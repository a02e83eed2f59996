// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "kerf/abi.h"

/// Services that the host offers to a plugin that it has loaded.
namespace kerf {

namespace detail {

/// The host of this library and the host's log. Both are null before `open_plugin`; the log also if the host has none.
struct HostServices {
    const kerf_host* host = nullptr;
    const kerf_log* log = nullptr;
};
inline HostServices services;

/// Stores the host and its log. KERF_PLUGIN exports it as the plugin's `open`.
inline kerf_status open_plugin(const kerf_host* host) noexcept {
    services.host = host;
    services.log = static_cast<const kerf_log*>(host->find(host, KERF_LOG_ID, KERF_LOG_VERSION));
    return KERF_OK;
}

inline void write_log(std::uint32_t level, const char* text) noexcept {
    if (services.log != nullptr) services.log->write(services.host, level, text);
}

}  // namespace detail

/// Prints one line under the plugin's name: at most 500 bytes, and 100 lines in all.   [main], or in a strategy's call
inline void log_note(const char* text) noexcept { detail::write_log(KERF_LOG_NOTE, text); }
/// Prints one line as a warning, with the same limits.
inline void log_warning(const char* text) noexcept { detail::write_log(KERF_LOG_WARNING, text); }

/// Returns a service of the host, or null if the host does not offer this version.   [main]
template <class Service>
[[nodiscard]] const Service* host_service(const char* id, std::uint32_t version) noexcept {
    const kerf_host* host = detail::services.host;
    return host != nullptr ? static_cast<const Service*>(host->find(host, id, version)) : nullptr;
}

}  // namespace kerf
