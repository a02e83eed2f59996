// SPDX-License-Identifier: Apache-2.0
#include "documents/read_station.h"

#include <gtest/gtest.h>

#include <string>

#include "kerf/math.hpp"

namespace kerf::documents {
namespace {

Station read(const std::string& devices) {
    text::Diagnostics found;
    auto station =
        read_station_text("station.yaml", "apiVersion: kerf/v1\nkind: Station\ndevices:\n" + devices).take(found);
    EXPECT_TRUE(station) << text::to_text(found);
    return station ? *station : Station{};
}

/// Returns the code of the only error.
std::string error_of(const std::string& devices) {
    text::Diagnostics found;
    EXPECT_FALSE(
        read_station_text("station.yaml", "apiVersion: kerf/v1\nkind: Station\ndevices:\n" + devices).take(found));
    return text::to_text(found);
}

TEST(Station, HasTheDefaultsOfADeviceThatItDoesNotName) {
    const DeviceStation station = read("  - {device: stylus}\n").of("udp/port-4190");
    EXPECT_EQ(station.device, "udp/port-4190");
    EXPECT_EQ(station.scale, 1.0);
    EXPECT_EQ(station.buttons[0], ButtonAction::drive);
    EXPECT_EQ(station.buttons[1], ButtonAction::next);
}

TEST(Station, ReadsHowADeviceStands) {
    const Station station =
        read("  - device: udp\n    axes: {right: anterior, up: superior}\n    scale: 0.25\n    buttons: [next, none, "
             "drive]\n"
             "    peer: 192.168.1.7\n    key_file: /etc/kerf.key\n    motion: a.csv\n  - {device: udp/port-5000, "
             "scale: 0.5}\n");
    const DeviceStation udp = station.of("udp/port-4190");
    EXPECT_EQ(udp.device, "udp/port-4190");
    EXPECT_EQ(udp.scale, 0.25);
    EXPECT_EQ(length(udp.right - Vec3{0, -1, 0}), 0.0);
    EXPECT_EQ(udp.buttons[0], ButtonAction::next);
    EXPECT_EQ(udp.buttons[1], ButtonAction::none);
    EXPECT_EQ(udp.buttons[2], ButtonAction::drive);
    EXPECT_EQ(udp.buttons[3], ButtonAction::none) << "a list replaces all";
    ASSERT_EQ(udp.settings.size(), 3u);
    EXPECT_EQ(udp.settings[0].second, "192.168.1.7");
    EXPECT_EQ(udp.settings[2].second, "a.csv");
    EXPECT_EQ(station.of("kerf.udp.udp").scale, 0.25);
    EXPECT_EQ(station.of("udp/port-5000").scale, 0.5) << "its own entry precedes that of its driver";
}

TEST(Station, ReadsTheWorkspaceOfAHandle) {
    const DeviceStation station =
        read("  - {device: udp, workspace: {from: -80 -60 -40 mm, to: 8 6 4 cm}}\n").of("udp");
    ASSERT_TRUE(station.workspace);
    EXPECT_EQ(station.workspace->low.y, -0.06);
    EXPECT_EQ(station.workspace->high.x, 0.08);
    EXPECT_FALSE(DeviceStation{}.workspace);
}

TEST(Station, ReadsWhatWasFixedToTheHandle) {
    const DeviceStation station = read("  - {device: udp, handle: {grip: 0 -5 40 mm, mass: 60 g}}\n").of("udp");
    EXPECT_EQ(station.handle.grip.y, -5e-3);
    EXPECT_EQ(station.handle.grip.z, 40e-3);
    EXPECT_DOUBLE_EQ(station.handle.mass, 0.06);
    EXPECT_NE(station.text().find("; handle: {grip: 0 mm -5 mm 40 mm, mass: 60 g}"), std::string::npos)
        << station.text();
    EXPECT_EQ(read("  - {device: udp, handle: {mass: 60 g}}\n").of("udp").handle.grip.z, 0.0);
    EXPECT_NE(error_of("  - {device: udp, handle: {mass: 6 kg}}\n").find("E0412"), std::string::npos);
    EXPECT_NE(error_of("  - {device: udp, handle: {mass: 60}}\n").find("`60 g`"), std::string::npos)
        << error_of("  - {device: udp, handle: {mass: 60}}\n");
}

TEST(Station, RefusesAWorkspaceWithoutRoom) {
    const std::string error = error_of("  - {device: udp, workspace: {from: 80 -60 -40 mm, to: -80 60 40 mm}}\n");
    EXPECT_NE(error.find("too thin"), std::string::npos) << error;
}

TEST(Station, RefusesAScaleBesideAWorkspace) {
    const std::string error =
        error_of("  - {device: udp, scale: 0.5, workspace: {from: -80 -60 -40 mm, to: 80 60 40 mm}}\n");
    EXPECT_NE(error.find("Remove one"), std::string::npos) << error;
}

TEST(Station, WritesItsSetupWithoutPathsAndAddresses) {
    const std::string text =
        read("  - {device: udp, axes: {right: anterior, up: superior}, scale: 0.25, buttons: [next, none, drive], "
             "peer: 192.168.1.7, key_file: /etc/kerf.key, motion: a.csv}\n")
            .of("udp")
            .text();
    EXPECT_EQ(
        text,
        "axes: {right: anterior, up: superior}; scale: 0.25; speed: 20 mm/s; turn_speed: 30 deg/s; dead_zone: 0.1; "
        "buttons: [next, none, drive]");
}

TEST(Station, ReadsTheSpeedsAndThePedalOfACap) {
    const DeviceStation cap =
        read("  - {device: spacemouse, speed: 5 mm/s, turn_speed: 10 deg/s, dead_zone: 0.2, pedal: pedal/A1}\n")
            .of("spacemouse");
    EXPECT_DOUBLE_EQ(cap.speed, 5e-3);
    EXPECT_DOUBLE_EQ(cap.turn_speed, 10.0 * 3.14159265358979323846 / 180.0);
    EXPECT_EQ(cap.dead_zone, 0.2);
    EXPECT_EQ(cap.pedal, "pedal/A1");
    EXPECT_EQ(DeviceStation{}.pedal, "");
}

TEST(Station, AppendsTheActionsOfAPedal) {
    DeviceStation cap{.device = "spacemouse"};
    cap.buttons = {ButtonAction::next, ButtonAction::undo};
    cap.append_buttons({.device = "pedal"}, 2);
    EXPECT_EQ(cap.buttons[1], ButtonAction::undo);
    EXPECT_EQ(cap.buttons[2], ButtonAction::drive) << "the first of the pedal";
    EXPECT_EQ(cap.buttons[4], ButtonAction::clutch);
}

TEST(Station, TurnsTheAxesOfTheDevice) {
    const Vec3 sides[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (const Vec3& right : sides)
        for (const Vec3& up : sides) {
            if (dot(right, up) != 0.0) continue;
            const Quat turn = DeviceStation{.right = right, .up = up}.world_from_device();
            EXPECT_NEAR(length(rotate(turn, {1, 0, 0}) - right), 0.0, 1e-12);
            EXPECT_NEAR(length(rotate(turn, {0, 1, 0}) - up), 0.0, 1e-12);
            EXPECT_NEAR(length(rotate(turn, {0, 0, 1}) - cross(right, up)), 0.0, 1e-12) << "right-handed";
        }
}

TEST(Station, SaysWhatIsWrong) {
    EXPECT_NE(error_of("  - {device: udp, axes: {right: left, up: right}}\n").find("perpendicular"), std::string::npos);
    EXPECT_NE(error_of("  - {device: udp, axes: {right: leftt, up: superior}}\n").find("left"), std::string::npos);
    EXPECT_NE(error_of("  - {device: udp, buttons: [drive, jump]}\n").find("`jump`"), std::string::npos);
    EXPECT_NE(error_of("  - {device: udp, scale: 1000}\n").find("E0412"), std::string::npos);
    EXPECT_NE(error_of("  - {device: udp}\n  - {device: udp}\n").find("twice"), std::string::npos);
    EXPECT_NE(error_of("  - {device: cap, speed: 20 m/s}\n").find("mm/s"), std::string::npos);
    EXPECT_NE(error_of("  - {device: cap, turn_speed: 30 mm/s}\n").find("deg/s"), std::string::npos);
    EXPECT_NE(error_of("  - {device: cap, dead_zone: 1}\n").find("E0412"), std::string::npos);
    EXPECT_NE(error_of("  - {scale: 1}\n").find("device"), std::string::npos);
    EXPECT_NE(error_of("  - {device: udp, frame: left}\n").find("`frame`"), std::string::npos);
}

}  // namespace
}  // namespace kerf::documents
