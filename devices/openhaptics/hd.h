// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "devices/library/shared_library.h"
#include "kerf/device.h"
#include "kerf/math.hpp"

namespace kerf::openhaptics {

/// Returns where libHD may lie.   [main]
[[nodiscard]] LibraryPlaces places(const std::string& setting);

/// An error as libHD returns it, by value.
struct HdError {
    unsigned code = 0;  ///< 0: none
    int internal = 0;
    unsigned device = 0;
};

inline constexpr unsigned no_device = 0xffffffffu;

/// The functions of libHD that the driver needs, version 3. Source: names and types as public programs use them.
struct Hd {
    unsigned (*init_device)(const char* name) = nullptr;
    void (*disable_device)(unsigned device) = nullptr;
    unsigned (*current_device)() = nullptr;
    void (*make_current)(unsigned device) = nullptr;
    void (*begin_frame)(unsigned device) = nullptr;
    void (*end_frame)(unsigned device) = nullptr;
    HdError (*take_error)() = nullptr;
    void (*enable)(unsigned capability) = nullptr;
    void (*get_ints)(unsigned name, int* values) = nullptr;
    void (*get_doubles)(unsigned name, double* values) = nullptr;
    const char* (*get_text)(unsigned name) = nullptr;
    void (*set_doubles)(unsigned name, const double* values) = nullptr;
    void (*start_scheduler)() = nullptr;
    void (*stop_scheduler)() = nullptr;
    unsigned long (*schedule)(unsigned (*callback)(void*), void* context, unsigned short priority) = nullptr;
    void (*unschedule)(unsigned long callback) = nullptr;
    unsigned (*check_calibration)() = nullptr;
    void (*update_calibration)(unsigned style) = nullptr;

    /// Looks up all functions. Throws std::runtime_error if one is missing.
    [[nodiscard]] static Hd of(const SharedLibrary& library);
};

/// Names of values and states.
enum HdName : unsigned {
    hd_buttons = 0x2000,
    hd_transform = 0x2052,  ///< 16 doubles, column by column [mm]
    hd_model = 0x2501,
    hd_serial = 0x2504,
    hd_output_dof = 0x2554,
    hd_calibration_style = 0x2555,
    hd_max_stiffness = 0x2602,     ///< [N/mm]
    hd_max_force = 0x2603,         ///< [N]
    hd_continuous_force = 0x2604,  ///< [N]
    hd_max_damping = 0x2609,       ///< [N·s/mm]
    hd_force = 0x2700,             ///< [N]
    hd_force_output = 0x4000,
    hd_calibrated = 0x5000,
    hd_needs_update = 0x5001,
};
enum HdErrorCode : unsigned {
    hd_warm_motors = 0x200,
    hd_last_of_force = 0x204,
    hd_fault = 0x300,
    hd_already_initiated = 0x301,
    hd_timer_error = 0x304,
};

/// Returns what an error means for people: "communication with the device failed (0x302, internal -28)". [any]
[[nodiscard]] std::string text_of(const HdError& error);
/// Returns what the user does about an error; empty: nothing in particular.   [any] pure
[[nodiscard]] std::string advice_for(unsigned code);
/// Returns what the user does to calibrate a device, by its styles: 1 encoders, 2 automatic, 4 inkwell.   [any] pure
[[nodiscard]] std::string calibration_advice(int styles);
/// Returns the one style that the driver uses; 0 if there is none.   [any] pure
[[nodiscard]] unsigned preferred_style(int styles) noexcept;

/// Returns the pose of a transform, column by column in mm, or nothing if it is none. libHD and Kerf have the same
/// axes. [any] pure
[[nodiscard]] std::optional<Pose> pose_of(const double (&transform)[16]) noexcept;

}  // namespace kerf::openhaptics
