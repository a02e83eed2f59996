// SPDX-License-Identifier: Apache-2.0
#include "hd.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "devices/library/matrix_rotation.h"

namespace kerf::openhaptics {

namespace {

struct Words {
    unsigned code;
    const char *meaning, *advice;
};

constexpr const char* check_cable =
    "Check power and cable. For a device at an Ethernet port, pair it with the maker's setup program.";
constexpr const char* let_cool = "Let it rest until the motors are cool.";
constexpr const char* start_again = "Start Kerf again.";

constexpr Words words[] = {
    {0x100, "an unknown name of a value", ""},
    {0x101, "a value that is not allowed", ""},
    {0x102, "an operation that is not allowed now", ""},
    {0x103, "a wrong type of value", ""},
    {0x104, "no such device", check_cable},
    {0x200, "the motors are too warm", let_cool},
    {0x201, "the maximum force was exceeded", ""},
    {0x202, "the force changed too fast", ""},
    {0x203, "the handle moved too fast", ""},
    {0x204, "the device cannot make the force", ""},
    {0x300, "the device reports a fault", "Switch it off and on."},
    {0x301, "the device is already in use", "End the other program that uses it, or one that crashed."},
    {0x302, "communication with the device failed", check_cable},
    {0x303, "the device is not set up", "Run the maker's setup program, as this user."},
    {0x304, "the timer of the library failed", start_again},
    {0x400, "a frame was begun twice", start_again},
    {0x401, "a frame was ended twice", start_again},
    {0x402, "a frame failed", start_again},
    {0x500, "a priority that is not allowed", ""},
    {0x501, "the library's scheduler is full", "End other programs that use it."},
    {0x600, "the maker's licence is not valid", "Install the maker's licence."},
};

const Words* words_of(unsigned code) {
    const auto* const found =
        std::find_if(std::begin(words), std::end(words), [&](const Words& one) { return one.code == code; });
    return found != std::end(words) ? found : nullptr;
}

}  // namespace

LibraryPlaces places(const std::string& setting) {
    return {
        .names = {"libHD.so.3.0", "libHD.so"}, .setting = setting, .variable = "OH_SDK_BASE", .maker = "3D Systems"};
}

Hd Hd::of(const SharedLibrary& library) {
    Hd hd;
    library.bind(hd.init_device, "hdInitDevice");
    library.bind(hd.disable_device, "hdDisableDevice");
    library.bind(hd.current_device, "hdGetCurrentDevice");
    library.bind(hd.make_current, "hdMakeCurrentDevice");
    library.bind(hd.begin_frame, "hdBeginFrame");
    library.bind(hd.end_frame, "hdEndFrame");
    library.bind(hd.take_error, "hdGetError");
    library.bind(hd.enable, "hdEnable");
    library.bind(hd.get_ints, "hdGetIntegerv");
    library.bind(hd.get_doubles, "hdGetDoublev");
    library.bind(hd.get_text, "hdGetString");
    library.bind(hd.set_doubles, "hdSetDoublev");
    library.bind(hd.start_scheduler, "hdStartScheduler");
    library.bind(hd.stop_scheduler, "hdStopScheduler");
    library.bind(hd.schedule, "hdScheduleAsynchronous");
    library.bind(hd.unschedule, "hdUnschedule");
    library.bind(hd.check_calibration, "hdCheckCalibration");
    library.bind(hd.update_calibration, "hdUpdateCalibration");
    return hd;
}

std::string text_of(const HdError& error) {
    const Words* const found = words_of(error.code);
    std::array<char, 64> numbers{};
    static_cast<void>(
        std::snprintf(numbers.data(), numbers.size(), " (0x%x, internal %d)", error.code, error.internal));
    return (found != nullptr ? found->meaning : "an error that Kerf does not know") + std::string(numbers.data());
}

std::string advice_for(unsigned code) {
    const Words* const found = words_of(code);
    return found != nullptr ? found->advice : "";
}

unsigned preferred_style(int styles) noexcept {
    for (const unsigned style : {4u, 2u, 1u})
        if ((static_cast<unsigned>(styles) & style) != 0) return style;
    return 0;
}

std::string calibration_advice(int styles) {
    switch (preferred_style(styles)) {
        case 4:
            return "Put the stylus into the inkwell.";
        case 2:
            return "Move the stylus slowly through its workspace.";
        case 1:
            return "Hold the arm in its reset position, with all links at right angles, and start Kerf again.";
        default:
            return "Calibrate it with the maker's setup program.";
    }
}

std::optional<Pose> pose_of(const double (&transform)[16]) noexcept {
    constexpr double metres = 1e-3;  // of a millimetre
    const auto column = [&](int i) { return Vec3{transform[4 * i], transform[4 * i + 1], transform[4 * i + 2]}; };
    const std::optional<Quat> rotation = rotation_of_columns(column(0), column(1), column(2));
    const Vec3 position = column(3);
    if (!rotation || !is_finite(position)) return std::nullopt;
    return Pose{metres * position, *rotation};
}

}  // namespace kerf::openhaptics
