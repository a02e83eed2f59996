// SPDX-License-Identifier: Apache-2.0
#include "core/field/cut/cut_history.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace kerf {
namespace {

CutHistory with(CutHistory history, std::uint64_t first, std::uint64_t count) {
    for (std::uint64_t n = 0; n < count; ++n) {
        CutRecord record;
        record.sequence = first + n;
        history.push(record);
    }
    return history;
}
std::vector<std::uint64_t> sequences(const std::vector<CutRecord>& records) {
    std::vector<std::uint64_t> all;
    for (const CutRecord& record : records) all.push_back(record.sequence);
    return all;
}

TEST(CutHistory, GivesItsRecordsInOrder) {
    const CutHistory history = with({}, 0, 3);
    EXPECT_EQ(sequences(history.records()), (std::vector<std::uint64_t>{0, 1, 2}));
    EXPECT_EQ(sequences(with(history, 7, 2).records_after(history)), (std::vector<std::uint64_t>{7, 8}));
    EXPECT_TRUE(history.records_after(history).empty());
}

TEST(CutHistory, ContinuesWhatItGrewFromAndNothingElse) {
    const CutHistory trunk = with({}, 0, 3), one = with(trunk, 3, 2), other = with(trunk, 3, 2);
    EXPECT_TRUE(one.continues(trunk));
    EXPECT_TRUE(one.continues(one));
    EXPECT_TRUE(one.continues({}));
    EXPECT_FALSE(trunk.continues(one));
    EXPECT_FALSE(one.continues(other)) << "equal records of another piece are another history";
    EXPECT_FALSE(with({}, 0, 5).continues(trunk));
}

TEST(CutHistory, FindsWhatTwoBeginWith) {
    const CutHistory trunk = with({}, 0, 3), one = with(trunk, 3, 2), other = with(trunk, 9, 4);
    EXPECT_TRUE(one.common_with(other) == trunk);
    EXPECT_TRUE(other.common_with(one) == trunk);
    EXPECT_TRUE(trunk.common_with(one) == trunk);
    EXPECT_TRUE(one.common_with(one) == one);
    EXPECT_EQ(one.common_with(with({}, 0, 5)).count(), 0u);
    EXPECT_EQ(one.common_with({}).count(), 0u);
}

TEST(CutHistory, OfAMillionRecordsIsFreedWithoutDeepRecursion) {
    CutHistory shared;
    {
        const CutHistory history = with({}, 0, 1'000'000);
        shared = history;
    }
    EXPECT_EQ(shared.count(), 1'000'000u);
    shared = {};
    EXPECT_EQ(shared.count(), 0u);
}

}  // namespace
}  // namespace kerf
