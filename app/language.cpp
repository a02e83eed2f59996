// SPDX-License-Identifier: Apache-2.0
#include "app/language.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "text/language_code.h"
#include "text/printable.h"

namespace kerf::app {

std::string language_of_locale(const std::string& locale) {
    std::string language = locale.substr(0, locale.find_first_of(".@"));
    std::replace(language.begin(), language.end(), '_', '-');
    return language == "C" || language == "POSIX" ? "" : language;
}

std::string language_for(const std::string& chosen) {
    if (!chosen.empty()) return chosen;
    for (const char* name : {"LC_ALL", "LC_MESSAGES", "LANG"})  // in the order of POSIX
        if (const char* locale = std::getenv(name); locale != nullptr && *locale != '\0')
            return language_of_locale(locale);
    return {};
}

std::string note_of_language(const std::string& chosen, const documents::Translations& translations) {
    const std::vector<std::string> languages = translations.languages();
    const auto has = [&](const std::string& language) {
        return std::find(languages.begin(), languages.end(), language) != languages.end();
    };
    if (chosen.empty() || has(chosen) || has(chosen.substr(0, chosen.find('-')))) return {};
    std::string list;
    for (const std::string& language : languages) list += (list.empty() ? "" : ", ") + language;
    return "the procedure has no words in `" + text::excerpt(chosen, 40) + "`" +
           (list.empty() ? "" : ", but in " + list) + "; its first language is shown";
}

std::string refusal_of_language(const std::string& chosen) {
    if (chosen.empty() || text::is_language_code(chosen)) return {};
    const std::string meant = language_of_locale(chosen);
    return "`--language` is `" + text::excerpt(chosen, 40) + "`, expected a code such as `en` or `pt-BR`. Write " +
           (text::is_language_code(meant) ? "`--language " + meant + "`." : "the code of ISO 639.");
}

}  // namespace kerf::app
