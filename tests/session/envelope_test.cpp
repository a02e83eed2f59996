// SPDX-License-Identifier: Apache-2.0
#include "session/envelope.h"

#include <gtest/gtest.h>

#include <ctime>
#include <regex>
#include <set>
#include <string>

namespace kerf::session {
namespace {

TEST(Envelope, AUuidIsRandomAndSaysSo) {
    const std::regex version_4("[0-9a-f]{8}-[0-9a-f]{4}-4[0-9a-f]{3}-[89ab][0-9a-f]{3}-[0-9a-f]{12}");
    std::set<std::string> seen;
    for (int i = 0; i < 100; ++i) {
        const std::string uuid = random_uuid();
        EXPECT_TRUE(std::regex_match(uuid, version_4)) << uuid;
        EXPECT_TRUE(seen.insert(uuid).second) << uuid;
    }
}

TEST(Envelope, TheTimeIsUtcWhateverTheMachineSays) {
    setenv("TZ", "Pacific/Auckland", 1);
    tzset();
    const std::string before = utc_now();
    const std::time_t now = std::time(nullptr);
    unsetenv("TZ");
    tzset();
    std::tm read{};
    ASSERT_NE(strptime(before.c_str(), "%Y-%m-%dT%H:%M:%SZ", &read), nullptr) << before;
    EXPECT_NEAR(static_cast<double>(timegm(&read)), static_cast<double>(now), 2.0 /* s */);
}

}  // namespace
}  // namespace kerf::session
