// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "text/code.h"
#include "text/result.h"
#include "text/source.h"

/// A YAML document as a tree whose nodes have their places. Kerf guesses no types: `yes` and `1.0` are text.
namespace kerf::documents {

/// Bytes in the document's text. `Document::place` converts them to line and column for a message.
struct TextSpan {
    std::size_t begin = 0;
    std::size_t size = 1;
    std::size_t source = 0;  ///< 0: the document itself; or a text that was added to it
};

struct Node {
    enum class Kind { scalar, map, list };
    Kind kind = Kind::scalar;
    std::string text;  ///< of a scalar; empty for `~`, `null` and nothing
    TextSpan span;
    std::string key;             ///< in a map
    TextSpan key_span;           ///< in a map
    bool is_refused = false;     ///< it is reported already
    bool is_alias = false;       ///< a copy of the node with the anchor; reported already
    bool is_quoted = false;      ///< a scalar in quotation marks
    bool is_removal = false;     ///< `~`
    std::vector<Node> children;  ///< in the order of the file

    const Node* find(std::string_view wanted) const noexcept;
};

struct Shape;

class Document {
public:
    Document(std::string file, std::string text);

    const std::string& file() const noexcept { return file_; }
    const std::string& text() const noexcept { return text_; }
    text::SourcePosition place(TextSpan span) const;
    std::string source_line(TextSpan span) const;     ///< empty when too long to show
    std::size_t line_begin(int line) const noexcept;  ///< of a line counted from 0

    /// Adds a text that changes this document. Returns its tree, whose places lead to that text.
    Node add_source(Document added);
    /// Records that the value at `now` replaces the one at `before`.
    void note_replaced(TextSpan now, TextSpan before) { replaced_[{now.source, now.begin}] = before; }
    std::optional<TextSpan> replaced_by(TextSpan now) const;

    Node root;

private:
    std::size_t line_of(std::size_t at) const noexcept;
    std::string_view line(std::size_t index) const noexcept;

    std::string file_, text_;
    std::vector<std::size_t> line_begins_;
    std::vector<Document> added_;
    std::map<std::pair<std::size_t, std::size_t>, TextSpan> replaced_;  ///< by source and begin
};

/// Collects the mistakes of one document. It shows at most 100 of them and reports that there are more. It shows the
/// same message at the same place once: several rehearsals may follow one path.
class Report {
public:
    /// @param whole   shape of the document, for messages about a key that belongs elsewhere in it; null: unknown
    Report(const Document& document, text::Diagnostics& diagnostics, const Shape* whole = nullptr)
        : document_(document), diagnostics_(diagnostics), whole_(whole) {}

    void error(text::Code code, TextSpan span, std::string message, std::string write = {},
               std::optional<text::Reason> reason = {});
    void warning(text::Code code, TextSpan span, std::string message, std::string write = {});
    text::Reason because(TextSpan span, std::string message) const;  ///< a reason in this document
    const std::string& file() const noexcept { return document_.file(); }
    const Shape* whole() const noexcept { return whole_; }
    bool has_error() const noexcept { return errors_ > 0; }
    int errors() const noexcept { return errors_; }
    bool is_full() const noexcept { return shown_ > max_shown; }

private:
    static constexpr int max_shown = 100;

    [[nodiscard]] bool is_reported(const std::string& code, TextSpan span, const std::string& message) const;
    void add(text::Diagnostic::Level level, text::Code code, TextSpan span, std::string message, std::string write,
             std::optional<text::Reason> reason);

    const Document& document_;
    text::Diagnostics& diagnostics_;
    const Shape* whole_ = nullptr;
    int shown_ = 0;
    int errors_ = 0;
    bool is_end_told_ = false;
};

/// Reads a text again that was read without errors, to get the places of its values.   [main]
Document read_again(const std::string& file, const std::string& text);

/// Reads a file of at most 1 MB as UTF-8 text. Of a larger file it returns one byte more, which `parse_document`
/// refuses.   [main]
text::Result<std::string> read_text_file(const std::string& file);

/// Reads YAML: one document, no anchors, aliases or tags, no key twice, at most 64 levels. It reports each breach.
/// Whenever the text is YAML at all, a tree without the offending parts comes with the errors, so that a reader can
/// search for further errors. Never throws.   [main]
text::Result<Document> parse_document(const std::string& file, std::string text);

}  // namespace kerf::documents
