// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "documents/yaml/document.h"

/// Where the waypoints of a rehearsal are written: in its `path`, or in one of `paths` that it follows.
namespace kerf::documents {

/// The most waypoints that all rehearsals together may take from `paths`: a small document must not become a large one.
/// As many may be written in all `paths`, and in the `path` of all rehearsals.
inline constexpr std::size_t max_followed = 10'000;

/// Returns the nodes of the waypoints of a rehearsal's `path`, in the order of `Rehearsal::path`. An item that follows
/// a path gives the waypoints of that path, or none if there is no such path. Empty without a list. After
/// `max_followed` waypoints of other paths it adds no more of them. The nodes belong to the document.   [main]
[[nodiscard]] std::vector<const Node*> waypoint_nodes(const Document& document, const Node* path);

/// Returns the same for a rehearsal by its index; empty if the document has no such rehearsal.   [main]
[[nodiscard]] std::vector<const Node*> waypoint_nodes(const Document& document, std::size_t rehearsal);

/// Returns a waypoint of a rehearsal, or the value that it has under `key`; null where the document has none.   [main]
[[nodiscard]] const Node* waypoint_node(const Document& document, std::size_t rehearsal, std::size_t waypoint,
                                        const char* key = nullptr);

}  // namespace kerf::documents
