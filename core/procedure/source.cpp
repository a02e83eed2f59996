// SPDX-License-Identifier: Apache-2.0
#include "core/procedure/source.h"

#include <algorithm>
#include <utility>

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
