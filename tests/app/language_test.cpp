// SPDX-License-Identifier: Apache-2.0
#include "app/language.h"

#include <gtest/gtest.h>

namespace kerf::app {
namespace {

TEST(Language, IsThatOfALocale) {
    EXPECT_EQ(language_of_locale("de_AT.UTF-8"), "de-AT");
    EXPECT_EQ(language_of_locale("ca@valencia"), "ca");
    EXPECT_EQ(language_of_locale("en"), "en");
    EXPECT_EQ(language_of_locale("C.UTF-8"), "");
    EXPECT_EQ(language_of_locale("POSIX"), "");
    EXPECT_EQ(language_of_locale(""), "");
}

TEST(Language, NotesOneThatAProcedureLacks) {
    documents::Translations translations;
    translations.add("Hole", "de", "Loch");
    EXPECT_EQ(note_of_language("", translations), "");
    EXPECT_EQ(note_of_language("de-AT", translations), "");
    EXPECT_EQ(note_of_language("fr", translations),
              "the procedure has no words in `fr`, but in de; its first language is shown");
}

TEST(Language, IsACode) {
    EXPECT_EQ(refusal_of_language(""), "");
    EXPECT_EQ(refusal_of_language("de"), "");
    EXPECT_EQ(refusal_of_language("pt-BR"), "");
    EXPECT_EQ(refusal_of_language("german"),
              "`--language` is `german`, expected a code such as `en` or `pt-BR`. Write the code of ISO 639.");
    EXPECT_EQ(refusal_of_language("de_AT"),
              "`--language` is `de_AT`, expected a code such as `en` or `pt-BR`. Write `--language de-AT`.");
}

}  // namespace
}  // namespace kerf::app
