/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KERF_DEVICE_H
#define KERF_DEVICE_H

/* Haptic devices, components of kind KERF_KIND_DEVICE. Draft: it may change in any version. The C++ header
 * kerf/device_driver.hpp writes the table from a plain struct.
 *
 * A component is the driver of one kind of devices. The host calls `find` and `open` once a run, then `read` and
 * `write` once a tick, and `close`. A driver that waits for its device does so on a thread of its own, and exchanges
 * values with `read` and `write` without a lock.
 *
 * Frame `device`: origin and axes that the driver's documentation states, right-handed, +x to the user's right, +y up,
 * +z towards the user. `handle` is the frame of the handle that the hand moves. Units: SI and radians. */

#include "kerf/abi.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A device that a driver has found. Texts are UTF-8 and end with NUL. */
typedef struct kerf_device_found {
    char id[64];       /* lasts from run to run: a serial number, a port; a-z, A-Z, 0-9, `_`, `-`, `.` */
    char name[96];     /* for people */
    char problem[240]; /* why it cannot be opened, and what to do; empty: it can */
} kerf_device_found;

/* Abilities: what a device senses and what it makes. */
enum {
    KERF_DEVICE_POSITION = 1,
    KERF_DEVICE_ROTATION = 2,
    KERF_DEVICE_FORCE = 4,
    KERF_DEVICE_TORQUE = 8,       /* about every line */
    KERF_DEVICE_DEFLECTION = 16,  /* senses the deflection of its handle from rest, instead of a position */
    KERF_DEVICE_TURN = 32,        /* a knob: senses how far it is turned about its own axis, over any number of turns */
    KERF_DEVICE_TURN_TORQUE = 64, /* a knob with a motor about that axis */
    KERF_DEVICE_MODELLED = 128,   /* no hardware: a model */
};
/* A device that only has buttons, such as a pedal, has no ability. */

enum { KERF_DEVICE_MAX_BUTTONS = 32 };

/* What `open` states of the opened device. */
typedef struct kerf_device_facts {
    char name[96];
    uint32_t abilities;
    uint32_t button_count;                 /* at most KERF_DEVICE_MAX_BUTTONS */
    double peak_force, continuous_force;   /* [N]; 0 without KERF_DEVICE_FORCE */
    double peak_torque, continuous_torque; /* [N·m]; 0 without KERF_DEVICE_TORQUE */
    double largest_stiffness;              /* [N/m] of a spring that it renders stably, as this driver renders it */
    double largest_damping;                /* [N·s/m] */
    double mass;                           /* [kg] at the handle */
    double resolution;                     /* [m] of one count */
    double peak_turn_torque, continuous_turn_torque; /* [N·m] of a knob; 0 without KERF_DEVICE_TURN_TORQUE */
    double turn_resolution;                          /* [rad] of one count; 0 without KERF_DEVICE_TURN */
} kerf_device_facts;

/* Flags of a state. A device whose state is not VALID is lost: unplugged, asleep, in error. It may come back. One with
 * KERF_DEVICE_POSITION is also lost when its reports stop. Others report changes alone, so their silence is rest. */
enum { KERF_DEVICE_VALID = 1 };

/* The newest report of a device. */
typedef struct kerf_device_state {
    uint64_t reports;             /* number of valid reports so far */
    double age;                   /* [s] since the newest of them arrived */
    kerf_pose device_from_handle; /* without KERF_DEVICE_ROTATION its rotation is the identity */
    uint32_t buttons;             /* bit i: button i is pressed */
    uint32_t flags;               /* KERF_DEVICE_VALID … */
    double deflection[6]; /* -1 to 1 of its range, right-handed: along device x, y, z, then about them; 0 without
                             KERF_DEVICE_DEFLECTION */
    double turn;          /* [rad] of the knob since the device was opened, positive clockwise for its user; 0 without
                             KERF_DEVICE_TURN */
} kerf_device_state;

/* Flags of a command. */
enum {
    KERF_DEVICE_FORCE_ON = 1, /* the force is neither fading nor lost */
    KERF_DEVICE_RUNNING = 2,  /* the command is of a tick: before the first one the tool's pose means nothing */
};

typedef struct kerf_device_command {
    uint64_t tick;
    kerf_vec3 force, torque;    /* on the hand, at the handle's origin, device frame; constant until the next */
    kerf_pose device_from_tool; /* of the tool in the bone, for a device that draws it */
    uint32_t flags;             /* KERF_DEVICE_FORCE_ON … */
    uint32_t reserved;
    double turn_torque; /* [N·m] on the hand, about the axis of the knob, positive clockwise for its user */
} kerf_device_command;

/* A setting of the station that is a text: a peer, the file of a key. [call] */
typedef struct kerf_device_setting {
    const char* key;
    const char* value;
} kerf_device_setting;

typedef struct kerf_device_open_in {
    const char* id;       /* of a device that `find` found; empty: any */
    const double* params; /* the component's parameters in declared order, SI */
    const kerf_device_setting* settings;
    uint32_t setting_count;
    uint32_t reserved;
} kerf_device_open_in;

typedef struct kerf_device_open_out {
    void* device; /* for the functions below; null: it was not opened */
    kerf_device_facts facts;
    char message[240]; /* why it was not opened, and what to do */
} kerf_device_open_out;

/* Sizes of the structs that cross. */
typedef struct kerf_device_layout {
    uint32_t found, facts, state, command, open_in, open_out;
} kerf_device_layout;
#define KERF_DEVICE_LAYOUT_INIT                                                                                       \
    {                                                                                                                 \
        sizeof(kerf_device_found), sizeof(kerf_device_facts), sizeof(kerf_device_state), sizeof(kerf_device_command), \
            sizeof(kerf_device_open_in), sizeof(kerf_device_open_out)                                                 \
    }

typedef struct kerf_device {
    uint32_t size;
    uint32_t reserved;
    kerf_device_layout layout;
    /* Writes at most `capacity` devices that are connected now. Returns their number. [main] */
    uint32_t (*find)(const double* params, kerf_device_found* found, uint32_t capacity);
    /* Opens a device. It may wait for it; it then calls `is_cancelled` ten times a second or more, with `context`, and
       returns soon when that is not 0. [main] */
    kerf_status (*open)(const kerf_device_open_in* in, int32_t (*is_cancelled)(void* context), void* context,
                        kerf_device_open_out* out);
    /* Writes the newest report. [haptic, nonblocking] */
    void (*read)(void* device, kerf_device_state* state);
    /* Takes the force of a tick. [haptic, nonblocking] */
    void (*write)(void* device, const kerf_device_command* command);
    /* Sends a zero force, waits at most 0.1 s for the device to take it, and frees all. [main] after the last tick */
    void (*close)(void* device);
    /* Writes why the device is lost or makes no force now, and what to do, in words for its user; an empty text if
       nothing is wrong. [main] while the device is open */
    void (*problem)(void* device, char text[240]);
} kerf_device;

#ifdef __cplusplus
}
#endif
#endif
