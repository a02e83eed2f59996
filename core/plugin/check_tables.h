// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>

#include "kerf/abi.h"

/// What a host demands of a plugin's tables before it uses them.
namespace kerf {

/// How much of a table the host reads: a count beyond it is a fault, not a size.
inline constexpr std::uint32_t max_table_rows = 256;
inline constexpr std::uint32_t max_state_size = 64u << 20, max_state_align = 4096;

/// `plugin peck.so (path): `, which begins every refusal.   [any]
[[nodiscard]] std::string named_plugin(const std::string& path);

/// Why an entry cannot be used by this host, with plugin, path, component, field, value and what to write; empty when
/// it can. Reads what the tables point at: a pointer into nowhere ends the process.   [any]
[[nodiscard]] std::string refusal_of(const kerf_entry& entry, const std::string& path);
/// The same without plugin and path.   [any]
[[nodiscard]] std::string fault_of(const kerf_entry& entry);

/// Whether this host knows components of a kind. It leaves the others out.   [any]
[[nodiscard]] bool is_known_kind(std::uint32_t kind) noexcept;

/// The id that an entry of this ABI gives itself; empty if it has none that can be printed.   [any]
[[nodiscard]] std::string plugin_id_of(const kerf_entry& entry);

}  // namespace kerf
