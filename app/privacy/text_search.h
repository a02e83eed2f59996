// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/privacy/privacy_report.h"

/// Searches text for personal data.
namespace kerf::app::privacy {

[[nodiscard]] constexpr bool is_digit(char c) { return c >= '0' && c <= '9'; }
[[nodiscard]] constexpr char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Adds a finding, unless the report has it or has 20 of this kind already.   [any]
void add_finding(PrivacyReport& report, const std::string& what, std::string value);

/// Adds the paths, names, UIDs and dates in `text` to the report.   [main]
/// @param where   appended to each finding; not empty: the text was picked out of bytes
void search_text(const std::string& text, PrivacyReport& report, const std::string& where = "");

/// As search_text(), in letters of one byte and of two.   [main]
void search_text_and_utf16(const std::string& bytes, PrivacyReport& report);

}  // namespace kerf::app::privacy
