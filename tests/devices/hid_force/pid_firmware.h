// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "devices/hid/report_descriptor.h"

/// Devices with force feedback, as their firmware sees them: each report by hand, next to the descriptor that states
/// the same. A driver that misreads the descriptor meets bytes in other positions.
namespace kerf::test {

/// A number in a report: its first bit, from the byte of the id.
struct At {
    unsigned bit = 0, bits = 0;
    bool is_signed = false;
};

struct Firmware {
    std::vector<std::uint8_t> descriptor{};
    std::map<std::pair<hid::ReportKind, std::uint8_t>, std::size_t> sizes{};  ///< [bytes] with the id
    struct {
        std::uint8_t id = 0;
        bool is_mask = false;
        unsigned enable = 0, disable = 0, stop_all = 0, reset = 0;  ///< numbers, or bits of the mask
        bool stop_all_pauses = false;                               ///< effects continue when the actuators are enabled
    } control{};
    struct {
        std::uint8_t id = 0;
        At block{}, type{}, duration{}, gain{}, axis{}, direction_enable{}, direction{};
        unsigned constant = 0;   ///< number of the type
        double count_time = 0;   ///< [s] of a count of the duration
        double full_circle = 0;  ///< counts of the direction
    } effect{};
    struct {
        std::uint8_t id = 0;
        At block{}, magnitude{};
        double full = 0;
    } force{};
    struct {
        std::uint8_t id = 0;
        At block{}, number{};
        unsigned start = 0, stop = 0;
    } operation{};
    struct {
        std::uint8_t id = 0;  ///< 0: the device has no such report
        At block{}, value{};
        double full = 0;
        bool is_ignored = false;
    } free{}, gain{};
    struct {
        std::uint8_t create = 0, load = 0;
        At type{}, block{}, status{};
        unsigned success = 0, full = 0;
    } pool{};
    struct {
        std::uint8_t id = 0;
        At value{};
    } axis{};
};

/// An OpenFFBoard as a wheel. Device control is a mask of bits, directions are hundredths of a degree, and there are
/// two axes, of which a wheel uses the first. Source: github.com/Ultrawipf/OpenFFBoard, commit 160af910: the descriptor
/// `hid_2ffb_desc`, `ffb_defs.h`, `HidFFB.cpp` and `EffectsCalculator.cpp`. The report of conditions is left out.
[[nodiscard]] Firmware open_ffboard();
/// An Arduino with a library for joysticks. Device control is a list from 1, directions have eight bits, and there is
/// no start delay. Source: github.com/YukMingLaw/ArduinoJoystickWithFFBLibrary, commit ed86e27e: `FFBDescriptor.h`,
/// `PIDReportHandler.cpp` and `Joystick.cpp`, with two axes and eight buttons. The reports of conditions and custom
/// forces are left out.
[[nodiscard]] Firmware two_axes();
/// Made up: it lacks much of what the class describes, such as gain, free block, direction and start delay. Device
/// control counts from 0, durations from 100 us, and blocks have four bits. Its axis is an endless knob of 24 bits.
[[nodiscard]] Firmware sparse_knob();

}  // namespace kerf::test
