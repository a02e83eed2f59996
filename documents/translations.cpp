// SPDX-License-Identifier: Apache-2.0
#include "documents/translations.h"

#include <utility>

#include "documents/yaml/document.h"
#include "documents/yaml/shape.h"

namespace kerf::documents {

namespace {

void add_words(const Node& node, Translations& found) {
    for (const Node& child : node.children)
        if (node.kind == Node::Kind::map && !child.text.empty() && &child != &node.children.front())
            found.add(node.children.front().text, child.key, child.text);
}

void add_map(const Node& node, const Shape& shape, Translations& found);

void add_value(const Node& node, const ValueShape& value, Translations& found) {
    using Kind = ValueShape::Kind;
    if (value.kind == Kind::words) add_words(node, found);
    if (value.shape != nullptr && node.kind == Node::Kind::map) add_map(node, *value.shape, found);
    if (value.kind == Kind::list || value.kind == Kind::named)
        for (const Node& item : node.children) add_value(item, value.item.front(), found);
}

void add_map(const Node& node, const Shape& shape, Translations& found) {
    for (const Node& child : node.children)
        if (const KeyShape* key = shape.find(child.key)) add_value(child, key->value, found);
}

}  // namespace

const std::map<std::string, std::string>* Translations::table_of(const std::string& language) const {
    auto found = by_language_.find(language);
    if (found == by_language_.end()) found = by_language_.find(language.substr(0, language.find('-')));
    return found == by_language_.end() ? nullptr : &found->second;
}

const std::string& Translations::of(const std::string& words, const std::string& language) const {
    const auto* table = table_of(language);
    const auto found = table == nullptr ? decltype(table->end()){} : table->find(words);
    return table == nullptr || found == table->end() ? words : found->second;
}

std::string Translations::within(std::string text, const std::string& language) const {
    const auto* table = table_of(language);
    if (table == nullptr) return text;
    const std::pair<const std::string, std::string>* longest = nullptr;  // of the words that the text contains
    for (const auto& one : *table)
        if (text.find(one.first) != std::string::npos &&
            (longest == nullptr || one.first.size() > longest->first.size()))
            longest = &one;
    if (longest == nullptr) return text;
    return text.replace(text.find(longest->first), longest->first.size(), longest->second);
}

std::vector<std::string> Translations::languages() const {
    std::vector<std::string> languages;
    for (const auto& [language, table] : by_language_) languages.push_back(language);
    return languages;
}

Translations translations_in(const Node& root, const Shape& shape) {
    Translations found;
    if (root.kind == Node::Kind::map) add_map(root, shape, found);
    return found;
}

}  // namespace kerf::documents
