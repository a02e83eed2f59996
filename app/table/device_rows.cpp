// SPDX-License-Identifier: Apache-2.0
#include "app/commands.h"
#include "app/program.h"
#include "app/table/parameters.h"
#include "app/table/rows.h"

namespace kerf::app::table {

std::vector<Command> device_commands() {
    using T = DevicesOptions;
    return {
        {.name = "devices",
         .group = "Devices",
         .summary = "List haptic devices, measure one, or report what keeps one from working",
         .arguments = {{.name = "ACTION",
                        .value = one_of("", {"list", "test", "setup", "doctor"}),
                        .help = "list (default), test, setup or doctor",
                        .default_value = "list",
                        .member = in<T>(&T::action)},
                       {.name = "DEVICE",
                        .value = text("", "a device as `kerf devices` shows it"),
                        .help = "Of test and setup: the device",
                        .member = in<T>(&T::device)}},
         .options = {{.name = "--record",
                      .value = file("a file for the motion of the handle", ".csv"),
                      .help = "Of test: also write the motion of the handle, for `motion:` of a station",
                      .member = in<T>(&T::record)},
                     {.name = "--for",
                      .value = text("TIME", "a time, as in `--for 30 s`"),
                      .help = "Of test: how long it measures",
                      .default_value = "10 s",
                      .member = in<T>(&T::duration)},
                     flag("--force", "Of test: push along each axis with at most 1 N, and confirm each push by hand",
                          in<T>(&T::is_with_force))},
         .examples = {{"kerf devices", "lists drivers and the devices that they find"},
                      {"kerf devices test udp", "shows rate, range, rest and buttons of a device for 10 s"},
                      {"kerf devices test udp --record motion.csv",
                       "also writes the motion of the handle, for the driver `replay`"},
                      {"kerf devices test haply --force",
                       "pushes gently along each axis; confirm it before the first run"},
                      {"kerf devices setup udp", "writes a file with the setup of the device, to be changed"},
                      {"kerf devices doctor", "reports limits of the system and problems, for a message to others"}},
         .defaults = T{},
         .run = with_environment(&commands::devices)}};
}

}  // namespace kerf::app::table
