// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Places in a document, and what is wrong there.
namespace kerf {

/// A place in a text file, counted from 1; line 0 means "the file as a whole".
struct SourcePlace {
    std::string file;
    int line = 0;
    int column = 0;
    int length = 1;  ///< characters to underline
};

/// Why something is wrong, if that is decided elsewhere: the limits that a plugin declares, the first of two keys.
struct Reason {
    SourcePlace place;        ///< its `file` may be a plugin's component
    std::string message;      ///< one sentence
    std::string source_line;  ///< the text of place.line; may be empty
};

/// One error or warning for a person: code, place, what we got, what is needed, what to write.
struct Diagnostic {
    enum class Level { error, warning };
    Level level = Level::error;
    std::string code;  ///< "E0412"
    SourcePlace place;
    std::string message;      ///< one sentence: what we got and what is needed, with its unit
    std::string write;        ///< what to write instead; may be empty
    std::string source_line;  ///< the text of place.line, for the caret; may be empty
    std::optional<Reason> reason{};
};

using Diagnostics = std::vector<Diagnostic>;

/// An error or warning about a file as a whole. `message` says what to do, too.
[[nodiscard]] Diagnostic error_about(const std::string& file, std::string code, std::string message);
[[nodiscard]] Diagnostic warning_about(const std::string& file, std::string code, std::string message);

/// The same at the place of `at`, whose message is not used.
[[nodiscard]] Diagnostic error_at(const Reason& at, std::string code, std::string message);
[[nodiscard]] Diagnostic warning_at(const Reason& at, std::string code, std::string message);

/// Gives everything from `first` on, which is about a file, the place that names this file as its reason; if that has a
/// line.
void because_of(const Reason& named, Diagnostics& diagnostics, std::size_t first);

/// `file:14:22`, or `file` for the file as a whole.
std::string to_text(const SourcePlace& place);

bool has_error(const Diagnostics& diagnostics) noexcept;

/// Returns a text of messages, which may quote files, as a terminal, a page or JSON may show it: printable but for line
/// ends and tabs.   [any] pure.
std::string shown(std::string_view text);

/// `E0412 file:14:22: message Write `6.5 mm`.` followed by the source line and a caret, and by the reason likewise.
std::string to_text(const Diagnostics& diagnostics);

}  // namespace kerf
