// SPDX-License-Identifier: Apache-2.0
#include "documents/schema.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "documents/made/make_bone.h"
#include "documents/shapes/shapes.h"
#include "documents/signal_need.h"
#include "text/quantity.h"

namespace kerf::documents {
namespace {

using Json = nlohmann::ordered_json;
using Kind = ValueShape::Kind;

// The reader takes a scalar as text, whatever an editor takes it for.
const Json scalar_types{"string", "number", "boolean"};

constexpr const char* id_pattern = "^[A-Za-z0-9][A-Za-z0-9._-]{0,63}$";
constexpr const char* language_pattern = "^[a-z]{2,3}(-[A-Z]{2})?$";
constexpr const char* path_pattern = R"(^(?!/)(?!\.\./)[^:\\]+$)";

std::string range_text(const text::QuantityNeed& need) {
    return text::quantity_text(need.min, need.unit) + " … " + text::quantity_text(need.max, need.unit);
}

Json quantity_schema(const text::QuantityNeed& need) {
    Json schema{{"type", "string"}};
    if (need.unit.empty()) schema = {{"type", {"number", "string"}}, {"minimum", need.min}, {"maximum", need.max}};
    schema["pattern"] = text::quantity_pattern(need);
    schema["patternErrorMessage"] = "Must be " + range_text(need) + ", with a unit behind the number.";
    if (need.unit.empty()) schema["patternErrorMessage"] = "Must be a plain number, " + range_text(need) + ".";
    return schema;
}

Json vector_schema(const text::QuantityNeed& need) {
    const std::string wanted = need.unit.empty() ? "three numbers, as in `0 0 1`."
                                                 : "three numbers and their unit, as in `1 2 3 " + need.unit + "`.";
    const Json in_one{
        {"type", "string"}, {"pattern", text::vector_pattern(need)}, {"patternErrorMessage", "Must be " + wanted}};
    const Json listed{{"type", "array"}, {"items", quantity_schema(need)}, {"minItems", 3}, {"maxItems", 3}};
    return {{"anyOf", {in_one, listed}}};
}

/// An example of a single value as an editor would write it; nothing for maps and lists.
Json example_of(const KeyShape& key) {
    const Kind kind = key.value.kind;
    const bool is_scalar = kind != Kind::map && kind != Kind::list && kind != Kind::named && kind != Kind::renamed &&
                           kind != Kind::parameters && kind != Kind::drives && kind != Kind::patch &&
                           kind != Kind::of_signal && kind != Kind::of_measure && kind != Kind::of_metric &&
                           !key.example.starts_with('{');
    if (!is_scalar) return nullptr;
    if (kind == Kind::yes_no) return key.example == "true";
    const bool is_plain = kind == Kind::quantity && key.value.need.unit.empty();
    const Json number = is_plain ? Json::parse(key.example, nullptr, false) : Json();
    return number.is_number() ? number : Json(key.example);
}

class SchemaWriter {
public:
    explicit SchemaWriter(const ComponentCatalog& catalog) : catalog_(catalog) {}

    Json document(const Shape& shape, const std::string& comment) {
        Json schema{{"$schema", "http://json-schema.org/draft-07/schema#"},
                    {"$comment", comment},
                    {"title", "Kerf " + shape.id}};
        schema.update(of_map(shape));
        schema["definitions"] = std::move(definitions_);
        return schema;
    }

private:
    Json reference(const Shape& shape) {
        if (!definitions_.contains(shape.id)) {
            definitions_[shape.id] = nullptr;  // against a shape within itself
            definitions_[shape.id] = of_map(shape);
        }
        return {{"$ref", "#/definitions/" + shape.id}};
    }

    Json of_map(const Shape& shape) {
        Json properties = Json::object(), required = Json::array(), groups = Json::array();
        for (const KeyShape& key : shape.keys) {
            properties[key.name] = of_key(key);
            if (key.presence == Presence::required) required.push_back(key.name);
        }
        const auto add_group = [&](Presence presence, const char* rule) {
            Json alternatives = Json::array();
            for (const KeyShape& key : shape.keys)
                if (key.presence == presence) alternatives.push_back({{"required", {key.name}}});
            if (!alternatives.empty()) groups.push_back({{rule, std::move(alternatives)}});
        };
        add_group(Presence::one_of, "oneOf");
        add_group(Presence::any_of, "anyOf");

        Json schema{{"description", shape.help},
                    {"type", "object"},
                    {"properties", std::move(properties)},
                    {"additionalProperties", false}};
        if (!required.empty()) schema["required"] = std::move(required);
        if (&shape == &shapes::instrument) add_components(schema["properties"], groups);
        if (&shape == &shapes::signal_bound || &shape == &shapes::signal_goal)
            add_signals(schema["properties"], groups);
        if (&shape == &shapes::made_bone) schema["properties"]["set"].update(of_dimensions());
        if (!groups.empty()) schema["allOf"] = std::move(groups);
        return schema;
    }

    /// The dimensions of a made bone.
    static Json of_dimensions() {
        Json properties = Json::object();
        for (const MakeRequest& bone : all_made_bones())
            for (const Dimension& dimension : bone_kind(bone.kind).population(bone).dimensions) {
                Json& of = properties[dimension.name] = {{"type", "string"}};
                of["pattern"] = text::quantity_pattern({dimension.dimension, dimension.unit});
                of["description"] = dimension.help;
            }
        return {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
    }

    Json of_key(const KeyShape& key) {
        Json schema = of_value(key.value);
        if (schema.contains("$ref")) schema = {{"allOf", {schema}}};  // draft-07 ignores the keywords next to a $ref
        schema["description"] =
            key.help + (key.value.kind == Kind::quantity ? " " + range_text(key.value.need) + "." : "");
        if (!key.fallback.empty()) {
            schema["description"].get_ref<std::string&>() += " Default: " + key.fallback + ".";
            schema["default"] = key.fallback;
        }
        if (const Json example = example_of(key); !example.is_null())
            schema["examples"] = {example};
        else
            schema["description"].get_ref<std::string&>() += " As in `" + key.example + "`.";
        return schema;
    }

    Json of_value(const ValueShape& value) {
        switch (value.kind) {
            case Kind::text:
                return {{"type", scalar_types}};
            case Kind::words: {
                const Json by_language{{"type", "object"},
                                       {"propertyNames", {{"pattern", language_pattern}}},
                                       {"additionalProperties", {{"type", scalar_types}}},
                                       {"minProperties", 1}};
                return {{"anyOf", {Json{{"type", scalar_types}}, by_language}}};
            }
            case Kind::id:
                return {{"type", scalar_types}, {"pattern", id_pattern}};
            case Kind::version:
                return {{"type", "string"}, {"pattern", R"(^[0-9]+\.[0-9]+\.[0-9]+$)"}};
            case Kind::path: {
                const Json path{{"type", "string"}, {"pattern", path_pattern}};
                return value.shape ? Json{{"anyOf", {path, reference(*value.shape)}}} : path;
            }
            case Kind::yes_no:
                return {{"enum", {true, false, "true", "false"}}};
            case Kind::word: {
                const Json words{{"enum", value.words}};
                return value.shape ? Json{{"anyOf", {words, reference(*value.shape)}}} : words;
            }
            case Kind::quantity:
                return quantity_schema(value.need);
            case Kind::label:
                return {{"type", {"number", "string"}},
                        {"multipleOf", 1},
                        {"minimum", value.need.min},
                        {"maximum", value.need.max}};
            case Kind::vector:
                return vector_schema(value.need);
            case Kind::map:
                return value.other ? Json{{"anyOf", {reference(*value.shape), reference(*value.other)}}}
                                   : reference(*value.shape);
            case Kind::list:
                return {{"type", "array"}, {"items", of_value(value.item.front())}, {"minItems", 1}};
            case Kind::named:
                return {{"type", "object"},
                        {"propertyNames", {{"pattern", id_pattern}}},
                        {"additionalProperties", of_value(value.item.front())}};
            case Kind::renamed:
                return {{"type", "object"},
                        {"additionalProperties", {{"type", scalar_types}, {"pattern", id_pattern}}}};
            case Kind::drives:
                return any_drives();
            case Kind::of_metric:
            case Kind::of_signal:
                return {{"type", {"number", "string"}}};  // `add_signals` adds the units
            case Kind::of_measure:
                return {{"anyOf",
                         {quantity_schema(shapes::angle_of_difference), quantity_schema(shapes::length_of_measure)}}};
            case Kind::parameters:
            case Kind::patch:
                break;
        }
        return {{"type", "object"}};
    }

    // ---- what plugins offer

    static void add_once(Json& list, const Json& word) {
        if (std::find(list.begin(), list.end(), word) == list.end()) list.push_back(word);
    }

    static Json component_values(const std::vector<const std::vector<ParameterInfo>*>& tables) {
        Json properties = Json::object();
        for (const auto* table : tables)
            for (const ParameterInfo& p : *table) {
                if (properties.contains(p.id)) continue;  // tool and force may share one; the reader checks it for both
                const text::QuantityNeed need{p.dimension, p.display_unit, p.min, p.max};
                Json schema = quantity_schema(need);
                schema["description"] =
                    p.help + " " + range_text(need) + "." + (p.source.empty() ? "" : " Source: " + p.source);
                schema["default"] = need.unit.empty() ? Json(p.def) : Json(text::quantity_text(p.def, need.unit));
                properties[p.id] = std::move(schema);
            }
        return {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
    }

    /// Drives of any tool; where two tools have one of the same name, the values of either.
    [[nodiscard]] Json any_drives() const {
        Json properties = Json::object();
        for (const ComponentInfo& tool : catalog_) {
            const Json values = component_values({&tool.drives});
            for (const auto& [id, schema] : values["properties"].items()) {
                if (!properties.contains(id)) properties[id] = {{"anyOf", Json::array()}};
                add_once(properties[id]["anyOf"], schema);
            }
        }
        if (properties.empty()) return {{"type", "object"}};
        return {{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
    }

    /// Of each signal the units of the laws that have one of this name.
    void add_signals(Json& properties, Json& rules) const {
        Json units = Json::object();
        for (const ComponentInfo& force : catalog_)
            for (const SignalInfo& signal : force.signals) {
                if (!units.contains(signal.id)) units[signal.id] = {{"anyOf", Json::array()}};
                add_once(units[signal.id]["anyOf"], quantity_schema(need_of(signal)));
            }
        if (units.empty()) return;
        properties["id"].erase("examples");
        for (const auto& [id, value] : units.items()) {
            properties["id"]["enum"].push_back(id);
            rules.push_back(when({{"id", id}}, {{"at_least", value}, {"at_most", value}}));
        }
    }

    static Json when(Json values, Json then) {
        Json properties = Json::object(), required = Json::array();
        for (const auto& [key, value] : values.items()) {
            properties[key] = {{"const", value}};
            required.push_back(key);
        }
        return {{"if", {{"properties", std::move(properties)}, {"required", std::move(required)}}},
                {"then", {{"properties", std::move(then)}}}};
    }

    void add_components(Json& properties, Json& rules) const {
        Json plugins = Json::array();
        Json strategies{"isosurface", "insert"};
        for (const ComponentInfo& component : catalog_) {
            if (component.kind == KERF_KIND_DEVICE) continue;
            if (component.kind != KERF_KIND_REMESHER) {
                add_once(plugins, component.plugin);
                continue;
            }
            strategies.push_back(component.full_id());
            rules.push_back(when({{"remeshing", component.full_id()}},
                                 {{"remeshing_parameters", component_values({&component.parameters})}}));
        }
        properties["remeshing"]["examples"] = std::move(strategies);
        if (plugins.empty()) return;
        for (const char* key : {"plugin", "tool", "force", "force_plugin"}) properties[key].erase("examples");
        for (const char* key : {"plugin", "force_plugin"}) properties[key]["enum"] = plugins;
        for (const Json& plugin : plugins) {
            Json tools = Json::array(), forces = Json::array();
            for (const ComponentInfo& tool : catalog_) {
                if (tool.plugin != plugin || tool.kind != KERF_KIND_TOOL) continue;
                tools.push_back(tool.id);
                rules.push_back(
                    when({{"plugin", plugin}, {"tool", tool.id}}, {{"drives", component_values({&tool.drives})}}));
                for (const ComponentInfo& force : catalog_)
                    if (force.plugin == plugin && force.kind == KERF_KIND_FORCE)
                        rules.push_back(
                            when({{"plugin", plugin}, {"tool", tool.id}, {"force", force.id}},
                                 {{"parameters", component_values({&tool.parameters, &force.parameters})}}));
            }
            for (const ComponentInfo& force : catalog_)
                if (force.plugin == plugin && force.kind == KERF_KIND_FORCE) forces.push_back(force.id);
            rules.push_back(when({{"plugin", plugin}}, {{"tool", {{"enum", tools}}}}));
            Json own = when({{"plugin", plugin}}, {{"force", {{"enum", forces}}}});
            own["if"]["not"] = {{"required", {"force_plugin"}}};
            rules.push_back(std::move(own));
            rules.push_back(when({{"force_plugin", plugin}}, {{"force", {{"enum", forces}}}}));
        }
    }

    const ComponentCatalog& catalog_;
    Json definitions_ = Json::object();
};

}  // namespace

std::string schema_text(const Shape& shape, const ComponentCatalog& catalog, const std::string& comment) {
    return SchemaWriter(catalog).document(shape, comment).dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace kerf::documents
