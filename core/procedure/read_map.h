// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/procedure/document.h"
#include "core/procedure/quantity.h"

/// Reading one map of a document, and its values, with every complaint a person could need.
/// Each function that returns nothing has said why.
namespace kerf {

/// The candidate that `word` was probably meant to be; empty if none is near, or if the report is full and nobody will
/// see it.
std::string closest(std::string_view word, const std::vector<std::string>& candidates, const Report& report);
std::string closest(std::string_view word, const std::vector<std::string>& candidates);   // [any]

/// "`a`, `b` or `c`"; shortened when there are many.   [any]
std::string listed(const std::vector<std::string>& words);

std::optional<std::string> read_text(const Node& node, const std::string& name, Report& report);
/// Letters, digits, `.`, `_` and `-`, a letter or digit first.
std::optional<std::string> read_id(const Node& node, const std::string& name, Report& report);
/// `true` or `false`, no other spelling.
std::optional<bool> read_yes_no(const Node& node, const std::string& name, Report& report);
/// One of a few words.
std::optional<std::string> read_word(const Node& node, const std::string& name, const std::vector<std::string>& words,
                                     Report& report);
std::optional<double> read_quantity(const Node& node, const std::string& name, const QuantityNeed& need, Report& report);
/// `3.0 193.0 -60.5 mm`, or a list of three quantities.
std::optional<Vec3> read_vector(const Node& node, const std::string& name, const QuantityNeed& need, Report& report);
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
    std::set<std::string> ids_;
};

/// One map. Knows which keys were asked for, so that `finish()` can complain about all others.
class MapReader {
public:
    /// `name` is what messages call the map. A node that is no map is reported, and read as an empty map.
    MapReader(const Node& node, std::string name, Report& report);

    const Node* optional(const std::string& key);
    const Node* required(const std::string& key);  ///< reports that it is missing

    std::string text(const std::string& key);           ///< required
    std::string optional_text(const std::string& key);
    std::string id(const std::string& key);             ///< required
    double quantity(const std::string& key, const QuantityNeed& need);  ///< required; `need.min` when wrong
    void quantity(const std::string& key, const QuantityNeed& need, double& value);  ///< optional, unchanged when absent
    std::optional<Vec3> vector(const std::string& key, const QuantityNeed& need);  ///< required

    /// The one of several keys that is there; reports none or several.
    const Node* one_of(const std::vector<std::string>& keys);

    /// Reports every key that was not asked for.
    void finish();

    bool is_map() const noexcept { return is_map_; }
    TextSpan span() const noexcept { return span_; }
    std::string name_of(const std::string& key) const;

private:
    const Node& node_;
    std::string name_;
    Report& report_;
    TextSpan span_;  ///< where to point at what is missing
    bool is_map_;
    std::vector<std::string> known_;
};

}  // namespace kerf
