// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What a test may do with the stand-in for libdrd: functions that the library exports next to those of the maker. Any
/// thread may call them. The frame is the maker's: +x towards the user, +y right, +z up.
extern "C" {
struct double_dhd_state {
    double position[3];     // [m]
    double rotation[3][3];  // columns are the axes of the handle
    int buttons;            // bit i: button i is pressed
    int is_plugged, is_initialized, system_type, has_watchdog, is_in_use;
    int force_off;       // why forces are off; 0: they are on
    int is_no_number;    // the position is none
    double force[3];     // [N] of the newest call, or zero if none came within 20 ms of its watchdog
    int is_force_on;     // forces are enabled
    int watchdog_steps;  // of 125 us
    int moves;           // how often the arm moved by itself
    long calls;          // of dhdSetForce
};
void double_dhd_set(const double_dhd_state* state);  // of what the driver does nothing
void double_dhd_get(double_dhd_state* state);
}
