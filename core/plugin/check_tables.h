// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "kerf/abi.h"

/// Checks of a plugin's tables before the host uses them.
namespace kerf {

/// Maximum number of rows of a table. A plugin with a larger count is refused.
inline constexpr std::uint32_t max_table_rows = 256;
inline constexpr std::uint32_t max_state_size = 64u << 20, max_state_align = 4096;

/// Returns the text with which every refusal begins, such as `plugin peck.so (path): `.   [any]
[[nodiscard]] std::string named_plugin(const std::string& path);

/// Returns the reason why this host cannot use an entry: plugin, path, component, field, value and remedy. Returns an
/// empty text if it can. Reads the memory that the tables point to: an invalid pointer ends the process.   [any]
[[nodiscard]] std::string refusal_of(const kerf_entry& entry, const std::string& path);
/// Returns the same reason without plugin and path.   [any]
[[nodiscard]] std::string fault_of(const kerf_entry& entry);

/// Returns whether this host knows a kind of components, KERF_KIND_…. It skips components of other kinds.   [any]
[[nodiscard]] bool is_known_kind(std::uint32_t kind) noexcept;

/// Returns the plugin's id; empty if the entry is not of this ABI or its id is invalid.   [any]
[[nodiscard]] std::string plugin_id_of(const kerf_entry& entry);

}  // namespace kerf
