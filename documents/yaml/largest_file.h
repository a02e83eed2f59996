// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

namespace kerf::documents {

inline constexpr std::size_t largest_file = 1u << 20;  ///< of a document [byte]

}  // namespace kerf::documents
