// SPDX-License-Identifier: Apache-2.0
#include "text/source.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

#include "text/printable.h"

namespace kerf::text {

std::string shown(std::string_view text) {
    std::string safe;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find_first_of("\n\t"), text.size());
        safe += printable(text.substr(0, end));
        if (end < text.size()) safe += text[end];
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return safe;
}

namespace {

/// Returns the number of characters in printable text.
std::size_t width_of(std::string_view text) noexcept {
    return static_cast<std::size_t>(std::count_if(
        text.begin(), text.end(), [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0u) != 0x80u; }));
}

/// Returns the number of bytes in the first `characters` characters of a text.
std::size_t bytes_of(std::string_view text, int characters) noexcept {
    std::size_t at = 0;
    for (int seen = 0; at < text.size(); ++at) {
        const bool starts = (static_cast<unsigned char>(text[at]) & 0xC0u) != 0x80u;
        if (starts && seen++ == characters) break;
    }
    return at;
}

/// Returns the source line and a caret line below it. Tabs are kept, so that both lines have the same indentation.
std::string underlined(const SourcePosition& place, const std::string& line) {
    const std::size_t begin = bytes_of(line, std::max(0, place.column - 1));
    const std::string_view marked =
        std::string_view(line).substr(begin, bytes_of(std::string_view(line).substr(begin), std::max(1, place.length)));
    std::string carets;
    for (const char c : shown(std::string_view(line).substr(0, begin)))
        if (c == '\t')
            carets += c;
        else if ((static_cast<unsigned char>(c) & 0xC0u) != 0x80u)
            carets += ' ';
    carets += std::string(std::max<std::size_t>(1, width_of(shown(marked))), '^');
    return "    " + shown(line) + "\n    " + carets + "\n";
}

}  // namespace

std::string to_text(const SourcePosition& place) {
    return place.line > 0 ? place.file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column)
                          : place.file;
}

Diagnostic error_at(const Reason& at, std::string code, std::string message) {
    Diagnostic d;
    d.code = std::move(code);
    d.place = at.place;
    d.message = std::move(message);
    d.source_line = at.source_line;
    return d;
}

Diagnostic warning_at(const Reason& at, std::string code, std::string message) {
    Diagnostic d = error_at(at, std::move(code), std::move(message));
    d.level = Diagnostic::Level::warning;
    return d;
}

Diagnostic error_about(const std::string& file, std::string code, std::string message) {
    return error_at({{file}, {}, {}}, std::move(code), std::move(message));
}

Diagnostic warning_about(const std::string& file, std::string code, std::string message) {
    return warning_at({{file}, {}, {}}, std::move(code), std::move(message));
}

void because_of(const Reason& named, Diagnostics& diagnostics, std::size_t first) {
    for (std::size_t i = first; i < diagnostics.size(); ++i)
        if (named.place.line > 0 && !diagnostics[i].reason && diagnostics[i].place.line == 0)
            diagnostics[i].reason = named;
}

bool has_error(const Diagnostics& diagnostics) noexcept {
    return std::any_of(diagnostics.begin(), diagnostics.end(),
                       [](const Diagnostic& d) { return d.level == Diagnostic::Level::error; });
}

std::string to_text(const Diagnostics& diagnostics) {
    std::string text;
    for (const Diagnostic& d : diagnostics) {
        text += d.code + " " + shown(to_text(d.place)) + ": " + shown(d.message);
        if (!d.write.empty()) text += " Write `" + shown(d.write) + "`.";
        text += "\n";
        if (!d.source_line.empty()) text += underlined(d.place, d.source_line);
        if (!d.reason) continue;
        text += "  because of " + shown(to_text(d.reason->place)) + ": " + shown(d.reason->message) + "\n";
        if (!d.reason->source_line.empty()) text += underlined(d.reason->place, d.reason->source_line);
    }
    return text;
}

}  // namespace kerf::text
