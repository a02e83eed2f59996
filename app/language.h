// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "documents/translations.h"

namespace kerf::app {

/// Returns the language for a procedure's words: the chosen one, or else that of the user's environment; empty if that
/// names none.   [main]
/// @param chosen  "de"; empty: not chosen
[[nodiscard]] std::string language_for(const std::string& chosen);

/// Returns the language of a locale: "de-AT" of "de_AT.UTF-8"; empty for "C" and "POSIX".   [any] pure.
[[nodiscard]] std::string language_of_locale(const std::string& locale);

/// Returns that a procedure has no words in the chosen language, for people; empty if it has, or if none is chosen.
[[nodiscard]] std::string note_of_language(const std::string& chosen, const documents::Translations& translations);

/// Returns why a chosen language is no code of a language, for people; empty if it is one, or if none is chosen. [any]
[[nodiscard]] std::string refusal_of_language(const std::string& chosen);

}  // namespace kerf::app
