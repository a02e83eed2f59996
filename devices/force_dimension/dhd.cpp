// SPDX-License-Identifier: Apache-2.0
#include "dhd.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>

#include "devices/library/matrix_rotation.h"

namespace kerf::force_dimension {

namespace {

struct TypedModel {
    int type;
    Model model;
};
constexpr TypedModel models[] = {
    {33, {"omega.3", 12.0, 5000.0, 30.0, true}},  {34, {"omega.6", 12.0, 5000.0, 30.0, true}},
    {36, {"omega.6", 12.0, 5000.0, 30.0, true}},  {35, {"omega.7", 12.0, 5000.0, 30.0, true}},
    {37, {"omega.7", 12.0, 5000.0, 30.0, true}},  {63, {"delta.3", 20.0, 5000.0, 30.0, true}},
    {64, {"delta.6", 20.0, 5000.0, 30.0, true}},  {60, {"Falcon", 8.0, 3000.0, 20.0, true}},
    {104, {"sigma.7", 12.0, 4000.0, 30.0, true}}, {105, {"sigma.7", 12.0, 4000.0, 30.0, true}},
};
constexpr Model weakest{"device of unknown type", 8.0, 3000.0, 20.0, false};

/// Sets a function that a library may lack.
template <class F>
void bind_if_there(const SharedLibrary& library, F*& function, const char* symbol) {
    try {
        library.bind(function, symbol);
    } catch (const std::runtime_error&) {
        function = nullptr;
    }
}

}  // namespace

LibraryPlaces places(const std::string& setting) {
    return {.names = {"libdrd.so.3", "libdrd.so", "libdhd.so.3", "libdhd.so"},
            .setting = setting,
            .variable = "FORCEDIM_SDK",
            .maker = "Force Dimension"};
}

Dhd Dhd::of(const SharedLibrary& library) {
    Dhd dhd;
    library.bind(dhd.device_count, "dhdGetDeviceCount");
    library.bind(dhd.open, "dhdOpenID");
    library.bind(dhd.close, "dhdClose");
    library.bind(dhd.system_type, "dhdGetSystemType");
    library.bind(dhd.system_name, "dhdGetSystemName");
    library.bind(dhd.serial_number, "dhdGetSerialNumber");
    library.bind(dhd.has_wrist, "dhdHasWrist");
    library.bind(dhd.enable_force, "dhdEnableForce");
    library.bind(dhd.set_force, "dhdSetForce");
    library.bind(dhd.position, "dhdGetPosition");
    library.bind(dhd.orientation, "dhdGetOrientationFrame");
    library.bind(dhd.button, "dhdGetButton");
    library.bind(dhd.status, "dhdGetStatus");
    library.bind(dhd.set_watchdog, "dhdSetWatchdog");
    library.bind(dhd.watchdog, "dhdGetWatchdog");
    library.bind(dhd.last_error_text, "dhdErrorGetLastStr");
    bind_if_there(library, dhd.is_initialized, "drdIsInitialized");
    bind_if_there(library, dhd.initialize, "drdAutoInit");
    bind_if_there(library, dhd.stop_regulation, "drdStop");
    return dhd;
}

std::string reason_of_force_off(int state) {
    static constexpr const char* reasons[] = {
        "",
        "the force button is off. Press it on the base.",
        "the handle was moved too fast, so the base has switched its forces off. Press the force button.",
        "no force came in time, so the base has switched its forces off. Press the force button.",
        "another program has switched the forces off. End it, then press the force button.",
        "the USB cable was unplugged. Plug it in again.",
        "the dead man's switch is released. Hold it.",
    };
    if (state >= 0 && static_cast<std::size_t>(state) < std::size(reasons)) return reasons[state];
    return "the base has switched its forces off. Press the force button.";
}

Model model_of(int system_type) noexcept {
    const auto* const found = std::find_if(std::begin(models), std::end(models),
                                           [&](const TypedModel& one) { return one.type == system_type; });
    return found != std::end(models) ? found->model : weakest;
}

std::optional<Quat> rotation_of(const double (&rows)[3][3]) noexcept {
    // Columns are the images of the maker's axes, and its x, y and z axes are the device's z, x and y axes.
    const auto column = [&](int i) { return to_device({rows[0][i], rows[1][i], rows[2][i]}); };
    return rotation_of_columns(column(1), column(2), column(0));
}

}  // namespace kerf::force_dimension
