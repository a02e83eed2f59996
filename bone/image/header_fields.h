// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bone/image/image_file.h"

/// Headers that are lines of text: a name and a value each.
namespace kerf::header {

/// By name in lower case. NRRD and MetaImage give some fields several names.
using Fields = std::map<std::string, std::string>;

[[nodiscard]] std::string lower(std::string_view text);
[[nodiscard]] std::string_view trimmed(std::string_view text);
[[nodiscard]] std::vector<std::string_view> words_of(std::string_view text, std::string_view separators = " \t\r,()");

/// Adds a field; refuses one that is there already.
void add(Fields& fields, std::string_view name, std::string_view value);

/// The value of a field by any of its names; null if it is absent. Refuses a header with two of them.
[[nodiscard]] const std::string* find(const Fields& fields, std::initializer_list<const char*> names);

/// The same; refuses a header without it.
[[nodiscard]] const std::string& need(const Fields& fields, std::initializer_list<const char*> names);

/// Numbers separated by blanks, commas or parentheses. Refuses anything else.
[[nodiscard]] std::vector<double> decimals_of(std::string_view text, const std::string& field);
[[nodiscard]] std::vector<long long> wholes_of(std::string_view text, const std::string& field);
[[nodiscard]] long long whole_of(std::string_view text, const std::string& field);

/// Text in double quotes, or words between blanks.
[[nodiscard]] std::vector<std::string> quoted_words_of(std::string_view text, const std::string& field);

/// The type of a voxel by the name that NRRD or MetaImage gives it.
[[nodiscard]] ImageFile::Number named_number(const std::string& type);

}  // namespace kerf::header
