// SPDX-License-Identifier: Apache-2.0
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <sstream>
#include <unordered_set>
#include <utility>

#include "documents/yaml/document.h"
#include "documents/yaml/explain_syntax.h"
#include "documents/yaml/largest_file.h"
#include "documents/yaml/merge_nodes.h"
#include "text/codes.h"
#include "text/look_alike.h"
#include "text/printable.h"
#include "text/quantity.h"

namespace kerf::documents {
namespace {

constexpr std::size_t deepest_level = 64;
constexpr int max_controls_shown = 5;

/// Bytes of the character that starts at `at`: 1 … 4, or 0 if it is not UTF-8.
std::size_t character_size(std::string_view text, std::size_t at) noexcept {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned>(static_cast<unsigned char>(text[i])); };
    const unsigned first = byte(at);
    if (first < 0x80) return 1;
    const std::size_t size = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
    if (first < 0xC2 || first > 0xF4 || at + size > text.size()) return 0;
    unsigned value = first & (0xFFu >> (size + 1));
    for (std::size_t i = 1; i < size; ++i) {
        if ((byte(at + i) & 0xC0u) != 0x80u) return 0;
        value = value << 6 | (byte(at + i) & 0x3Fu);
    }
    constexpr unsigned smallest[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool is_surrogate = value >= 0xD800 && value <= 0xDFFF;
    return value < smallest[size] || value > 0x10FFFF || is_surrogate ? 0 : size;
}

/// The first byte that is not UTF-8; npos if all is well.
std::size_t find_not_utf8(std::string_view text) noexcept {
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t size = character_size(text, at);
        if (size == 0) return at;
        at += size;
    }
    return std::string_view::npos;
}

std::string byte_text(char byte) {
    char text[8];
    std::snprintf(text, sizeof text, "0x%02X", static_cast<unsigned>(static_cast<unsigned char>(byte)));
    return text;
}

/// Reports characters that show nothing and change how a text is read. Returns the text with blanks in place of them,
/// so that its other mistakes are found, too.
std::string without_controls(std::string text, Report& report) {
    int reported = 0;
    for (std::size_t at = 0;;) {
        const std::optional<text::LookAlike> found = text::find_control(std::string_view(text).substr(at));
        if (!found) return text;
        at += found->at;
        if (++reported <= max_controls_shown)
            report.error(text::Code::not_text, {at, found->size},
                         "The file holds " + text::code_point_text(found->code) + " (" + found->name +
                             "), a character that shows nothing. Remove it.");
        std::fill_n(text.begin() + static_cast<std::ptrdiff_t>(at), found->size, ' ');
        at += found->size;
    }
}

/// Reports blanks that are none for YAML where a line is indented. False if there are any: nobody knows what the line
/// belongs to.
bool has_plain_indents(const Document& document, Report& report) {
    const std::string_view text = document.text();
    bool is_plain = true;
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::size_t indent = std::min(text.find_first_not_of(' ', begin), end);
        const std::optional<text::LookAlike> found =
            text::find_look_alike(text.substr(indent, std::min<std::size_t>(4, end - indent)));
        if (found && found->at == 0 && (found->ascii == " " || found->ascii.empty())) {
            is_plain = false;
            report.error(text::Code::syntax, {indent, found->size},
                         "The line begins with " + text::code_point_text(found->code) + " (" + found->name +
                             "), expected plain spaces. Indent with spaces.");
        }
        begin = end + 1;
    }
    return is_plain;
}

/// Thrown by the handler below to leave the parser; never leaves this file.
struct StopReading {};

/// Builds the tree from yaml-cpp's events: the only part of yaml-cpp that gives a position for everything.
class TreeBuilder final : public YAML::EventHandler {
public:
    TreeBuilder(Document& document, Report& report) : document_(document), report_(report) {}

    bool has_content() const noexcept { return has_content_; }

    void OnDocumentStart(const YAML::Mark& mark) override {
        if (documents_++ == 0) return;
        report_.error(text::Code::several_documents, {at(mark), 1},
                      "The file holds a second document, expected one. Remove it, or put it into a file of its own.");
        throw StopReading{};
    }
    void OnDocumentEnd() override {}

    void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
        is_tilde_ = at(mark) < document_.text().size() && document_.text()[at(mark)] == '~';
        add_scalar(mark, "", anchor, "");
        is_tilde_ = false;
    }
    void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  const std::string& value) override {
        add_scalar(mark, tag, anchor, value);
    }
    void OnAnchor(const YAML::Mark& mark, const std::string& name) override {
        report_.error(text::Code::anchor_or_alias, {at(mark), name.size() + 1},
                      "Anchors are not allowed: they hide where a value comes from. Remove the anchor.");
    }
    void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
        Node node = anchors_.copy_of(anchor, {at(mark), 1});
        report_.error(text::Code::anchor_or_alias, node.span,
                      "Aliases are not allowed: they hide where a value comes from. Repeat the value.");
        add(std::move(node));
    }
    void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                         YAML::EmitterStyle::value) override {
        open(Node::Kind::list, mark, tag, anchor);
    }
    void OnSequenceEnd() override { close(); }
    void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                    YAML::EmitterStyle::value) override {
        open(Node::Kind::map, mark, tag, anchor);
    }
    void OnMapEnd() override { close(); }

private:
    /// A map or list whose end has not come yet.
    struct Open {
        Node node;
        YAML::anchor_t anchor = 0;
        std::optional<Node> key;  ///< waiting for its value
        std::unordered_set<std::string> keys;
        std::vector<Node> merged;  ///< aliases under `<<`: what the map lacks is meant to come from them
    };

    std::size_t at(const YAML::Mark& mark) const noexcept {
        const std::size_t begin = document_.line_begin(std::max(0, mark.line));
        return std::min(begin + static_cast<std::size_t>(std::max(0, mark.column)), document_.text().size());
    }

    /// Bytes from `begin` that show `value`, on one line: with its quotes, or without.
    std::size_t shown_size(std::size_t begin, std::string_view value) const noexcept {
        const std::string_view rest = std::string_view(document_.text()).substr(begin);
        if (rest.empty()) return 1;
        if (rest[0] != '"' && rest[0] != '\'')
            return rest.starts_with(value) ? std::max<std::size_t>(1, value.size()) : 1;
        for (std::size_t i = 1; i < rest.size() && rest[i] != '\n'; ++i) {
            if (rest[0] == '"' && rest[i] == '\\')
                ++i;
            else if (rest[i] == rest[0])
                return i + 1;
        }
        return 1;
    }

    void refuse_tag(std::size_t begin, const std::string& tag) {
        const bool is_written = begin < document_.text().size() && document_.text()[begin] == '!';
        if (!is_written && (tag.empty() || tag == "?" || tag == "!")) return;
        report_.error(text::Code::tag, {begin, 1},
                      "Tags are not allowed: a key alone decides what its value means. Remove the tag.");
    }

    void add_scalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor, const std::string& value) {
        Node node;
        node.text = value;
        node.span = {at(mark), 1};
        node.span.size = shown_size(node.span.begin, value);
        node.is_removal = is_tilde_;
        node.is_quoted = tag == "!";
        refuse_tag(node.span.begin, tag);
        if (const auto unclosed =
                find_unclosed_quote(document_.text(), node.span.begin)) {  // else the rest of the file is its text
            report_.error(text::Code::syntax, {unclosed->at, 1}, about(*unclosed, document_.text()[unclosed->at]));
            throw StopReading{};
        }
        if (const std::optional<text::LookAlike> control = text::find_control(node.text)) {  // written as an escape
            report_.error(text::Code::not_text, node.span,
                          "The text holds " + text::code_point_text(control->code) + " (" + control->name +
                              ") as an escape. Remove it.");
            node.text = text::printable(node.text);
            node.is_refused = true;
        }
        anchors_.add(anchor, node);
        add(std::move(node));
    }

    void open(Node::Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
        Open opened;
        opened.anchor = anchor;
        opened.node.kind = kind;
        opened.node.span = {at(mark), 1};
        refuse_tag(opened.node.span.begin, tag);
        if (open_.size() >= deepest_level) {
            report_.error(text::Code::nested_too_deep, opened.node.span,
                          "The nesting is too deep: got more than " + std::to_string(deepest_level) +
                              " levels. Use fewer levels.");
            throw StopReading{};
        }
        open_.push_back(std::move(opened));
    }

    void close() {
        Open closed = std::move(open_.back());
        open_.pop_back();
        for (const Node& more : closed.merged) {
            merge(closed.node, more);
            closed.node.is_refused |= more.is_refused;  // which keys it lacks is not known
        }
        anchors_.add(closed.anchor, closed.node);
        add(std::move(closed.node));
    }

    void add(Node node) {
        if (open_.empty()) {
            has_content_ = node.kind != Node::Kind::scalar || !node.text.empty() || node.is_refused;
            document_.root = std::move(node);
            return;
        }
        Open& parent = open_.back();
        if (parent.node.kind == Node::Kind::list) {
            parent.node.children.push_back(std::move(node));
        } else if (!parent.key) {
            node.is_refused |= node.is_alias;
            parent.key = std::move(node);
        } else {
            add_entry(parent, std::move(node));
        }
    }

    /// `{size: 44, 35, 28 mm}`: YAML sees a size of 44 and two keys. Reports the first one, in place of all.
    bool is_in_row(Node& number, const Node& key) {
        if (number.is_refused) return key.span.begin < number.span.begin + number.span.size;
        const NumberRow row = find_number_row(document_.text(), number.span.begin);
        if (key.span.begin >= number.span.begin + row.size) return false;
        number.span.size = row.size;
        number.is_refused = true;
        report_.error(text::Code::not_three_numbers, number.span,
                      number.key + " has commas between its numbers: got `" + text::excerpt(row.text(", "), 40) +
                          "`, expected spaces.",
                      row.text(" "));
        return true;
    }

    /// `{diameter: 3,2 mm}`: YAML sees a diameter of 3 and a key `2 mm`. Says so, once, in place of both.
    bool is_behind_decimal_comma(Node& map, const Node& key) {
        if (map.children.empty() || key.text.size() > 40) return false;
        if (map.children.back().kind == Node::Kind::scalar && is_in_row(map.children.back(), key)) return true;
        if (key.text[0] < '0' || key.text[0] > '9') return false;
        Node& number = map.children.back();
        const std::size_t comma = number.span.begin + number.span.size;
        const bool is_joined = key.span.begin == comma + 1 && document_.text()[comma] == ',';
        const std::size_t figures = number.text.starts_with('-') ? 1 : 0;
        const bool is_whole =
            number.text.size() > figures && number.text.find_first_not_of("0123456789", figures) == std::string::npos;
        if (!is_joined || !is_whole || number.kind != Node::Kind::scalar) return false;
        number.span.size = key.span.begin + key.span.size - number.span.begin;
        if (number.is_refused) return true;  // the third of `1,2,3 mm`

        const std::string_view rest = std::string_view(document_.text()).substr(key.span.begin + key.span.size);
        const bool is_row = rest.size() > 1 && rest[0] == ',' && rest[1] != ' ';
        const text::QuantityProblem problem =
            is_row ? text::QuantityProblem{text::Code::not_three_numbers,
                                           number.key +
                                               " has commas between its numbers. Put spaces there, as in `1 2 3 mm`.",
                                           {}}
                   : text::decimal_comma(number.key, number.text, key.text);
        report_.error(problem.code, number.span, problem.message, problem.write);
        number.is_refused = true;
        return true;
    }

    /// `{feed:1 mm/s}`: YAML sees a key `feed:1 mm/s` without a value. Says so, and goes on with what is meant.
    void split_key(Node& key, Node& value) {
        const bool is_absent = value.kind == Node::Kind::scalar && value.text.empty() && !value.is_refused;
        const auto mistake = is_absent ? find_missing_space(key.text) : std::nullopt;
        if (!mistake) return;
        report_.error(text::Code::syntax, key.span, mistake->message, mistake->write);
        const std::size_t colon = key.text.find(':');
        value.text = text::straightened(key.text.substr(colon + 1));
        value.text.erase(0, value.text.find_first_not_of(' '));
        value.span = key.span;
        key.text.resize(colon);
        key.span.size = std::min(key.span.size, colon);
    }

    /// Takes the value of `<<` if it is an alias, which is reported, or a list of them.
    static bool take_merged(Open& parent, const Node& value) {
        if (value.is_alias) parent.merged.push_back(value);
        if (value.is_alias || value.kind != Node::Kind::list) return value.is_alias;
        const auto is_alias = [](const Node& item) { return item.is_alias; };
        if (!std::any_of(value.children.begin(), value.children.end(), is_alias)) return false;
        parent.merged.insert(parent.merged.end(), value.children.begin(), value.children.end());
        return true;
    }

    void add_entry(Open& parent, Node value) {
        Node key = std::move(*parent.key);
        parent.key.reset();
        if (key.is_refused) return;
        if (key.kind == Node::Kind::scalar && !key.is_quoted) {
            if (const auto dash = find_missing_dash_space(key.text)) {
                report_.error(text::Code::syntax, key.span, dash->message + " Put one there.");
                parent.node.is_refused = true;  // it should have been a list
                return;
            }
            split_key(key, value);
        }
        if (key.kind != Node::Kind::scalar || key.text.empty()) {
            report_.error(text::Code::key_not_text, key.span, "The key is not a word. Put one before the `:`.");
            return;
        }
        if (key.text == "<<" && take_merged(parent, value)) return;
        if (!parent.keys.insert(key.text).second) {
            std::optional<text::Reason> reason;
            const auto first = std::find_if(parent.node.children.begin(), parent.node.children.end(),
                                            [&](const Node& child) { return child.key == key.text; });
            if (!report_.is_full() && first != parent.node.children.end()) {
                reason = report_.because(first->key_span, "it is here first.");
                merge(*first, value);  // what names its parts finds them
            }
            report_.error(text::Code::duplicate_key, key.span,
                          "The key `" + text::excerpt(key.text) + "` occurs twice in one map. Remove one of the two.",
                          {}, std::move(reason));
            return;
        }
        // yaml-cpp places an absent value at the next token, often on another line.
        const bool is_absent = value.kind == Node::Kind::scalar && value.text.empty() && !value.is_refused;
        if (is_absent && is_behind_decimal_comma(parent.node, key)) return;
        if (is_absent) value.span = key.span;
        value.key = key.text;
        value.key_span = key.span;
        parent.node.children.push_back(std::move(value));
    }

    Document& document_;
    Report& report_;
    std::vector<Open> open_;
    Anchors anchors_;
    int documents_ = 0;
    bool has_content_ = false;
    bool is_tilde_ = false;  ///< the scalar being added is `~`
};

}  // namespace

text::Result<Document> parse_document(const std::string& file, std::string text) {
    if (text.size() > largest_file) {
        return text::Diagnostics{text::error_about(file, text::code_text(text::Code::file_too_large),
                                                   "The file is too large: got more than 1 MB. Name a YAML file.")};
    }
    if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);  // a byte order mark would shift the first line

    text::Diagnostics found;
    Document document(file, std::move(text));
    Report report(document, found);
    if (const std::size_t at = find_not_utf8(document.text()); at != std::string::npos) {
        report.error(text::Code::not_text, {at, 1},
                     "The file is not UTF-8 text: got the byte " + byte_text(document.text()[at]) +
                         ". Save it as UTF-8 in a text editor.");
        return found;
    }
    const std::string plain = without_controls(document.text(), report);
    if (!has_plain_indents(document, report)) return found;

    TreeBuilder builder(document, report);
    try {
        std::istringstream stream(plain);
        YAML::Parser parser(stream);
        while (parser.HandleNextDocument(builder)) {
        }
        if (!builder.has_content()) {
            found.push_back(text::error_about(
                file, text::code_text(text::Code::file_empty),
                "The file is empty. Begin it with `apiVersion: kerf/v1`, as the shipped procedures do."));
            return found;
        }
    } catch (const StopReading&) {
        return found;
    } catch (const YAML::Exception& failure) {
        const std::size_t at =
            document.line_begin(failure.mark.line) + static_cast<std::size_t>(std::max(0, failure.mark.column));
        if (const std::optional<Unclosed> unclosed = find_unclosed_for(failure.msg, document.text(), at)) {
            report.error(text::Code::syntax, {unclosed->at, 1}, about(*unclosed, document.text()[unclosed->at]));
            return found;
        }
        const SyntaxMistake mistake = explain_syntax(failure.msg, document.text(), at);
        const int line = document.place({mistake.at}).line;
        const bool is_reported = std::any_of(found.begin(), found.end(), [&](const text::Diagnostic& d) {
            return d.place.file == file && d.place.line == line && d.code == text::code_text(text::Code::syntax);
        });
        if (!is_reported) report.error(text::Code::syntax, {mistake.at, mistake.size}, mistake.message, mistake.write);
        return found;
    } catch (const std::exception& failure) {  // yaml-cpp on input that its authors did not think of
        found.push_back(text::error_about(
            file, text::code_text(text::Code::syntax),
            std::string("The file is not YAML: ") + text::excerpt(failure.what(), 100) + ". Correct it."));
        return found;
    }
    return {std::move(document), std::move(found)};
}

Document read_again(const std::string& file, const std::string& text) {
    text::Result<Document> document = parse_document(file, text);
    return document ? std::move(*document) : Document(file, text);
}

}  // namespace kerf::documents
