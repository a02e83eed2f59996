// SPDX-License-Identifier: Apache-2.0
#include "session/report/recorded_procedure.h"

#include <charconv>
#include <cmath>
#include <cstddef>
#include <system_error>

#include "core/plugin/unit.h"
#include "documents/yaml/document.h"

namespace kerf::session {
namespace {

constexpr std::size_t longest_text = 1'000'000;  ///< [bytes] same as for a procedure's file

/// Returns a text; of one in several languages, that in the first.
std::string text_of(const documents::Node& map, std::string_view key) {
    const documents::Node* value = map.find(key);
    if (value != nullptr && value->kind == documents::Node::Kind::map && !value->children.empty())
        value = &value->children.front();
    return value != nullptr && value->kind == documents::Node::Kind::scalar ? value->text : std::string();
}

/// Returns the children of a list or map; none if the key is missing.
const std::vector<documents::Node>& children_of(const documents::Node& map, std::string_view key) {
    static const std::vector<documents::Node> none;
    const documents::Node* found = map.find(key);
    return found != nullptr ? found->children : none;
}

/// Returns the value of "3.2 mm" in SI. The text was checked when it was run, so its unit needs no check here.
/// @param unit   set to the unit; unchanged if there is none
std::optional<double> quantity_of(const documents::Node& map, std::string_view key, std::string& unit) {
    const std::string text = text_of(map, key);
    double number = 0.0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (failure != std::errc{} || !std::isfinite(number)) return std::nullopt;
    const std::size_t unit_at = text.find_first_not_of(' ', static_cast<std::size_t>(end - text.data()));
    if (unit_at == std::string::npos) return number;
    const std::optional<Unit> parsed = parse_unit(std::string_view(text).substr(unit_at));
    if (!parsed) return std::nullopt;
    unit = text.substr(unit_at);
    return number * parsed->factor;
}

/// Returns the demand of `{depth: {at_least: 30 mm}}`. A limit also has a `reason:` key.
std::optional<RecordedDemand> demand_of(const documents::Node& item) {
    for (const documents::Node& quantity : item.children) {
        if (quantity.kind != documents::Node::Kind::map || quantity.key.empty() || quantity.key == "reason") continue;
        RecordedDemand demand;
        demand.quantity = quantity.key;
        demand.of = text_of(quantity, demand.quantity == "signal"    ? "id"
                                      : demand.quantity == "measure" ? "of"
                                                                     : "zone");
        demand.at_least = quantity_of(quantity, "at_least", demand.unit);
        demand.at_most = quantity_of(quantity, "at_most", demand.unit);
        std::string unit_of_diameter;
        demand.diameter = quantity_of(quantity, "diameter", unit_of_diameter);
        demand.reason = text_of(item, "reason");
        return demand;
    }
    return std::nullopt;
}

std::vector<RecordedDemand> demands_of(const documents::Node& step, std::string_view key) {
    std::vector<RecordedDemand> demands;
    for (const documents::Node& item : children_of(step, key))
        if (auto demand = demand_of(item)) demands.push_back(std::move(*demand));
    return demands;
}

}  // namespace

RecordedProcedure recorded_procedure(const std::string& text, std::string_view rehearsal) {
    RecordedProcedure procedure;
    if (text.empty() || text.size() > longest_text) return procedure;
    const text::Result<documents::Document> document = documents::parse_document("", text);
    if (!document) return procedure;
    const documents::Node& root = document->root;
    if (const documents::Node* metadata = root.find("metadata")) procedure.title = text_of(*metadata, "title");
    for (const documents::Node& one : children_of(root, "rehearsals"))
        if (!rehearsal.empty() && text_of(one, "id") == rehearsal) procedure.rehearsal_title = text_of(one, "title");
    for (const documents::Node& step : children_of(root, "steps"))
        procedure.steps.push_back({text_of(step, "id"), text_of(step, "title"), text_of(step, "instrument"),
                                   demands_of(step, "goals"), demands_of(step, "limits")});
    for (const documents::Node& one : children_of(root, "instruments")) {
        RecordedInstrument instrument{one.key};
        std::string unit;
        if (const documents::Node* parameters = one.find("parameters"))
            instrument.diameter = quantity_of(*parameters, "diameter", unit);
        procedure.instruments.push_back(std::move(instrument));
    }
    return procedure;
}

}  // namespace kerf::session
