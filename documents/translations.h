// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <vector>

namespace kerf::documents {

struct Node;
struct Shape;

/// The words of a document in other languages than its first. Results and messages have the first.
class Translations {
public:
    void add(const std::string& words, const std::string& language, std::string translated) {
        by_language_[language].emplace(words, std::move(translated));
    }
    /// Returns words of the document in a language. Without a translation into `de-AT`, returns that into `de`; without
    /// one at all, the words.
    [[nodiscard]] const std::string& of(const std::string& words, const std::string& language) const;
    /// Returns a text in which words of the document are replaced by their translations.
    [[nodiscard]] std::string within(std::string text, const std::string& language) const;
    /// Returns the languages other than the first, in alphabetical order.
    [[nodiscard]] std::vector<std::string> languages() const;

private:
    [[nodiscard]] const std::map<std::string, std::string>* table_of(const std::string& language) const;

    std::map<std::string, std::map<std::string, std::string>> by_language_;  ///< by language, then by words
};

/// Returns the translations that a document of this shape contains. Ignores values of another form.
[[nodiscard]] Translations translations_in(const Node& root, const Shape& shape);

}  // namespace kerf::documents
