// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/procedure/document.h"
#include "core/procedure/quantity.h"
#include "core/procedure/shape.h"

/// Reading one map of a document, and its values, with every complaint a person could need.
/// Each function that returns nothing has said why.
namespace kerf {

/// The candidate that `word` was probably meant to be; empty if none is near, or if the report is full and nobody will
/// see it.
std::string closest(std::string_view word, const std::vector<std::string>& candidates, const Report& report);
std::string closest(std::string_view word, const std::vector<std::string>& candidates);  // [any]

/// What to add to a message that lists what there is: empty if `meant` says already what to write.   [any]
std::string or_choose(const std::string& meant, const std::string& advice = "Write one of these.");

/// "`a`, `b` or `c`"; shortened when there are many.   [any]
std::string listed(const std::vector<std::string>& words);

std::optional<std::string> read_text(const Node& node, const std::string& name, Report& report);
/// Letters, digits, `.`, `_` and `-`, a letter or digit first.
std::optional<std::string> read_id(const Node& node, const std::string& name, Report& report);
/// `true` or `false`, no other spelling.
std::optional<bool> read_yes_no(const Node& node, const std::string& name, Report& report);
/// `declared` is shown beside a value out of range.
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

/// Checks `apiVersion` and `kind`. False if this is another sort of document: nothing else is worth saying then.
bool read_header(MapReader& document, const std::string& kind, Report& report);

/// True unless the node is of another kind, or was refused already.
bool is_kind(const Node& node, Node::Kind kind, const std::string& name, Report& report);

/// Ids that must differ.
class UniqueIds {
public:
    /// False, and said so, if `id` is there already.
    bool add(const std::string& id, TextSpan span, Report& report);

private:
    std::map<std::string, TextSpan> ids_;
};

/// One map, read by its shape: which keys there are, which of them must be there, and what they hold. Asking for a key
/// that the shape lacks, or finishing without having asked for all, is an error of the programmer.
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
