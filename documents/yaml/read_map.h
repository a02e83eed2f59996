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

/// Reading one map of a document, and its values. Each function that returns nothing has reported why.
namespace kerf {

/// The candidate nearest to `word`; empty if none is near, or if the report is full and shows no more.
std::string closest(std::string_view word, const std::vector<std::string>& candidates, const Report& report);
std::string closest(std::string_view word, const std::vector<std::string>& candidates);  // [any]

/// What to add to a message that lists candidates: empty if `meant` is what to write.   [any]
std::string or_choose(const std::string& meant, const std::string& advice = "Write one of these.");

/// "`a`, `b` or `c`"; of many the first ones and the count of the others.   [any]
std::string listed(const std::vector<std::string>& words);

/// Reports a key that its map does not have. `meant`: the key to write; empty: none is near.
void refuse_key(const Node& child, const Shape& shape, const std::string& meant, Report& report);

std::optional<std::string> read_text(const Node& node, const std::string& name, Report& report);
/// Letters, digits, `.`, `_` and `-`, a letter or digit first.
std::optional<std::string> read_id(const Node& node, const std::string& name, Report& report);
/// `true` or `false`, no other spelling.
std::optional<bool> read_yes_no(const Node& node, const std::string& name, Report& report);
/// `declared` is shown with a value out of range.
std::optional<double> read_quantity(const Node& node, const std::string& name, const QuantityNeed& need, Report& report,
                                    std::optional<Reason> declared = {});
/// `3.0 193.0 -60.5 mm`, or a list of three quantities.
std::optional<Vec3> read_vector(const Node& node, const std::string& name, const QuantityNeed& need, Report& report);
/// A path that stays inside `where` ("the document's own folder"); empty when it does not.
std::string read_path(const Node& node, const std::string& name, const std::string& where, Report& report);
/// The items of a list that must not be empty; none when it is no list.
const std::vector<Node>& read_list(const Node& node, const std::string& name, Report& report);
/// A list of ids, none twice.
std::vector<std::string> read_ids(const Node& node, const std::string& name, Report& report);

/// What messages call an item of a list: its id, or else `sort` ("part").
std::string item_name(const Node& item, const std::string& sort);

class MapReader;

/// Checks `apiVersion` and `kind`. False if this is another sort of document, whose other keys mean nothing here.
bool read_header(MapReader& document, const std::string& kind, Report& report);

/// True unless the node is of another kind, or was refused already.
bool is_kind(const Node& node, Node::Kind kind, const std::string& name, Report& report);

/// Ids that must differ.
class UniqueIds {
public:
    /// Reports an `id` that is there already, and returns false.
    bool add(const std::string& id, TextSpan span, Report& report);

private:
    std::map<std::string, TextSpan> ids_;
};

/// One map, read by its shape: which keys there are, which of them must be there, and what they hold. Reading a key
/// that the shape lacks, or finishing without having read all, is an error of the programmer.
class MapReader {
public:
    /// `name` is what messages call the map. A node that is no map is reported, and read as an empty map.
    MapReader(const Node& node, const Shape& shape, std::string name, Report& report);

    const Node* find(const std::string& key);      ///< reports that it is missing if the shape requires it
    const Node* required(const std::string& key);  ///< reports that it is missing, whatever the shape says

    // Nothing, or the value before, when the key is absent or wrong.
    std::string text(const std::string& key);
    std::string id(const std::string& key);
    std::vector<std::string> ids(const std::string& key);  ///< a list, none twice
    std::string word(const std::string& key);              ///< one of the shape's words
    bool yes_no(const std::string& key);
    double quantity(const std::string& key);  ///< the least that is allowed when absent or wrong
    void quantity(const std::string& key, double& value);
    /// A list of labels: numbers, and what is none as names.
    void labels(const std::string& key, std::vector<int>& numbers, std::vector<std::string>& names);
    std::optional<Vec3> vector(const std::string& key);

    /// The one of the shape's keys of which there must be one; reports none or several.
    const Node* one_of();

    /// Reports every key that the shape lacks.
    void finish();

    bool is_map() const noexcept { return is_map_; }
    TextSpan span() const noexcept { return span_; }
    std::string name_of(const std::string& key) const;
    const QuantityNeed& need_of(const std::string& key) const { return shape_of(key).value.need; }
    const QuantityNeed& item_need_of(const std::string& key) const { return shape_of(key).value.item.front().need; }

private:
    const KeyShape& shape_of(const std::string& key) const;
    const Node* ask(const std::string& key);

    const Node& node_;
    const Shape& shape_;
    std::string name_;
    Report& report_;
    TextSpan span_;  ///< where to point at what is missing
    bool is_map_;
    std::vector<std::string> asked_;
};

}  // namespace kerf
