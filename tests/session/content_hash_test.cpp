// SPDX-License-Identifier: Apache-2.0
#include "session/content_hash.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace kerf::session {
namespace {

std::uint64_t hash_of(const TickRow& row) {
    ContentHash hash;
    add_tick(hash, row);
    return hash.value();
}

TEST(ContentHash, GivesThePublishedValuesOfFnv1a) {
    EXPECT_EQ(hash_of_text(""), 0xcbf29ce484222325u);
    EXPECT_EQ(hash_of_text("a"), 0xaf63dc4c8601ec8cu);
    EXPECT_EQ(hash_of_text("foobar"), 0x85944171f73967e8u);
}

TEST(ContentHash, TakesTheLeastSignificantByteFirst) {
    ContentHash number;
    number.add(std::uint32_t{0x64636261});
    EXPECT_EQ(number.value(), hash_of_text("abcd"));
}

TEST(ContentHash, TakesANumberByItsBits) {
    ContentHash one;  // 1.0 is 3ff0000000000000
    one.add(1.0);
    EXPECT_EQ(one.value(), hash_of_text(std::string_view("\0\0\0\0\0\0\xf0\x3f", 8)));
}

TEST(ContentHash, AllNotANumbersCountAsOne) {
    ContentHash plus, minus;
    plus.add(std::numeric_limits<double>::quiet_NaN());
    minus.add(-std::numeric_limits<double>::quiet_NaN());
    EXPECT_EQ(plus.value(), minus.value());
}

TEST(ContentHash, SeesInputPoseAndWrenchOfATick) {
    const TickRow row;
    TickRow other_input, other_pose, other_wrench;
    other_input.device_from_handle.position.x = 1e-300;
    other_pose.world_from_tool.rotation.w = 1.0;
    other_wrench.modelled[5] = 1e-9;

    EXPECT_NE(hash_of(other_input), hash_of(row));
    EXPECT_NE(hash_of(other_pose), hash_of(row));
    EXPECT_NE(hash_of(other_wrench), hash_of(row));
}

/// A value, and each number that it is made of, by name.
template <class Row>
using Changes = std::vector<std::pair<std::string, std::function<void(Row&)>>>;

Changes<TickRow> changes_of_inputs_and_answers() {
    Changes<TickRow> changes{{"tick", [](TickRow& r) { ++r.tick; }}, {"step", [](TickRow& r) { ++r.step; }}};
    const std::pair<const char*, Pose TickRow::*> poses[] = {{"device_from_handle", &TickRow::device_from_handle},
                                                             {"world_from_tool", &TickRow::world_from_tool}};
    for (const auto& [name, pose] : poses) {
        for (const auto& [axis, part] : {std::pair{".x", &Vec3::x}, {".y", &Vec3::y}, {".z", &Vec3::z}})
            changes.emplace_back(std::string(name) + axis,
                                 [pose = pose, part = part](TickRow& r) { (r.*pose).position.*part += 0.5; });
        for (const auto& [axis, part] :
             {std::pair{".q.w", &Quat::w}, {".q.x", &Quat::x}, {".q.y", &Quat::y}, {".q.z", &Quat::z}})
            changes.emplace_back(std::string(name) + axis,
                                 [pose = pose, part = part](TickRow& r) { (r.*pose).rotation.*part += 0.5; });
    }
    const std::pair<const char*, Vec6 TickRow::*> wrenches[] = {{"modelled", &TickRow::modelled},
                                                                {"coupled", &TickRow::coupled}};
    for (const auto& [name, wrench] : wrenches)
        for (std::size_t i = 0; i < 6; ++i)
            changes.emplace_back(std::string(name) + std::to_string(i),
                                 [wrench = wrench, i](TickRow& r) { (r.*wrench)[i] += 0.5; });
    return changes;
}

TEST(ContentHash, SeesEachNumberOfATickAlone) {
    std::map<std::uint64_t, std::string> seen{{hash_of(TickRow{}), "nothing changed"}};
    for (const auto& [name, change] : changes_of_inputs_and_answers()) {
        TickRow row;
        change(row);
        const auto [other, is_new] = seen.emplace(hash_of(row), name);
        EXPECT_TRUE(is_new) << name << " is hashed as " << other->second;
    }
    EXPECT_EQ(seen.size(), 1u + 2u + 2u * 7u + 2u * 6u);
}

// What runs of today are compared with tomorrow: another order or another width is another hash.
TEST(ContentHash, OfATickIsAlwaysTheSame) {
    TickRow row;
    row.tick = 1;
    row.step = 2;
    row.device_from_handle = {{3, 4, 5}, {6, 7, 8, 9}};
    row.world_from_tool = {{10, 11, 12}, {13, 14, 15, 16}};
    row.modelled = {17, 18, 19, 20, 21, 22};
    row.coupled = {23, 24, 25, 26, 27, 28};

    // The bytes in the order that files rely on, by hand
    ContentHash by_hand;
    by_hand.add(std::uint64_t{1});
    by_hand.add(std::int32_t{2});
    for (int number = 3; number <= 28; ++number) by_hand.add(static_cast<double>(number));
    EXPECT_EQ(hash_of(row), by_hand.value());
    EXPECT_EQ(hex16(hash_of(row)), "b0f31a40e860fbb2");
}

TEST(ContentHash, LeavesOutWhatFollowsFromTheRest) {
    const Changes<TickRow> changes{{"time", [](TickRow& r) { r.time = 1.0; }},
                                   {"limited", [](TickRow& r) { r.limited[0] = 1.0; }},
                                   {"commanded", [](TickRow& r) { r.commanded[0] = 3.0; }},
                                   {"thrust", [](TickRow& r) { r.thrust = 1.0; }},
                                   {"torque", [](TickRow& r) { r.torque = 1.0; }},
                                   {"depth", [](TickRow& r) { r.depth = 1.0; }},
                                   {"feed_rate", [](TickRow& r) { r.feed_rate = 1.0; }},
                                   {"tissue", [](TickRow& r) { r.tissue = 1; }},
                                   {"iterations", [](TickRow& r) { r.iterations = 1; }},
                                   {"power_hand", [](TickRow& r) { r.power_hand = 1.0; }},
                                   {"power_drive", [](TickRow& r) { r.power_drive = 1.0; }},
                                   {"removed", [](TickRow& r) { r.removed = 1.0; }},
                                   {"signals", [](TickRow& r) { r.signals[0] = 1.0; }}};
    for (const auto& [name, change] : changes) {
        TickRow row;
        change(row);
        EXPECT_EQ(hash_of(row), hash_of(TickRow{})) << name;
    }
}

TEST(ContentHash, SeesWhenAndWhatHappenedAndNotItsWording) {
    const auto hash = [](const EventRow& event) {
        ContentHash one;
        add_event(one, event);
        return one.value();
    };
    const EventRow event{7, 0.5, "entered_bone", "hole"};
    EXPECT_NE(hash({8, 0.5, "entered_bone", "hole"}), hash(event));
    EXPECT_NE(hash({7, 0.5, "entered_bonf", "hole"}), hash(event));
    EXPECT_EQ(hash({7, 0.6, "entered_bone", "hole"}), hash(event));
    EXPECT_EQ(hash({7, 0.5, "entered_bone", "another"}), hash(event));
    EXPECT_EQ(hex16(hash(event)), "26ad70c70c31dc74");

    // The length comes before the text: "ab" and "c" are not "a" and "bc"
    ContentHash one, other;
    for (const char* id : {"ab", "c"}) add_event(one, {7, 0.0, id, ""});
    for (const char* id : {"a", "bc"}) add_event(other, {7, 0.0, id, ""});
    EXPECT_NE(one.value(), other.value());
}

TEST(ContentHash, TakesEachTypeByItsOwnWidth) {
    const auto hash = [](auto value) {
        ContentHash one;
        one.add(value);
        return one.value();
    };
    EXPECT_EQ(hash(std::uint8_t{0x61}), hash_of_text("a"));
    EXPECT_EQ(hash(std::int16_t{0x6261}), hash_of_text("ab"));
    EXPECT_EQ(hash(std::int16_t{-1}), hash_of_text("\xff\xff"));
    EXPECT_EQ(hash(std::int32_t{0x64636261}), hash_of_text("abcd"));
    EXPECT_EQ(hash(std::int32_t{-1}), hash_of_text("\xff\xff\xff\xff"));
    EXPECT_EQ(hash(std::uint64_t{0x6867666564636261}), hash_of_text("abcdefgh"));
    EXPECT_EQ(hash(std::int64_t{-1}), hash_of_text("\xff\xff\xff\xff\xff\xff\xff\xff"));
    EXPECT_EQ(hash(1.0f), hash_of_text(std::string_view("\0\0\x80\x3f", 4)));
    EXPECT_EQ(hash(-std::numeric_limits<float>::quiet_NaN()), hash_of_text(std::string_view("\0\0\xc0\x7f", 4)));
    EXPECT_NE(hash(0.0), hash(-0.0));
}

TEST(ContentHash, IsWrittenAsSixteenDigits) { EXPECT_EQ(hex16(0x0123456789abcdefu), "0123456789abcdef"); }

}  // namespace
}  // namespace kerf::session
