// SPDX-License-Identifier: Apache-2.0
#include "documents/yaml/document.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "text/codes.h"

namespace kerf::documents {
namespace {

constexpr std::size_t longest_line_shown = 240;  // [byte]

bool starts_character(char byte) noexcept { return (static_cast<unsigned char>(byte) & 0xC0u) != 0x80u; }

int characters(std::string_view text) noexcept {
    return static_cast<int>(std::count_if(text.begin(), text.end(), starts_character));
}

}  // namespace

const Node* Node::find(std::string_view wanted) const noexcept {
    const auto found = std::find_if(children.begin(), children.end(), [&](const Node& c) { return c.key == wanted; });
    return kind == Kind::map && found != children.end() ? &*found : nullptr;
}

Document::Document(std::string file, std::string text) : file_(std::move(file)), text_(std::move(text)) {
    line_begins_.push_back(0);
    for (std::size_t i = 0; i < text_.size(); ++i)
        if (text_[i] == '\n') line_begins_.push_back(i + 1);
}

std::size_t Document::line_begin(int line) const noexcept {
    const auto index = static_cast<std::size_t>(std::max(0, line));
    return index < line_begins_.size() ? line_begins_[index] : text_.size();
}

std::size_t Document::line_of(std::size_t at) const noexcept {
    const auto after = std::upper_bound(line_begins_.begin(), line_begins_.end(), at);
    return static_cast<std::size_t>(after - line_begins_.begin()) - 1;
}

std::string_view Document::line(std::size_t index) const noexcept {
    const std::size_t begin = line_begins_[index];
    std::size_t end = index + 1 < line_begins_.size() ? line_begins_[index + 1] - 1 : text_.size();
    if (end > begin && text_[end - 1] == '\r') --end;
    return std::string_view(text_).substr(begin, end - begin);
}

namespace {
void lead_to(std::size_t source, Node& node) {
    node.span.source = node.key_span.source = source;
    for (Node& child : node.children) lead_to(source, child);
}
}  // namespace

Node Document::add_source(Document added) {
    Node tree = std::move(added.root);
    added_.push_back(std::move(added));
    lead_to(added_.size(), tree);
    return tree;
}

std::optional<TextSpan> Document::replaced_by(TextSpan now) const {
    const auto found = replaced_.find({now.source, now.begin});
    return found != replaced_.end() ? std::optional(found->second) : std::nullopt;
}

text::SourcePosition Document::place(TextSpan span) const {
    if (span.source > 0) return added_[span.source - 1].place({span.begin, span.size});
    const std::size_t at = std::min(span.begin, text_.size());
    const std::size_t index = line_of(at);
    text::SourcePosition place;
    place.file = file_;
    place.line = static_cast<int>(index) + 1;
    place.column = characters(std::string_view(text_).substr(line_begins_[index], at - line_begins_[index])) + 1;
    place.length = std::max(1, characters(std::string_view(text_).substr(at, span.size)));
    return place;
}

std::string Document::source_line(TextSpan span) const {
    if (span.source > 0) return added_[span.source - 1].source_line({span.begin, span.size});
    const std::string_view shown = line(line_of(std::min(span.begin, text_.size())));
    return shown.size() <= longest_line_shown ? std::string(shown) : std::string();
}

void Report::error(text::Code code, TextSpan span, std::string message, std::string write,
                   std::optional<text::Reason> reason) {
    ++errors_;
    if (is_reported(text::code_text(code), span, message)) return;
    add(text::Diagnostic::Level::error, code, span, std::move(message), std::move(write), std::move(reason));
}

void Report::warning(text::Code code, TextSpan span, std::string message, std::string write) {
    if (is_reported(text::code_text(code, 'W'), span, message)) return;
    add(text::Diagnostic::Level::warning, code, span, std::move(message), std::move(write), {});
}

text::Reason Report::because(TextSpan span, std::string message) const {
    return {document_.place(span), std::move(message), document_.source_line(span)};
}

bool Report::is_reported(const std::string& code, TextSpan span, const std::string& message) const {
    const text::SourcePosition place = document_.place(span);
    return std::any_of(diagnostics_.begin(), diagnostics_.end(), [&](const text::Diagnostic& d) {
        return d.message == message && d.code == code && d.place.file == place.file && d.place.line == place.line &&
               d.place.column == place.column;
    });
}

void Report::add(text::Diagnostic::Level level, text::Code code, TextSpan span, std::string message, std::string write,
                 std::optional<text::Reason> reason) {
    if (++shown_ > max_shown + 1) return;
    if (shown_ == max_shown + 1) {
        level = text::Diagnostic::Level::error;
        code = text::Code::too_many_errors;
        message = "There are more than " + std::to_string(max_shown) +
                  " errors; the others are not shown. Correct these first.";
        write.clear();
        reason.reset();
    }
    // What is missing may have been lost with the end of the file.
    if (code == text::Code::missing_key && !is_end_told_ && !document_.text().ends_with('\n')) {
        is_end_told_ = true;
        message += " The last line, " + std::to_string(document_.place({document_.text().size()}).line) +
                   ", has no line end: is the file cut off?";
    }
    text::Diagnostic diagnostic;
    diagnostic.level = level;
    diagnostic.code = text::code_text(code, level == text::Diagnostic::Level::error ? 'E' : 'W');
    diagnostic.place = document_.place(span);
    diagnostic.message = std::move(message);
    diagnostic.write = std::move(write);
    diagnostic.source_line = document_.source_line(span);
    diagnostic.reason = std::move(reason);
    if (const auto before = diagnostic.reason ? std::nullopt : document_.replaced_by(span))
        diagnostic.reason = because(*before, "it replaces this.");
    diagnostics_.push_back(std::move(diagnostic));
}

}  // namespace kerf::documents
