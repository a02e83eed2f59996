// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

/// What every target is made of: one reader, and what must hold of whatever it gives.
namespace kerf::fuzz {

/// Hands the bytes to the target's reader as if they were a file's. Says whether they were read without an error.
/// Ends the process if anything that the reader promises does not hold.
bool reads(std::string_view input);

/// Ends the process with `promise` unless it holds, so that the fuzzer keeps the input.
void require(bool holds, const char* promise);

/// Longer inputs are not tried: they take time, and say nothing that short ones do not.
inline constexpr std::size_t max_bytes = 64 * 1024;

}  // namespace kerf::fuzz
