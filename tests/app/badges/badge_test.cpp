// SPDX-License-Identifier: Apache-2.0
#include "app/badges/badge.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "conformance/kit_version.h"
#include "text/sha256.h"

namespace kerf::app {
namespace {

Badge passed(int level, int tests) {
    return {.digest = text::sha256_of("a plugin"),
            .plugin = "example.peck 0.1.0",
            .kit = conformance::kit_version,
            .requested = level,
            .level = level,
            .tests = tests};
}

TEST(Badge, ReadsTheTextThatItWrites) {
    Badge badge = passed(4, 96);
    badge.level = 2;
    badge.failed = 3;
    badge.excluded = 1;
    std::string fault;
    EXPECT_EQ(read_badge(text_of(badge), badge.digest, fault), badge) << fault;
    badge.does_not = "resist sideways, rest on bone (burring)";
    EXPECT_EQ(read_badge(text_of(badge), badge.digest, fault), badge) << fault;
    EXPECT_NE(text_of(badge).find("For training and research"), std::string::npos);
}

TEST(Badge, RefusesADamagedText) {
    const Badge badge = passed(3, 60);
    const std::string text = text_of(badge);
    const auto with = [&](const std::string& part, const std::string& other) {
        std::string changed = text;
        EXPECT_NE(changed.find(part), std::string::npos) << part;
        return changed.replace(changed.find(part), part.size(), other);
    };
    for (const std::string& damaged :
         {std::string(), std::string("[]"), std::string("null"), std::string(4000, '['),
          text.substr(0, text.size() / 2), with("\"schema\": 1", "\"schema\": 2"), with("\"level\": 3", "\"level\": 6"),
          with("\"level\": 3", "\"level\": 3.5"), with("\"level\": 3", "\"level\": \"3\""),
          with("\"level\": 3", "\"level\": 99999999999999999999"), with("\"tests\": 60", "\"tests\": -1"),
          with("\"failed\": 0", "\"failed\": 61"), with("\"failed\": 0", "\"failed\": 1"),
          with("\"requested\": 3", "\"requested\": 2"), with(badge.digest, text::sha256_of("another")),
          with("\"plugin\": \"example.peck 0.1.0\"", "\"plugin\": 7"),
          with("\"excluded\": 0", "\"excluded\": 0, \"does_not\": 7"),
          with("\"excluded\": 0", "\"excluded\": 0, \"does_not\": \"\\u001b[31m\"")}) {
        std::string fault;
        EXPECT_FALSE(read_badge(damaged, badge.digest, fault)) << damaged;
        EXPECT_NE(fault, "") << damaged;
    }
}

TEST(Badge, IsDescribedInWords) {
    Badge badge = passed(4, 96);
    EXPECT_EQ(words_of(badge), "checked: level 4, all of 96 tests");
    badge.excluded = 2;
    EXPECT_EQ(words_of(badge), "checked: level 4, 94 of 96 tests, 2 excluded");
    badge.does_not = "rest on bone (burring)";
    EXPECT_EQ(words_of(badge), "checked: level 4, 94 of 96 tests, 2 excluded; does not rest on bone (burring)");
    badge = passed(4, 96);
    badge.level = 0;
    badge.failed = 3;
    EXPECT_EQ(words_of(badge), "checked: no level, 3 of 96 tests up to level 4 failed");
    badge = passed(4, 96);
    badge.kit = conformance::kit_version - 1;
    EXPECT_EQ(words_of(badge), "checked: level 4 of an older kit, all of 96 tests");
}

TEST(Badge, IsLoweredByAFailureAlone) {
    const Badge high = passed(4, 96), low = passed(2, 40);
    Badge failing = passed(3, 60);
    failing.level = 1;
    failing.failed = 1;
    EXPECT_EQ(kept_of(high, low), high);
    EXPECT_EQ(kept_of(low, high), high);
    EXPECT_EQ(kept_of(high, failing), failing);
    EXPECT_EQ(kept_of(failing, low), low);
    Badge of_older_kit = high;
    of_older_kit.kit -= 1;
    EXPECT_EQ(kept_of(of_older_kit, low), low);
}

}  // namespace
}  // namespace kerf::app
