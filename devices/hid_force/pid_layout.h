// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "devices/hid/report_descriptor.h"

/// Devices with force feedback by the class Physical Interface Device (PID) 1.0 of USB HID.
namespace kerf::hid_force {

/// Largest report of a device that Kerf takes, with the byte of its id [bytes].
inline constexpr std::size_t max_report = 65;

/// A value in a report.
struct Spot {
    std::uint32_t bit = 0;          ///< [bits] from the byte of the id
    std::uint32_t bits = 0;         ///< 0: the device has none
    std::int64_t min = 0, max = 0;  ///< logical values

    [[nodiscard]] bool exists() const noexcept { return bits != 0; }
};

/// One of several named values: a number in a field of its own, or a bit of a mask.
struct Choice {
    Spot spot{};
    std::int64_t value = 0;

    [[nodiscard]] bool exists() const noexcept { return spot.exists(); }
};

struct Message {
    hid::ReportKind kind = hid::ReportKind::output;
    std::uint8_t id = 0;
    std::size_t size = 0;  ///< [bytes] with the id; 0: the device has none

    [[nodiscard]] bool exists() const noexcept { return size != 0; }
};

/// Where a device keeps what a constant force needs. Members marked optional may be missing.
struct PidLayout {
    struct {
        Message message{};
        Choice constant_force{};
    } create{};
    struct {
        Message message{};
        Spot block{};
        Choice success{}, full{}, error{};  ///< the latter two optional
    } load{};
    struct {
        Message message{};
        Spot block{};
        Choice constant_force{};
        Spot duration{};
        Spot gain{}, axis_enable{}, direction_enable{}, direction{};  ///< optional
        std::int64_t duration_counts = 0;                             ///< of `effect_duration` or more
        double duration_time = 0.0;                                   ///< [s] of these counts
    } effect{};
    struct {
        Message message{};
        Spot block{}, magnitude{};
    } force{};
    struct {
        Message message{};
        Spot block{};
        Choice start{}, stop{};
        Spot loops{};  ///< optional
    } operation{};
    struct {
        Message message{};  ///< optional
        Spot block{};
    } free{};
    struct {
        Message message{};
        Choice enable{}, stop_all{};
        Choice reset{};  ///< optional
    } control{};
    struct {
        Message message{};  ///< optional
        Spot gain{};
    } gain{};
    struct {
        Message message{};                            ///< optional
        Spot paused{}, enabled{}, safety{}, power{};  ///< each optional
    } state{};
    struct {
        Message message{};
        Spot value{};
    } axis{};
};

/// Time after which a device that gets no more reports makes no force [s]. A write can take 14 ms and more, so a much
/// shorter one would interrupt the force.
inline constexpr double effect_duration = 0.1;

struct FoundLayout {
    PidLayout layout{};
    std::string problem{};  ///< the field that is missing or wrong; empty: the device can be driven
};

/// Returns whether a descriptor is that of a device with force feedback.   [any] pure
[[nodiscard]] bool has_force(const hid::ReportDescriptor& descriptor) noexcept;

/// Finds what a constant force about the first axis of a device needs.   [any] pure
///
/// Effect types and operations are positions in the descriptor's lists. Device control may be a list or a mask. Flags
/// of one bit are 0 or 1, whatever range the descriptor states. The duration counts in the unit of its exponent;
/// without a unit it counts milliseconds [assumed]. A device whose shortest duration is above 1 s is refused.
///
/// Source: Linux, `drivers/hid/usbhid/hid-pidff.c`; the numbers of the usages are also those of `IOHIDUsageTables.h` of
/// Apple.
[[nodiscard]] FoundLayout find_layout(const hid::ReportDescriptor& descriptor);

}  // namespace kerf::hid_force
