// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "documents/yaml/read_map.h"

namespace kerf::documents {
namespace {

using Words = std::vector<std::string>;

TEST(Suggestion, FindsTheLastPartOfAName) {
    const Words known{"kerf.core", "kerf.drilling", "kerf.drilling/twist_drill"};
    EXPECT_EQ(closest("driling", known), "kerf.drilling");
    EXPECT_EQ(closest("twist-drill", known), "kerf.drilling/twist_drill");
    EXPECT_EQ(closest("laser", known), "");
}

TEST(Suggestion, IgnoresCapitalLetters) { EXPECT_EQ(closest("SPACING", {"force", "spacing"}), "spacing"); }

TEST(Suggestion, NeverSwapsTheSide) { EXPECT_EQ(closest("left_pedicle", {"right_pedicle"}), ""); }

TEST(Suggestion, NamesNoneOfSeveralEquallyNear) {
    const Words known{"cut-1", "cut-2", "cut-3", "waist"};
    EXPECT_EQ(closest("cut-5", known), "");
    EXPECT_TRUE(is_near_any("cut-5", known));
    EXPECT_EQ(closest("cut-22", known), "cut-2");
    EXPECT_EQ(closest("wais", {"waist", "waist"}), "waist");
}

TEST(Suggestion, KeepsMoreThanHalfOfAWord) {
    EXPECT_EQ(closest("C5", {"L4", "L5"}), "");
    EXPECT_EQ(closest("l5", {"L4", "L5"}), "L5");
}

TEST(Suggestion, ListsWordsThatResembleItFirst) {
    const Words known{"volume", "force", "spacer", "spacing"};
    EXPECT_EQ(nearest_first(known, "spacin"), (Words{"spacing", "spacer", "volume", "force"}));
    EXPECT_EQ(nearest_first(known, "xyzzy"), known);
}

TEST(Suggestion, ShowsANearWordInALongList) {
    Words known;
    for (int i = 0; i < 20; ++i) known.push_back("key" + std::string(5, static_cast<char>('a' + i)));
    known.push_back("spacing");
    EXPECT_TRUE(listed(known, "spcing").starts_with("`spacing`, `keyaaaaa`")) << listed(known, "spcing");
    EXPECT_TRUE(listed(known).starts_with("`keyaaaaa`, `keybbbbb`")) << listed(known);
}

TEST(Suggestion, WritesOneWordOrTheList) {
    EXPECT_EQ(write_instead("expret", {"expert", "medial"}), "Write `expert`.");
    EXPECT_EQ(write_instead("zzz", {"expert", "medial"}), "Write `expert` or `medial`.");
    EXPECT_EQ(write_instead("zzz", {}), "There is none.");
}

}  // namespace
}  // namespace kerf::documents
