// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

/// Characters that look like ASCII and are not: a typographic minus sign, a no-break space, curly quotation marks.
namespace kerf {

struct LookAlike {
    std::uint32_t code = 0;  ///< code point
    std::string name;        ///< "minus sign"
    std::string ascii;       ///< what it looks like; empty: nothing
    std::size_t at = 0;      ///< first byte
    std::size_t size = 1;    ///< bytes
};

/// Returns the first such character of a text.   [any] pure.
[[nodiscard]] std::optional<LookAlike> find_look_alike(std::string_view text);

/// Returns the text with every such character replaced by what it looks like.   [any] pure.
[[nodiscard]] std::string straightened(std::string_view text);

/// "`−` is U+2212 (minus sign), not `-`"; an invisible character is named by its code point alone.   [any] pure.
[[nodiscard]] std::string about(const LookAlike& look_alike);

/// Returns "U+2212".   [any] pure.
[[nodiscard]] std::string code_point_text(std::uint32_t code);

/// Returns the first character that shows nothing and changes how the text around it is read: a control character other
/// than tab and line end, a mark that turns the direction of writing, or a separator of lines that YAML does not know.
/// `name` says which.   [any] pure.
[[nodiscard]] std::optional<LookAlike> find_control(std::string_view text);

}  // namespace kerf
