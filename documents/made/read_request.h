// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "documents/made/request.h"
#include "documents/yaml/read_map.h"

namespace kerf::documents {

inline constexpr std::uint32_t max_seed = 999999;

/// Reads which bone to make, and checks that it can be made. Nothing if it cannot; the reasons are reported.   [main]
[[nodiscard]] std::optional<MakeRequest> read_make_request(const Node& node, const std::string& name, Report& report);

}  // namespace kerf::documents
