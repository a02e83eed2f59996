// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

/// Pieces of pictures and tables that every part of the kit writes. For training and research; not for diagnosis,
/// planning or deciding treatment.
namespace kerf::drawing {

/// A <text>, escaped, at whole pixels. `more`: further attributes.
[[nodiscard]] std::string text_at(double x, double y, std::string_view text, std::string_view more = "");

/// A number for an attribute: a tenth of a pixel.
[[nodiscard]] std::string px(double value);

/// A field of a CSV row, in quotation marks.
[[nodiscard]] std::string csv_quoted(std::string_view field);

/// printf's `%.*g`, whatever the locale, without an exponent below a million; what is less than 1e-12 is 0 and has no
/// sign.
[[nodiscard]] std::string figure(double value, int digits = 3);

/// Words with commas between them.
[[nodiscard]] std::string joined(const std::vector<std::string>& words, std::string_view between = ", ");

}  // namespace kerf::drawing
