// SPDX-License-Identifier: Apache-2.0
#pragma once

/// What a test may do with the stand-in for libHD: functions that the library exports next to those of the maker. One
/// thread sets the pose, and any thread may read the force, both at any time and without a lock.
extern "C" {

enum double_hd_value {
    double_hd_is_plugged,
    double_hd_calibration,         // 0x5000 done, 0x5001 can update itself, 0x5002 needs a hand
    double_hd_styles,              // of calibration: 1 encoders, 2 automatic, 4 inkwell
    double_hd_refusals,            // number of calls of hdInitDevice that find the device in use
    double_hd_is_stalled,          // the servo calls no one
    double_hd_error,               // adds an error with this code
    double_hd_accepted_name,       // 0: each; 1: "Default PHANToM" alone; 2: "my touch" alone
    double_hd_is_silent_of_facts,  // states no limit
    // Of the driver, to read:
    double_hd_frames,
    double_hd_is_running,    // the scheduler
    double_hd_is_enabled,    // the force
    double_hd_is_scheduled,  // a callback
    double_hd_wrong_calls,   // a device initialised while the scheduler runs, or a frame out of order
    double_hd_updates,       // of the calibration
    double_hd_value_count,
};

void double_hd_reset();                                            // plugged in, calibrated, at the origin
void double_hd_set_pose(const double transform[16], int buttons);  // column by column [mm]
void double_hd_force(double force[3]);                             // [N] that it makes now
void double_hd_set(int value, long to);
long double_hd_get(int value);
}
