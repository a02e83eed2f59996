// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

/// Where results go.
namespace kerf {

/// Returns why nothing could be written into `folder`, which need not exist yet; empty if it could. Called before the
/// minutes of work that go into it.   [main]
[[nodiscard]] std::string refusal_of_folder(const std::string& folder);

/// The same of a page. What is no page is never written over.   [main]
[[nodiscard]] std::string refusal_of_page(const std::string& file);

/// Writes a page, and makes the folders that it needs; they go again if it cannot be written. Returns what went wrong,
/// for people; empty if nothing did.   [main]
[[nodiscard]] std::string write_page(const std::string& file, const std::string& page);

}  // namespace kerf
