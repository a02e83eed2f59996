// SPDX-License-Identifier: Apache-2.0
// The datagrams, by their bytes as docs/guide/devices.md states them.
#include "devices/udp/datagram.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace kerf::udp {
namespace {

using ByteList = std::vector<std::uint8_t>;

template <class T>
void put(ByteList& bytes, const T& value) {
    const auto* raw = reinterpret_cast<const std::uint8_t*>(&value);
    bytes.insert(bytes.end(), raw, raw + sizeof value);
}

/// A pose as the guide states it, written field by field.
ByteList pose_bytes() {
    ByteList bytes{'K', 'E', 'R', 'F', 1, 3, 88, 0};
    put(bytes, std::uint64_t{0x1122334455667788});  // session
    put(bytes, std::uint64_t{42});                  // sequence
    for (const double x : {0.01, -0.02, 0.03}) put(bytes, x);
    for (const double q : {0.6, 0.0, 0.8, 0.0}) put(bytes, q);
    put(bytes, std::uint32_t{5});
    put(bytes, std::uint32_t{0});
    return bytes;
}

kerf_device_facts some_facts() {
    return {.name = "bench rig",
            .abilities = KERF_DEVICE_POSITION | KERF_DEVICE_FORCE,
            .button_count = 2,
            .peak_force = 8.0,
            .continuous_force = 2.0,
            .peak_torque = 0.0,
            .continuous_torque = 0.0,
            .largest_stiffness = 800.0,
            .largest_damping = 5.0,
            .mass = 0.1,
            .resolution = 1e-5,
            .peak_turn_torque = 0.0,
            .continuous_turn_torque = 0.0,
            .turn_resolution = 0.0};
}

TEST(Datagram, ReadsAPoseByItsBytes) {
    DatagramFault fault{};
    const auto datagram = decode(pose_bytes(), nullptr, fault);
    ASSERT_TRUE(datagram) << text_of(fault);
    EXPECT_EQ(datagram->header.session, 0x1122334455667788u);
    EXPECT_EQ(datagram->header.sequence, 42u);
    const auto& pose = std::get<PoseReport>(datagram->content);
    EXPECT_EQ(pose.device_from_handle.position.y, -0.02);
    EXPECT_EQ(pose.device_from_handle.rotation.w, 0.6);
    EXPECT_EQ(pose.device_from_handle.rotation.y, 0.8);
    EXPECT_EQ(pose.buttons, 5u);
}

TEST(Datagram, WritesAForceByItsBytes) {
    ForceCommand force{.answered = 7, .command = {}};
    force.command.tick = 9;
    force.command.force = {1.0, 2.0, 3.0};
    force.command.device_from_tool.rotation = {1, 0, 0, 0};
    force.command.device_from_tool.position = {4.0, 5.0, 6.0};
    force.command.flags = KERF_DEVICE_RUNNING;
    Bytes bytes{};
    ASSERT_EQ(encode({.header = {.session = 1, .sequence = 2}, .content = force}, nullptr, bytes), 152u);
    const auto number_at = [&](std::size_t at, auto value) {
        std::memcpy(&value, bytes.data() + at, sizeof value);
        return value;
    };
    EXPECT_EQ(bytes[5], 4);
    EXPECT_EQ(number_at(24, std::uint64_t{}), 7u);
    EXPECT_EQ(number_at(32, std::uint64_t{}), 9u);
    EXPECT_EQ(number_at(56, double{}), 3.0);
    EXPECT_EQ(number_at(88, double{}), 4.0);
    EXPECT_EQ(number_at(112, double{}), 1.0);
    EXPECT_EQ(number_at(144, std::uint32_t{}), std::uint32_t{KERF_DEVICE_RUNNING});
}

TEST(Datagram, ReadsBackEachType) {
    const Key key{1, 2, 3};
    ForceCommand force{.answered = 1, .command = {}};
    force.command.device_from_tool.rotation.w = 1.0;
    const Content contents[] = {Hello{.name = "bench rig", .facts = some_facts()}, Welcome{1000, 20},
                                PoseReport{.device_from_handle = {{1, 2, 3}, {0, 1, 0, 0}}, .buttons = 3}, force,
                                Goodbye{}};
    for (const Key* with : {static_cast<const Key*>(nullptr), &key})
        for (const Content& content : contents) {
            Bytes bytes{}, again{};
            const std::size_t size = encode({.header = {.session = 5, .sequence = 6}, .content = content}, with, bytes);
            DatagramFault fault{};
            const auto datagram = decode({bytes.data(), size}, with, fault);
            ASSERT_TRUE(datagram) << content.index() << ": " << text_of(fault);
            EXPECT_EQ(encode(*datagram, with, again), size);
            EXPECT_EQ(bytes, again) << content.index();
        }
}

TEST(Datagram, RefusesOtherBytes) {
    const auto refusal_of = [](ByteList bytes, const Key* key = nullptr) {
        DatagramFault fault{};
        EXPECT_FALSE(decode(bytes, key, fault));
        return fault;
    };
    const auto changed = [](std::size_t at, std::uint8_t to) {
        ByteList bytes = pose_bytes();
        bytes[at] = to;
        return bytes;
    };
    EXPECT_EQ(refusal_of({}), DatagramFault::foreign);
    EXPECT_EQ(refusal_of({'K', 'E', 'R'}), DatagramFault::foreign);
    EXPECT_EQ(refusal_of(changed(0, 'k')), DatagramFault::foreign);
    EXPECT_EQ(refusal_of(changed(4, 2)), DatagramFault::version);
    EXPECT_EQ(refusal_of(changed(5, 0)), DatagramFault::type);
    EXPECT_EQ(refusal_of(changed(5, 6)), DatagramFault::type);
    EXPECT_EQ(refusal_of(changed(5, 1)), DatagramFault::size);
    EXPECT_EQ(refusal_of(changed(6, 87)), DatagramFault::size);
    const Key key{};
    EXPECT_EQ(refusal_of(pose_bytes(), &key), DatagramFault::size) << "a key needs a tag";
    for (std::size_t size = 4; size < pose_bytes().size(); ++size) {
        ByteList cut = pose_bytes();
        cut.resize(size);
        EXPECT_EQ(refusal_of(cut), DatagramFault::size) << size;
    }
    ByteList longer = pose_bytes();
    longer.push_back(0);
    EXPECT_EQ(refusal_of(longer), DatagramFault::size);
    ByteList infinite = pose_bytes(), stretched = pose_bytes();
    const double infinity = std::numeric_limits<double>::infinity(), half = 0.5;
    std::memcpy(infinite.data() + 24, &infinity, sizeof infinity);
    std::memcpy(stretched.data() + 48, &half, sizeof half);
    EXPECT_EQ(refusal_of(infinite), DatagramFault::value);
    EXPECT_EQ(refusal_of(stretched), DatagramFault::value) << "the rotation is no longer of unit length";
}

TEST(Datagram, TakesARotationOfUnitLengthToAThousandth) {
    for (const auto& [square, is_taken] : {std::pair{1.0005, true}, {1.005, false}, {0.9995, true}, {0.995, false}}) {
        ByteList bytes = pose_bytes();
        const std::array<double, 4> rotation{std::sqrt(square), 0.0, 0.0, 0.0};
        std::memcpy(bytes.data() + 48, rotation.data(), sizeof rotation);
        DatagramFault fault{};
        EXPECT_EQ(decode(bytes, nullptr, fault).has_value(), is_taken) << square;
        EXPECT_EQ(fault == DatagramFault::value, !is_taken) << square;
    }
}

TEST(Datagram, RefusesAHelloWithLimitsThatCannotBe) {
    const auto is_taken = [](auto&& change) {
        Hello hello{.name = "rig", .facts = some_facts()};
        change(hello.facts);
        Bytes bytes{};
        const std::size_t size = encode({.header = {}, .content = hello}, nullptr, bytes);
        DatagramFault fault{};
        return decode({bytes.data(), size}, nullptr, fault).has_value();
    };
    EXPECT_TRUE(is_taken([](auto&) {}));
    EXPECT_FALSE(is_taken([](auto& f) { f.abilities = KERF_DEVICE_FORCE; }));
    EXPECT_FALSE(is_taken([](auto& f) { f.abilities |= 1u << 20; }));
    EXPECT_FALSE(is_taken([](auto& f) { f.button_count = 33; }));
    EXPECT_FALSE(is_taken([](auto& f) { f.continuous_force = 9.0; })) << "above the peak";
    EXPECT_FALSE(is_taken([](auto& f) { f.peak_torque = 1.0; })) << "without the ability";
    EXPECT_FALSE(is_taken([](auto& f) { f.resolution = 0.0; }));
    EXPECT_FALSE(is_taken([](auto& f) { f.mass = std::nan(""); }));
}

TEST(Datagram, WithAKeyNoByteCanBeChanged) {
    const Key key{9, 8, 7};
    Bytes bytes{};
    const std::size_t size = encode(
        {.header = {.session = 5, .sequence = 6}, .content = PoseReport{.device_from_handle = {{}, {1, 0, 0, 0}}}},
        &key, bytes);
    for (std::size_t i = 0; i < size; ++i) {
        Bytes other = bytes;
        other[i] ^= 1u;
        DatagramFault fault{};
        EXPECT_FALSE(decode({other.data(), size}, &key, fault)) << i;
    }
    const Key wrong{9, 8, 6};
    DatagramFault fault{};
    EXPECT_FALSE(decode({bytes.data(), size}, &wrong, fault));
    EXPECT_EQ(fault, DatagramFault::tag);
}

// Source: the first and the sixteenth of the vectors of the reference implementation; the latter is in appendix A, too.
TEST(SipHash, HasThePublishedValues) {
    Key key;
    std::iota(key.begin(), key.end(), std::uint8_t{0});
    std::array<std::uint8_t, 15> message;
    std::iota(message.begin(), message.end(), std::uint8_t{0});
    EXPECT_EQ(siphash({}, key), 0x726fdb47dd0e0e31u);
    EXPECT_EQ(siphash(message, key), 0xa129ca6149be45e5u);
}

}  // namespace
}  // namespace kerf::udp
