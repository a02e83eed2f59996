// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// Characters that look like ASCII but are not: a typographic minus sign, a no-break space, curly quotation marks.
namespace kerf::text {

struct LookAlike {
    std::uint32_t code = 0;  ///< code point
    std::string name;        ///< "minus sign"
    std::string ascii;       ///< the ASCII text it looks like; empty: none
    std::size_t at = 0;      ///< first byte
    std::size_t size = 1;    ///< bytes
};

/// Returns the first such character of a text.   [any] pure.
[[nodiscard]] std::optional<LookAlike> find_look_alike(std::string_view text);

/// Returns the text with each such character replaced by the ASCII text it looks like.   [any] pure.
[[nodiscard]] std::string straightened(std::string_view text);

/// Returns a description: "`−` is U+2212 (minus sign), not `-`". An invisible character has only its code point.
/// [any] pure.
[[nodiscard]] std::string about(const LookAlike& look_alike);

/// Returns "U+2212".   [any] pure.
[[nodiscard]] std::string code_point_text(std::uint32_t code);

/// Returns the first invisible character that changes how the text is read: a control character other than tab and line
/// end, a mark of writing direction, or a line separator unknown to YAML. `name` describes it.   [any] pure.
[[nodiscard]] std::optional<LookAlike> find_control(std::string_view text);

}  // namespace kerf::text
