// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace kerf {

/// Writes a whole file: readers see the old one or the new one, never half of it (a temporary file beside it, then
/// a rename). Returns what went wrong, for people; empty if nothing did.   [main]
[[nodiscard]] std::string write_file(const std::string& path, std::string_view contents);
[[nodiscard]] std::string write_file(const std::string& path, std::span<const unsigned char> contents);

/// Makes `folder` ready for a run's files. A folder that exists is emptied only if it holds a session of ours
/// (session.db) and nothing that no run writes; an empty one is taken as it is; anything else is left alone and refused. Returns why, for people;
/// empty when the folder is ready.   [main]
[[nodiscard]] std::string prepare_output(const std::string& folder);

}  // namespace kerf
