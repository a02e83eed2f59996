// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "text/codes.h"
#include "text/source.h"

/// A document in which «…» marks where the one error must be reported. The marks are not part of the document.
namespace kerf::documents {

struct MarkedText {
    std::string text;
    int line = 0, column = 0, length = 0;

    explicit MarkedText(std::string marked) : text(std::move(marked)) {
        const std::size_t begin = text.find("«");
        if (begin == std::string::npos) return;
        text.erase(begin, std::string_view("«").size());
        const std::size_t end = text.find("»", begin);
        text.erase(end, std::string_view("»").size());
        line = 1 + static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(begin), '\n'));
        const std::size_t before = text.rfind('\n', begin == 0 ? 0 : begin - 1);
        column = static_cast<int>(before == std::string::npos || begin == 0 ? begin + 1 : begin - before);
        length = static_cast<int>(std::count_if(  // of characters
            text.begin() + static_cast<std::ptrdiff_t>(begin), text.begin() + static_cast<std::ptrdiff_t>(end),
            [](char c) { return (static_cast<unsigned char>(c) & 0xC0u) != 0x80u; }));
    }
};

/// `text` with its first `from` replaced by `to`.
inline std::string replaced(std::string text, std::string_view from, std::string_view to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << "the test's document has no \"" << from << "\"";
    if (at != std::string::npos) text.replace(at, from.size(), to);
    return text;
}

/// Expects exactly one error, with this code, at the marked place.
inline void expect_only(text::Code code, const MarkedText& marked, const text::Diagnostics& diagnostics) {
    ASSERT_EQ(diagnostics.size(), 1u) << to_text(diagnostics);
    const text::Diagnostic& d = diagnostics[0];
    EXPECT_EQ(d.code, text::code_text(code)) << to_text(diagnostics);
    EXPECT_EQ(d.place.line, marked.line) << to_text(diagnostics);
    EXPECT_EQ(d.place.column, marked.column) << to_text(diagnostics);
    EXPECT_EQ(d.place.length, marked.length) << to_text(diagnostics);
    EXPECT_FALSE(d.message.empty());
}

}  // namespace kerf::documents
