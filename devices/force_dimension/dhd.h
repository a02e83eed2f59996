// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "devices/library/shared_library.h"
#include "kerf/device.h"
#include "kerf/math.hpp"

namespace kerf::force_dimension {

/// Returns where the libraries of Force Dimension may lie. `libdrd` contains `libdhd` and can calibrate.   [main]
[[nodiscard]] LibraryPlaces places(const std::string& setting);

/// The functions of libdhd and libdrd that the driver needs, version 3.14 and later. Results are those of the maker:
/// not negative is success. Source: the functions' names and types as public programs use them.
struct Dhd {
    int (*device_count)() = nullptr;
    int (*open)(char index) = nullptr;
    int (*close)(char id) = nullptr;
    int (*system_type)(char id) = nullptr;
    const char* (*system_name)(char id) = nullptr;
    int (*serial_number)(unsigned short* number, char id) = nullptr;
    bool (*has_wrist)(char id) = nullptr;
    int (*enable_force)(unsigned char is_on, char id) = nullptr;
    int (*set_force)(double x, double y, double z, char id) = nullptr;
    int (*position)(double* x, double* y, double* z, char id) = nullptr;
    int (*orientation)(double rows[3][3], char id) = nullptr;
    int (*button)(int index, char id) = nullptr;
    int (*status)(int values[], char id) = nullptr;
    int (*set_watchdog)(unsigned char steps, char id) = nullptr;
    int (*watchdog)(unsigned char* steps, char id) = nullptr;
    const char* (*last_error_text)() = nullptr;
    // Of libdrd; null in a libdhd alone.
    bool (*is_initialized)(char id) = nullptr;
    int (*initialize)(char id) = nullptr;
    int (*stop_regulation)(bool keeps_force, char id) = nullptr;

    /// Looks up all functions. Throws std::runtime_error if a needed one is missing.
    [[nodiscard]] static Dhd of(const SharedLibrary& library);
};

inline constexpr int status_count = 64;               ///< more than any version fills
inline constexpr int status_force_off = 14;           ///< index of why forces are off
inline constexpr unsigned char watchdog_steps = 160;  ///< of 125 us: 20 ms

/// Returns what a state `why forces are off` means for people; empty: they are on.   [any] pure
[[nodiscard]] std::string reason_of_force_off(int state);

/// Limits of a device by its type, of the maker's data sheets as CHAI3D lists them [chai3d].
struct Model {
    const char* name;
    double peak_force;  ///< [N]
    double stiffness;   ///< [N/m]
    double damping;     ///< [N·s/m]
    bool is_known;
};
/// Returns the model of a type; the weakest one, not known, for others.   [any] pure
[[nodiscard]] Model model_of(int system_type) noexcept;

/// Returns a position or direction of the maker's frame, +x towards the user, +y right, +z up, in the frame `device`.
/// [any] pure
[[nodiscard]] constexpr Vec3 to_device(Vec3 maker) noexcept { return {maker.y, maker.z, maker.x}; }
[[nodiscard]] constexpr Vec3 to_maker(Vec3 device) noexcept { return {device.z, device.x, device.y}; }
/// Returns a rotation of the maker's frame in the frame `device`, or nothing if the matrix is none.   [any] pure
[[nodiscard]] std::optional<Quat> rotation_of(const double (&rows)[3][3]) noexcept;

}  // namespace kerf::force_dimension
