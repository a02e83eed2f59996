// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bone/image/image_file.h"

/// Headers of text lines, each with a name and a value.
namespace kerf::bone::header {

/// Fields by name in lower case. NRRD and MetaImage have several names for some fields.
using Fields = std::map<std::string, std::string>;

[[nodiscard]] std::string lower(std::string_view text);
[[nodiscard]] std::string_view trimmed(std::string_view text);
[[nodiscard]] std::vector<std::string_view> words_of(std::string_view text, std::string_view separators = " \t\r,()");

/// Adds a field. Refuses a name that exists already.
void add(Fields& fields, std::string_view name, std::string_view value);

/// Returns the value of a field by any of its names; null if it is absent. Refuses a header with two of them.
[[nodiscard]] const std::string* find(const Fields& fields, std::initializer_list<const char*> names);

/// Returns the value of a field by any of its names. Refuses a header without it.
[[nodiscard]] const std::string& need(const Fields& fields, std::initializer_list<const char*> names);

/// Returns numbers separated by blanks, commas or parentheses. Refuses anything else.
[[nodiscard]] std::vector<double> decimals_of(std::string_view text, const std::string& field);
[[nodiscard]] std::vector<long long> wholes_of(std::string_view text, const std::string& field);
[[nodiscard]] long long whole_of(std::string_view text, const std::string& field);

/// Returns text in double quotes, or words between blanks.
[[nodiscard]] std::vector<std::string> quoted_words_of(std::string_view text, const std::string& field);

/// Returns the type of a voxel from its name in NRRD or MetaImage.
[[nodiscard]] ImageFile::Number named_number(const std::string& type);

}  // namespace kerf::bone::header
