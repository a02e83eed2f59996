// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "kerf/abi.h"

/// Checks of a plugin's tables before the host uses them.
namespace kerf {

/// Maximum number of rows that the host reads: a larger count is a fault.
inline constexpr std::uint32_t max_table_rows = 256;
inline constexpr std::uint32_t max_state_size = 64u << 20, max_state_align = 4096;

/// Returns `plugin peck.so (path): `, with which every refusal begins.   [any]
[[nodiscard]] std::string named_plugin(const std::string& path);

/// Returns the reason why this host cannot use an entry, with plugin, path, component, field, value and remedy; empty
/// if it can. Reads the memory that the tables point to: an invalid pointer ends the process.   [any]
[[nodiscard]] std::string refusal_of(const kerf_entry& entry, const std::string& path);
/// Returns the reason without plugin and path.   [any]
[[nodiscard]] std::string fault_of(const kerf_entry& entry);

/// Returns whether this host knows components of a kind. It skips the others.   [any]
[[nodiscard]] bool is_known_kind(std::uint32_t kind) noexcept;

/// Returns the id in an entry of this ABI; empty if it has no printable id.   [any]
[[nodiscard]] std::string plugin_id_of(const kerf_entry& entry);

}  // namespace kerf
