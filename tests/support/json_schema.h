// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>

/// JSON Schema, as much of draft-07 as `kerf schema` prints; any other keyword is an error of the test.
namespace kerf::test {

using Json = nlohmann::ordered_json;

/// A YAML document as an editor sees it: the scalars of YAML 1.2's core schema.
inline Json as_json(const YAML::Node& node) {
    switch (node.Type()) {
        case YAML::NodeType::Sequence: {
            Json list = Json::array();
            for (const YAML::Node& item : node) list.push_back(as_json(item));
            return list;
        }
        case YAML::NodeType::Map: {
            Json map = Json::object();
            for (const auto& entry : node) map[entry.first.Scalar()] = as_json(entry.second);
            return map;
        }
        case YAML::NodeType::Scalar:
            break;
        case YAML::NodeType::Null:
        case YAML::NodeType::Undefined:
            return nullptr;
    }
    const std::string& text = node.Scalar();
    if (node.Tag() == "!") return text;  // in quotation marks
    if (text == "true" || text == "false") return text == "true";
    static const std::regex number(R"([-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?)");
    if (!std::regex_match(text, number)) return text;
    double value = 0.0;
    const std::size_t sign = text.starts_with('+') ? 1 : 0;
    std::from_chars(text.data() + sign, text.data() + text.size(), value);
    return value;
}
inline Json as_json(const std::string& yaml) { return as_json(YAML::Load(yaml)); }

class JsonSchema {
public:
    explicit JsonSchema(const std::string& text) : root_(Json::parse(text)) {}

    /// Where `value` breaks the schema; empty if it does not.
    std::string breach(const Json& value) const { return breach(value, root_, ""); }

private:
    static bool has_match(const std::string& text, const std::string& pattern) {
        static std::map<std::string, std::regex> compiled;
        return std::regex_search(text, compiled.try_emplace(pattern, pattern).first->second);
    }

    static bool is_type(const Json& value, const std::string& type) {
        if (type == "object") return value.is_object();
        if (type == "array") return value.is_array();
        if (type == "string") return value.is_string();
        if (type == "number") return value.is_number();
        if (type == "boolean") return value.is_boolean();
        throw std::runtime_error("the schema has a type `" + type + "`");
    }

    std::size_t count(const Json& value, const Json& schemas, const std::string& at) const {
        return static_cast<std::size_t>(
            std::count_if(schemas.begin(), schemas.end(), [&](const Json& s) { return breach(value, s, at).empty(); }));
    }

    std::string breach(const Json& value, const Json& schema, const std::string& at) const {
        for (const auto& [rule, wanted] : schema.items())
            if (const std::string found = breach(value, schema, rule, wanted, at); !found.empty()) return found;
        return {};
    }

    std::string breach(const Json& value, const Json& schema, const std::string& rule, const Json& wanted,
                       const std::string& at) const {
        static const std::set<std::string> remarks{"$schema",  "$comment", "title",       "description",
                                                   "examples", "default",  "definitions", "patternErrorMessage",
                                                   "then"};
        const auto unless = [&](bool is_kept) { return is_kept ? std::string() : at + ": " + rule; };
        if (remarks.contains(rule)) return {};
        if (rule == "$ref")
            return breach(value,
                          root_["definitions"][wanted.get<std::string>().substr(std::string("#/definitions/").size())],
                          at);
        if (rule == "type")
            return unless(wanted.is_array() ? std::any_of(wanted.begin(), wanted.end(),
                                                          [&](const Json& t) { return is_type(value, t); })
                                            : is_type(value, wanted));
        if (rule == "enum") return unless(std::find(wanted.begin(), wanted.end(), value) != wanted.end());
        if (rule == "const") return unless(value == wanted);
        if (rule == "pattern")
            return unless(!value.is_string() || has_match(value.get<std::string>(), wanted.get<std::string>()));
        if (rule == "minimum") return unless(!value.is_number() || value.get<double>() >= wanted.get<double>());
        if (rule == "maximum") return unless(!value.is_number() || value.get<double>() <= wanted.get<double>());
        if (rule == "multipleOf")
            return unless(!value.is_number() || std::remainder(value.get<double>(), wanted.get<double>()) == 0.0);
        if (rule == "minItems") return unless(!value.is_array() || value.size() >= wanted.get<std::size_t>());
        if (rule == "maxItems") return unless(!value.is_array() || value.size() <= wanted.get<std::size_t>());
        if (rule == "minProperties") return unless(!value.is_object() || value.size() >= wanted.get<std::size_t>());
        if (rule == "anyOf") return unless(count(value, wanted, at) > 0);
        if (rule == "oneOf") return unless(count(value, wanted, at) == 1);
        if (rule == "allOf") {
            for (const Json& part : wanted)
                if (const std::string found = breach(value, part, at); !found.empty()) return found;
            return {};
        }
        if (rule == "not") return unless(!breach(value, wanted, at).empty());
        if (rule == "if") return breach(value, wanted, at).empty() ? breach(value, schema["then"], at) : std::string();
        if (rule == "items") {
            for (const Json& item : value.is_array() ? value : Json::array())
                if (const std::string found = breach(item, wanted, at + "[]"); !found.empty()) return found;
            return {};
        }
        if (!value.is_object()) return {};
        if (rule == "required")
            return unless(std::all_of(wanted.begin(), wanted.end(),
                                      [&](const Json& key) { return value.contains(key.get<std::string>()); }));
        for (const auto& [key, member] : value.items()) {
            std::string found;
            if (rule == "propertyNames")
                found = breach(key, wanted, at + "." + key);
            else if (rule == "properties" && wanted.contains(key))
                found = breach(member, wanted[key], at + "." + key);
            else if (rule == "additionalProperties" &&
                     !(schema.contains("properties") && schema["properties"].contains(key)))
                found = wanted.is_boolean() ? (wanted.get<bool>() ? "" : at + ": " + key)
                                            : breach(member, wanted, at + "." + key);
            if (!found.empty()) return found;
        }
        if (rule == "propertyNames" || rule == "properties" || rule == "additionalProperties") return {};
        throw std::runtime_error("the schema has a rule `" + rule + "`");
    }

    Json root_;
};

}  // namespace kerf::test
