// SPDX-License-Identifier: Apache-2.0
#include "documents/yaml/read_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <utility>

#include "documents/id.h"
#include "documents/yaml/explain_syntax.h"
#include "documents/yaml/key_homes.h"
#include "kerf/assert.hpp"
#include "kerf/units.hpp"
#include "text/codes.h"
#include "text/file_kind.h"
#include "text/language_code.h"
#include "text/look_alike.h"
#include "text/printable.h"

namespace kerf::documents {
namespace {

const char* kind_name(Node::Kind kind) {
    switch (kind) {
        case Node::Kind::map:
            return "a map of keys";
        case Node::Kind::list:
            return "a list";
        case Node::Kind::scalar:
            break;
    }
    return "a single value";
}

constexpr std::size_t max_listed = 8;  // keys next to the advice where a key belongs

/// How to write a value of this kind.
const char* way_to(Node::Kind kind) {
    switch (kind) {
        case Node::Kind::map:
            return "Write `key: value`, a line for each.";
        case Node::Kind::list:
            return "Put `[` and `]` around it, or `- ` before each item.";
        case Node::Kind::scalar:
            break;
    }
    return "Write a single value.";
}

/// The id nearest to `text`; empty if there is none.
std::string id_of(std::string_view text) {
    std::string id;
    for (const char c : text::straightened(text.substr(0, 64))) {
        const bool is_alphanumeric = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9');
        if (is_alphanumeric || ((c == '.' || c == '_' || c == '-') && !id.empty()))
            id += c;
        else if (!id.empty() && id.back() != '-')
            id += '-';
    }
    while (!id.empty() && id.back() == '-') id.pop_back();
    return id;
}

bool is_absent(const Node& node) { return node.kind == Node::Kind::scalar && node.text.empty(); }

/// " `−` is U+2212 (minus sign), not `-`." for a text with such a character.
std::string named_look_alike(std::string_view text) {
    const std::optional<text::LookAlike> found = text::find_look_alike(text);
    if (!found) return {};
    std::string named = about(*found);
    if (named[0] == 'i') named[0] = 'I';
    return " " + named + ".";
}

bool is_version(std::string_view text) {
    int dots = 0;
    char before = '.';
    for (const char c : text) {
        if (c == '.' && before == '.') return false;
        if (c == '.')
            ++dots;
        else if (c < '0' || c > '9')
            return false;
        before = c;
    }
    return dots == 2 && before != '.' && text.size() <= 32;
}

/// Returns the words with which text::recognise() names a kind of document; empty for an unknown one.
std::string kind_in_words(std::string_view kind) {
    return kind == "Procedure" ? "a procedure"
           : kind == "Anatomy" ? "an anatomy"
           : kind == "Station" ? "a station"
                               : "";
}

/// Returns whether a map has none of its own keys, and a key of another map: all of it is in the wrong section.
bool is_misplaced(const Node& map, const Shape& shape, const Report& report) {
    if (report.whole() == nullptr || report.whole() == &shape || map.children.empty()) return false;
    const auto is_known = [&](const Node& child) { return shape.find(child.key) != nullptr; };
    const auto is_elsewhere = [&](const Node& child) { return !homes_of(child.key, *report.whole(), shape).empty(); };
    const std::vector<Node>& keys = map.children;
    return std::none_of(keys.begin(), keys.end(), is_known) && std::any_of(keys.begin(), keys.end(), is_elsewhere);
}

std::string got(std::string_view text) { return "got `" + text::excerpt(text, 40) + "`"; }

}  // namespace

void refuse_key(const Node& child, const Node& map, const Shape& shape, const std::string& meant, Report& report,
                const std::string& under) {
    std::vector<std::string> known, choices;
    bool is_chosen = false;
    for (const KeyShape& key : shape.keys) {
        (key.presence == Presence::one_of ? choices : known).push_back(key.name);
        is_chosen = is_chosen || (key.presence == Presence::one_of && map.find(key.name) != nullptr);
    }
    // Where one of several keys is needed, an unknown one is most likely meant as one of them.
    const bool is_choice = meant.empty() && !choices.empty() && !is_chosen;
    if (is_choice || (!is_chosen && !choices.empty())) known.insert(known.begin(), choices.begin(), choices.end());
    if (is_choice) known = choices;
    const KeyAdvice home = meant.empty() ? advice_for(child, shape, under, report) : KeyAdvice{};
    const bool is_list_short = known.size() <= max_listed && !is_choice;
    const std::string expected = known.empty()                        ? "; no key is allowed here."
                                 : home.text.empty() || is_list_short ? ": expected " + listed(known, child.key) + "."
                                                                      : " here.";
    report.error(
        text::Code::unknown_key, child.key_span,
        "The key `" + text::excerpt(child.key, 40) + "` is unknown" + expected + named_look_alike(child.key) +
            (home.text.empty() ? or_choose(meant, is_choice ? "Write one of these." : "Remove it.") : " " + home.text),
        meant.empty() ? home.write : meant + ":");
}

bool is_kind(const Node& node, Node::Kind kind, const std::string& name, Report& report) {
    if (node.is_refused) return false;
    if (is_absent(node)) {
        report.error(text::Code::empty_value, node.span,
                     name + " is empty, expected " + kind_name(kind) + ". Fill it, or remove it.");
        return false;
    }
    if (node.kind == kind) return true;
    if (const auto mistake = kind == Node::Kind::scalar || node.kind != Node::Kind::scalar || node.is_quoted
                                 ? std::nullopt
                             : kind == Node::Kind::map ? find_missing_space(node.text)
                                                       : find_missing_dash_space(node.text)) {
        report.error(text::Code::syntax, node.span, mistake->message, mistake->write);
        return false;
    }
    report.error(text::Code::wrong_shape, node.span,
                 name + " has the wrong form: got " + kind_name(node.kind) + ", expected " + kind_name(kind) + ". " +
                     way_to(kind));
    return false;
}

std::optional<std::string> read_text(const Node& node, const std::string& name, Report& report) {
    if (!is_kind(node, Node::Kind::scalar, name, report)) return std::nullopt;
    return node.text;
}

std::optional<std::string> read_words(const Node& node, const std::string& name, Report& report) {
    if (node.kind != Node::Kind::map) return read_text(node, name, report);
    std::optional<std::string> first;
    for (const Node& child : node.children) {
        if (!text::is_language_code(child.key))
            report.error(text::Code::malformed_word, child.key_span,
                         "A language of " + name + " is unknown: " + got(child.key) +
                             ", expected a code such as `en` or `pt-BR`. Write the code of ISO 639.");
        const std::optional<std::string> text = read_text(child, name + "." + child.key, report);
        if (&child == &node.children.front()) first = text;
    }
    if (node.children.empty())
        report.error(text::Code::empty_value, node.span, name + " is an empty map. Write a text, or `en: text`.");
    return first;
}

std::optional<std::string> read_id(const Node& node, const std::string& name, Report& report) {
    std::optional<std::string> text = read_text(node, name, report);
    if (text && !is_id(*text)) {
        report.error(text::Code::malformed_word, node.span,
                     name + " is not a name: " + got(*text) +
                         ", expected one word of at most 64 letters, digits, `.`, `_` and `-`, a letter or digit "
                         "first." +
                         named_look_alike(*text) + (id_of(*text).empty() ? " Choose one." : ""),
                     id_of(*text));
        return std::nullopt;
    }
    return text;
}

std::optional<bool> read_yes_no(const Node& node, const std::string& name, Report& report) {
    const std::optional<std::string> text = read_text(node, name, report);
    if (!text) return std::nullopt;
    if (*text == "true" || *text == "false") return *text == "true";
    const bool is_yes =
        *text == "yes" || *text == "on" || *text == "y" || *text == "True" || *text == "TRUE" || *text == "1";
    const bool is_no =
        *text == "no" || *text == "off" || *text == "n" || *text == "False" || *text == "FALSE" || *text == "0";
    const std::string meant = is_yes ? "true" : is_no ? "false" : "";
    report.error(text::Code::unknown_word, node.span,
                 name + " is unknown: " + got(*text) + ", expected `true` or `false`." + named_look_alike(*text) +
                     or_choose(meant, "Write one of the two."),
                 meant);
    return std::nullopt;
}

std::optional<double> read_quantity(const Node& node, const std::string& name, const text::QuantityNeed& need,
                                    Report& report, std::optional<text::Reason> declared) {
    const std::optional<std::string> text = read_text(node, name, report);
    if (!text) return std::nullopt;
    text::Parsed<double> parsed = text::parse_quantity(*text, name, need);
    if (parsed.problem.code != text::Code::out_of_range) declared.reset();
    if (!parsed.value)
        report.error(parsed.problem.code, node.span, parsed.problem.message, parsed.problem.write, std::move(declared));
    return parsed.value;
}

std::optional<Vec3> read_vector(const Node& node, const std::string& name, const text::QuantityNeed& need,
                                Report& report) {
    if (node.kind == Node::Kind::list) {
        if (node.children.size() != 3) {
            report.error(text::Code::not_three_numbers, node.span,
                         name + " is not three numbers: got a list of " + std::to_string(node.children.size()) +
                             ", expected x, y and z. Write three.");
            return std::nullopt;
        }
        std::array<std::optional<double>, 3> values;
        for (std::size_t i = 0; i < 3; ++i) values[i] = read_quantity(node.children[i], name, need, report);
        if (!values[0] || !values[1] || !values[2]) return std::nullopt;
        return Vec3{*values[0], *values[1], *values[2]};
    }
    const std::optional<std::string> text = read_text(node, name, report);
    if (!text) return std::nullopt;
    text::Parsed<Vec3> parsed = text::parse_vector(*text, name, need);
    if (!parsed.value) report.error(parsed.problem.code, node.span, parsed.problem.message, parsed.problem.write);
    return parsed.value;
}

std::string read_path(const Node& node, const std::string& name, const std::string& where, Report& report) {
    const std::optional<std::string> text = read_text(node, name, report);
    if (!text) return {};
    const std::filesystem::path path = std::filesystem::path(*text).lexically_normal();
    const bool has_drive = text->find(':') != std::string::npos || text->find('\\') != std::string::npos;
    if (!path.is_absolute() && !has_drive && (path.empty() || *path.begin() != "..")) return path.generic_string();
    report.error(text::Code::path_outside, node.span,
                 name + " leads outside: " + got(*text) + ", expected a path inside " + where +
                     ", with `/` between folders. Put the file there, and write its path from there.");
    return {};
}

const std::vector<Node>& read_list(const Node& node, const std::string& name, Report& report) {
    static const std::vector<Node> none;
    if (!is_kind(node, Node::Kind::list, name, report)) return none;
    if (node.children.empty())
        report.error(text::Code::empty_value, node.span, name + " is an empty list. Add an item, or remove it.");
    return node.children;
}

std::vector<std::string> read_ids(const Node& node, const std::string& name, Report& report) {
    std::vector<std::string> ids;
    UniqueIds unique("name");
    for (const Node& item : read_list(node, name, report))
        if (const std::optional<std::string> id = read_id(item, "A name in " + name, report))
            if (unique.add(*id, item.span, report)) ids.push_back(*id);
    return ids;
}

bool read_key(const Node& child, const std::string& name, Report& report) {
    Node key;
    key.text = child.key;
    key.span = child.key_span;
    return read_id(key, name, report).has_value();
}

bool UniqueIds::add(const std::string& id, TextSpan span, Report& report) {
    const auto [first, is_new] = ids_.try_emplace(id, span);
    if (is_new) return true;
    report.error(text::Code::duplicate_id, span,
                 "The " + sort_ + " `" + id + "` is there twice. Give this one another name.", {},
                 report.because(first->second, "the first one is here."));
    return false;
}

std::string item_name(const Node& item, const std::string& sort) {
    const Node* id = item.find("id");
    return id && id->kind == Node::Kind::scalar && is_id(id->text) ? id->text : sort;
}

bool read_header(MapReader& document, const std::string& kind, Report& report) {
    constexpr const char* api_version = "kerf/v1";
    bool is_right = document.is_map();
    if (const Node* node = document.required("apiVersion"))
        if (const auto text = read_text(*node, "apiVersion", report); text && *text != api_version) {
            report.error(text::Code::wrong_api_version, node->span,
                         "The version of the format is unknown: " + got(*text) + ", expected `" + api_version + "`.",
                         api_version);
            is_right = false;
        }
    if (const Node* node = document.required("kind"))
        if (const auto text = read_text(*node, "kind", report); text && *text != kind) {
            // Only a slip of the pen is mended here; another document needs another file.
            const std::string meant = closest(*text, {kind}, report);
            const text::RecognisedFile other = text::recognise(report.file());
            report.error(text::Code::wrong_kind, node->span,
                         "The document is of another kind: " + got(*text) + ", expected `" + kind + "`." +
                             or_choose(meant, other.name == kind_in_words(*text) ? other.advice : "Name another file."),
                         meant);
            is_right = false;
        }
    return is_right;
}

MapReader::MapReader(const Node& node, const Shape& shape, std::string name, Report& report)
    : node_(node),
      shape_(shape),
      name_(std::move(name)),
      report_(report),
      span_(node.key.empty() ? node.span : node.key_span),
      is_map_(is_kind(node, Node::Kind::map, name_.empty() ? "The document" : name_, report)) {}

std::string MapReader::name_of(const std::string& key) const { return name_.empty() ? key : name_ + "." + key; }

const KeyShape& MapReader::shape_of(const std::string& key) const {
    const KeyShape* shape = shape_.find(key);
    KERF_ASSERT(shape != nullptr, ("add `" + key + "` to the shape `" + shape_.id + "` in documents").c_str());
    return *shape;
}

const Node* MapReader::ask(const std::string& key) {
    asked_.push_back(shape_of(key).name);
    return is_map_ ? node_.find(key) : nullptr;
}

const Node* MapReader::find(const std::string& key) {
    return shape_of(key).presence == Presence::required ? required(key) : ask(key);
}

const Node* MapReader::required(const std::string& key) {
    const Node* found = ask(key);
    const bool is_empty_list = found != nullptr && found->kind == Node::Kind::list && found->children.empty();
    if (found != nullptr && !found->is_refused && (is_empty_list || is_absent(*found))) {
        report_.error(text::Code::empty_value, found->span,
                      name_of(key) + (is_empty_list ? " is an empty list. Add an item" : " is empty. Fill it") +
                          ", as in `" + key + ": " + shape_of(key).example + "`.");
        return nullptr;
    }
    if (!found && is_map_ && !is_misplaced(node_, shape_, report_))
        report_.error(text::Code::missing_key, span_,
                      (name_.empty() ? "The document" : name_) + " has no `" + key + ":`. Add it, as in `" + key +
                          ": " + shape_of(key).example + "`.");
    return found;
}

std::string MapReader::text(const std::string& key) {
    const Node* found = find(key);
    return found ? read_text(*found, name_of(key), report_).value_or("") : "";
}

std::string MapReader::words(const std::string& key) {
    const Node* found = find(key);
    return found ? read_words(*found, name_of(key), report_).value_or("") : "";
}

std::string MapReader::id(const std::string& key) {
    const Node* found = find(key);
    return found ? read_id(*found, name_of(key), report_).value_or("") : "";
}

std::vector<std::string> MapReader::ids(const std::string& key) {
    const Node* found = find(key);
    return found ? read_ids(*found, name_of(key), report_) : std::vector<std::string>{};
}

std::string MapReader::word(const std::string& key) {
    const Node* found = find(key);
    const std::string word = found ? read_text(*found, name_of(key), report_).value_or("") : "";
    const std::vector<std::string>& words = shape_of(key).value.words;
    if (word.empty() || std::find(words.begin(), words.end(), word) != words.end()) return word;
    const std::string meant = closest(text::straightened(word), words, report_);
    report_.error(text::Code::unknown_word, found->span,
                  name_of(key) + " is unknown: " + got(word) + ", expected " + listed(words, word) + "." +
                      named_look_alike(word) + or_choose(meant),
                  meant);
    return {};
}

std::string MapReader::version(const std::string& key) {
    const Node* found = find(key);
    const std::string text = found ? read_text(*found, name_of(key), report_).value_or("") : "";
    if (!text.empty() && !is_version(text))
        report_.error(text::Code::malformed_word, found->span,
                      name_of(key) + " is no version: got `" + text::excerpt(text, 40) +
                          "`, expected three numbers, as in `0.1.0`. Write three.");
    return text;
}

std::string MapReader::data_path(const std::string& key) {
    const Node* found = find(key);
    return found ? read_path(*found, name_of(key), "the document's own folder or KERF_DATA", report_) : "";
}

bool MapReader::yes_no(const std::string& key) {
    const Node* found = find(key);
    return found && read_yes_no(*found, name_of(key), report_).value_or(false);
}

double MapReader::quantity(const std::string& key) {
    double value = need_of(key).min;
    quantity(key, value);
    return value;
}

void MapReader::quantity(const std::string& key, double& value) {
    if (const Node* found = find(key))
        value = read_quantity(*found, name_of(key), need_of(key), report_).value_or(value);
}

void MapReader::labels(const std::string& key, std::vector<int>& numbers, std::vector<std::string>& names) {
    const Node* found = find(key);
    if (!found) return;
    const text::QuantityNeed& need = shape_of(key).value.item.front().need;
    for (const Node& item : read_list(*found, name_of(key), report_)) {
        const std::string name = "A label in " + name_of(key);
        const bool is_number = item.text.find_first_not_of("+-.0123456789") == std::string::npos;
        if (item.kind == Node::Kind::scalar && !is_number) {
            names.push_back(item.text);
            continue;
        }
        const std::optional<double> value = read_quantity(item, name, need, report_);
        if (!value) continue;
        if (*value == std::floor(*value))
            numbers.push_back(static_cast<int>(*value));
        else
            report_.error(text::Code::not_a_number, item.span,
                          name + " is not a whole number: " + got(item.text) + ". Remove the fraction.");
    }
}

std::optional<Vec3> MapReader::vector(const std::string& key) {
    const Node* found = find(key);
    return found ? read_vector(*found, name_of(key), need_of(key), report_) : std::nullopt;
}

const Node* MapReader::one_of() {
    const Node* found = nullptr;
    std::vector<std::string> keys;
    for (const KeyShape& key : shape_.keys) {
        if (key.presence != Presence::one_of) continue;
        keys.push_back(key.name);
        const Node* candidate = ask(key.name);
        if (candidate && found) {
            report_.error(text::Code::one_of, candidate->key_span,
                          (name_.empty() ? "The document" : name_) + " has both `" + found->key + "` and `" + key.name +
                              "`, expected one of them. Remove one.",
                          {}, report_.because(found->key_span, "the other one is here."));
        } else if (candidate) {
            found = candidate;
        }
    }
    const bool has_unknown = std::any_of(node_.children.begin(), node_.children.end(),
                                         [&](const Node& child) { return shape_.find(child.key) == nullptr; });
    if (!found && is_map_ && !has_unknown)  // an unknown key was most likely meant as one of them: finish() reports it
        report_.error(text::Code::one_of, span_,
                      (name_.empty() ? "The document" : name_) + " has none of " + listed(keys) + ". Add one of them.");
    return found;
}

void MapReader::expect_under(const std::string& under, const std::vector<std::string>& keys) {
    for (const std::string& key : keys) under_.try_emplace(key, under);
}

void MapReader::finish() {
    for (const KeyShape& key : shape_.keys)
        KERF_ASSERT(std::find(asked_.begin(), asked_.end(), key.name) != asked_.end(),
                    ("read `" + key.name + "`, or remove it from the shape `" + shape_.id + "` in documents").c_str());
    if (!is_map_) return;
    const bool is_one_mistake = is_misplaced(node_, shape_, report_);
    for (const Node& child : node_.children)
        if (shape_.find(child.key) == nullptr && !(is_one_mistake && &child != &node_.children.front())) {
            const auto under = under_.find(child.key);
            refuse_key(child, node_, shape_, "", report_, under != under_.end() ? under->second : "");
        }
}

}  // namespace kerf::documents
