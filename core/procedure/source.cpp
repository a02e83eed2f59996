// SPDX-License-Identifier: Apache-2.0
#include "core/procedure/source.h"

#include <algorithm>

namespace kerf {
namespace {

bool starts_character(char byte) noexcept { return (static_cast<unsigned char>(byte) & 0xC0u) != 0x80u; }

/// The source line, and under it a caret line. Tabs are kept, so that both lines are indented alike.
std::string underlined(const SourcePlace& place, const std::string& line) {
    std::string carets;
    int column = 1;
    for (const char c : line) {
        if (column >= place.column) break;
        if (!starts_character(c)) continue;
        carets += c == '\t' ? '\t' : ' ';
        ++column;
    }
    const int room = static_cast<int>(std::count_if(line.begin(), line.end(), starts_character)) - (place.column - 1);
    carets += std::string(static_cast<std::size_t>(std::clamp(place.length, 1, std::max(1, room))), '^');
    return "    " + line + "\n    " + carets + "\n";
}

}  // namespace

std::string to_text(const SourcePlace& place) {
    return place.line > 0 ? place.file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column) : place.file;
}

bool has_error(const Diagnostics& diagnostics) noexcept {
    return std::any_of(diagnostics.begin(), diagnostics.end(),
                       [](const Diagnostic& d) { return d.level == Diagnostic::Level::error; });
}

std::string to_text(const Diagnostics& diagnostics) {
    std::string text;
    for (const Diagnostic& d : diagnostics) {
        text += d.code + " " + to_text(d.place) + ": " + d.message;
        if (!d.write.empty()) text += " Write `" + d.write + "`.";
        text += "\n";
        if (!d.source_line.empty()) text += underlined(d.place, d.source_line);
        if (!d.reason) continue;
        text += "  because of " + to_text(d.reason->place) + ": " + d.reason->message + "\n";
        if (!d.reason->source_line.empty()) text += underlined(d.reason->place, d.reason->source_line);
    }
    return text;
}

}  // namespace kerf
