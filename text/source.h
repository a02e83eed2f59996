// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Positions in a document, and the problems there.
namespace kerf::text {

/// A position in a text file, counted from 1; line 0 means "the file as a whole".
struct SourcePosition {
    std::string file;
    int line = 0;
    int column = 0;
    int length = 1;  ///< characters to underline
};

/// The cause of a problem, if it is elsewhere: a limit that a plugin declares, the first of two equal keys.
struct Reason {
    SourcePosition place;     ///< its `file` may be a plugin's component
    std::string message;      ///< one sentence
    std::string source_line;  ///< text of that line; may be empty
};

/// One error or warning for a person: code, position, the value found, the value expected, and the correction.
struct Diagnostic {
    enum class Level { error, warning };
    Level level = Level::error;
    std::string code;  ///< "E0412"
    SourcePosition place;
    std::string message;      ///< one sentence: value found and value expected, with unit
    std::string write;        ///< text to write instead; may be empty
    std::string source_line;  ///< text of that line, for the caret; may be empty
    std::optional<Reason> reason{};
};

using Diagnostics = std::vector<Diagnostic>;

/// Returns an error or a warning about a file as a whole. `message` includes the advice.
[[nodiscard]] Diagnostic error_about(const std::string& file, std::string code, std::string message);
[[nodiscard]] Diagnostic warning_about(const std::string& file, std::string code, std::string message);

/// Returns an error or a warning at the position of `at`. The message of `at` is not used.
[[nodiscard]] Diagnostic error_at(const Reason& at, std::string code, std::string message);
[[nodiscard]] Diagnostic warning_at(const Reason& at, std::string code, std::string message);

/// Moves all diagnostics from `first` on, which are about a file, to the position that names this file, and adds
/// `named` as their reason. Does nothing if `named` has no line.
void because_of(const Reason& named, Diagnostics& diagnostics, std::size_t first);

/// Returns `file:14:22`, or `file` for the file as a whole.
std::string to_text(const SourcePosition& place);

bool has_error(const Diagnostics& diagnostics) noexcept;

/// Returns the text of messages, which may quote files, as a terminal, a page or JSON may show it: printable, except
/// for line ends and tabs.   [any] pure.
std::string shown(std::string_view text);

/// Returns `E0412 file:14:22: message Write `6.5 mm`.`, followed by the source line with a caret, and by the reason in
/// the same form.
std::string to_text(const Diagnostics& diagnostics);

}  // namespace kerf::text
