// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "documents/yaml/document.h"
#include "documents/yaml/shape.h"
#include "text/quantity.h"

/// Reading one map of a document, and its values. A function that returns no value has reported the reason.
namespace kerf::documents {

/// The candidate nearest to `word`; empty if none is near, if several are equally near, or if the report is full and
/// shows no more. The last parts of a name with dots or slashes count as the name.
std::string closest(std::string_view word, const std::vector<std::string>& candidates, const Report& report);
std::string closest(std::string_view word, const std::vector<std::string>& candidates);  // [any]

/// Returns whether one or more of the candidates are near to `word`.   [any]
bool is_near_any(std::string_view word, const std::vector<std::string>& candidates);

/// Returns the advice behind a list of candidates; nothing if `meant` is suggested.   [any]
std::string or_choose(const std::string& meant, const std::string& advice = "Write one of these.");

/// Returns "`a`, `b` or `c`"; of many words the first ones and the number of others. With `like`, the word that was
/// written instead, these are the words most like it.   [any]
std::string listed(const std::vector<std::string>& words, std::string_view like = {});

/// Returns "Write `a`.", the known name nearest to `word`; "Write `a`, `b` or `c`." if none is
/// near.   [any]
std::string write_instead(std::string_view word, const std::vector<std::string>& known);

/// Returns the words, those that resemble `like` first, the others in their order.   [any]
std::vector<std::string> nearest_first(std::vector<std::string> words, std::string_view like);

/// A name that must be one of a few, and is not.
struct UnknownName {
    text::Code code{};
    TextSpan span{};
    std::string subject;  ///< "The step `drill`"
    std::string word;     ///< as written; the closest name is searched for it
    std::vector<std::string> known;
    std::string if_none{};                       ///< ends the message if there are none
    std::string of{};                            ///< behind the list: " of example.drilling"
    std::string advice = "Write one of these.";  ///< where no name is close
    std::optional<text::Reason> reason{};
    bool is_key = false;  ///< the closest name is shown with a colon
};
/// Reports "SUBJECT is unknown: expected A, B or C. Write one of these."
void refuse_unknown(UnknownName name, Report& report);

/// Reports a key that its map does not have.
/// @param meant   the key to write; empty: none is close
/// @param under   the key of this map that it belongs under; empty: another map of the document may have it
void refuse_key(const Node& child, const Node& map, const Shape& shape, const std::string& meant, Report& report,
                const std::string& under = {});

std::optional<std::string> read_text(const Node& node, const std::string& name, Report& report);
/// Letters, digits, `.`, `_` and `-`, a letter or digit first.
std::optional<std::string> read_id(const Node& node, const std::string& name, Report& report);
/// `true` or `false`, no other spelling.
std::optional<bool> read_yes_no(const Node& node, const std::string& name, Report& report);
/// `declared` is shown with a value out of range.
std::optional<double> read_quantity(const Node& node, const std::string& name, const text::QuantityNeed& need,
                                    Report& report, std::optional<text::Reason> declared = {});
/// `3.0 193.0 -60.5 mm`, or a list of three quantities.
std::optional<Vec3> read_vector(const Node& node, const std::string& name, const text::QuantityNeed& need,
                                Report& report);
/// A path that stays inside `where` ("the document's own folder"); empty when it does not.
std::string read_path(const Node& node, const std::string& name, const std::string& where, Report& report);
/// The items of a list that must not be empty; none when it is no list.
const std::vector<Node>& read_list(const Node& node, const std::string& name, Report& report);
/// Words for people: a text, or a map of languages to texts. Returns those of the first language.
std::optional<std::string> read_words(const Node& node, const std::string& name, Report& report);
/// A list of ids, none twice.
std::vector<std::string> read_ids(const Node& node, const std::string& name, Report& report);

/// Checks a key that the author of the document chooses. Returns false if it is no id.
bool read_key(const Node& child, const std::string& name, Report& report);

/// Returns the name of an item of a list in messages: its id, or else `sort` ("part").
std::string item_name(const Node& item, const std::string& sort);

class MapReader;

/// Checks `apiVersion` and `kind`. Returns false for another kind of document, whose other keys have no meaning here.
bool read_header(MapReader& document, const std::string& kind, Report& report);

/// Returns whether a node is of this kind. Reports one that is not, unless it was refused already.
bool is_kind(const Node& node, Node::Kind kind, const std::string& name, Report& report);

/// Ids that must differ.
class UniqueIds {
public:
    /// @param sort   of what the ids name, for messages: "step"
    explicit UniqueIds(std::string sort) : sort_(std::move(sort)) {}
    /// Reports an `id` that is there already, and returns false.
    bool add(const std::string& id, TextSpan span, Report& report);
    /// Adds the id of an item of a list, if it has one.
    void add_own(const std::string& id, const Node& item, Report& report) {
        if (const Node* written = item.find("id"); written != nullptr && !id.empty()) add(id, written->span, report);
    }

private:
    std::string sort_;
    std::map<std::string, TextSpan> ids_;
};

/// Reads one map by its shape: its keys, which of them are required, and their values. To read a key that the shape
/// does not have, or to finish before all keys are read, is an error of the programmer.
class MapReader {
public:
    /// Reports a node that is no map, and reads it as an empty map.
    /// @param name   of the map in messages
    MapReader(const Node& node, const Shape& shape, std::string name, Report& report);

    const Node* find(const std::string& key);  ///< reports that it is missing if the shape requires it
    const Node* required(
        const std::string& key);  ///< reports that it is missing, even if the shape does not require it

    // Nothing, or the value before, when the key is absent or wrong.
    std::string text(const std::string& key);
    std::string words(const std::string& key);  ///< of a map of languages: those of the first one
    std::string id(const std::string& key);
    std::vector<std::string> ids(const std::string& key);  ///< a list, none twice
    std::string word(const std::string& key);              ///< one of the shape's words
    bool yes_no(const std::string& key);
    std::string version(const std::string& key);    ///< three numbers
    std::string data_path(const std::string& key);  ///< in the document's folder or in KERF_DATA
    double quantity(const std::string& key);        ///< the least that is allowed when absent or wrong
    void quantity(const std::string& key, double& value);
    /// Reads a list of labels: numbers and names.
    void labels(const std::string& key, std::vector<int>& numbers, std::vector<std::string>& names);
    std::optional<Vec3> vector(const std::string& key);

    /// Returns the node of the one key that is present of those that exclude each other. Reports none or several.
    const Node* one_of();

    /// Records that keys which the shape lacks belong under its key `under`, for finish().
    void expect_under(const std::string& under, const std::vector<std::string>& keys);

    /// Reports every key that the shape lacks.
    void finish();

    bool is_map() const noexcept { return is_map_; }
    TextSpan span() const noexcept { return span_; }
    Report& report() const noexcept { return report_; }
    const KeyShape& shape_of(const std::string& key) const;
    std::string name_of(const std::string& key) const;
    const text::QuantityNeed& need_of(const std::string& key) const { return shape_of(key).value.need; }
    const text::QuantityNeed& item_need_of(const std::string& key) const {
        return shape_of(key).value.item.front().need;
    }

private:
    const Node* ask(const std::string& key);

    const Node& node_;
    const Shape& shape_;
    std::string name_;
    Report& report_;
    TextSpan span_;  ///< where to point at what is missing
    bool is_map_;
    std::vector<std::string> asked_;
    std::map<std::string, std::string> under_;  ///< for keys that the shape lacks: the key that they belong under
};

}  // namespace kerf::documents
