// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

/// Files and folders for results.
namespace kerf::app {

/// Returns why no file can be written into `folder`, which need not exist yet; empty if one can. Call it before work
/// that takes minutes.   [main]
[[nodiscard]] std::string refusal_of_folder(const std::string& folder);

/// Returns why `file` cannot be written as a page; empty if it can. Only an .html file is ever overwritten.   [main]
[[nodiscard]] std::string refusal_of_page(const std::string& file);

/// Writes a page and makes its folders; removes new folders on failure. Returns an error message, empty on success.
/// [main]
[[nodiscard]] std::string write_page(const std::string& file, const std::string& page);

}  // namespace kerf::app
