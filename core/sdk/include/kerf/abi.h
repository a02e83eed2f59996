/* SPDX-License-Identifier: Apache-2.0 */
#ifndef KERF_ABI_H
#define KERF_ABI_H

/* The plugin boundary, ABI 0: plain C11 without dependencies.
 *
 * A plugin exports one data symbol, `kerf_plugin_entry`, of type `kerf_entry`. It lists the plugin's components: tools,
 * force laws, remeshing strategies (kerf/remesh.h) and devices (kerf/device.h), each with a table for its kind. All
 * tables are static const. The C++ header kerf/plugin.hpp writes them from plain structs.
 *
 * ABI 0 promises no compatibility: host and plugin must be built against the same layout. The loader refuses any other
 * plugin and names the struct that differs. Fields called `reserved` are 0; the loader refuses other values.
 *
 * Units: SI and radians. Frames: `world` (LPS), `body` (LPS of one body), `tool` (origin at the tip, +z along the shaft
 * and out of the tip). A pose `a_from_b` takes coordinates in b to coordinates in a.
 *
 * Threads: [main] may allocate and fail. [haptic] runs once a tick. [any] is pure. A nonblocking function does not
 * allocate, lock, wait, throw or call the system.
 */

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define KERF_ABI_VERSION 0u
#define KERF_MAGIC 0x4652454bu /* "KERF" */

#define KERF_MAX_CHANNELS 16u /* channels of one law                        */
#define KERF_MAX_SIGNALS 16u  /* signals of one force component             */
#define KERF_MAX_DRIVES 8u    /* drives of one tool                         */
#define KERF_MAX_TISSUES 4u   /* materials that one sample can mix          */
#define KERF_MAX_GAPS 3u      /* safe parts between parts of a tool that remove bone */
#define KERF_MAX_ACTIONS 8u   /* actions of one commit                      */
#define KERF_NOTE_BYTES 64u   /* bytes that `resist` passes to `commit` */
#define KERF_MAX_THREADS 16u  /* screw threads in the bone of a scene */
#define KERF_THREAD_BINS 64u  /* bins of a screw thread, each of which slips separately */

/* ---- lifetimes and threads ---------------------------------------------------------------------------------- */

/* Each pointer that crosses the boundary has one of two lifetimes. A pointer marked [library] is valid while the
 * library is loaded: all that the entry's tables point to, and the host that `open` gets. Any other pointer is valid
 * during the call that passes it ([call]): copy values that you need later.
 *
 * The host calls `open` first. It calls the functions of tools and laws on one thread at a time, and waits for each to
 * return. It calls a strategy in another process, which has loaded the library too and has called its `open`. The two
 * processes have no memory of the library in common. There the host makes one call at a time. A function must not write
 * static data: `kerf check` reports it.
 *
 * Texts are UTF-8, end with NUL and have no control characters. Ids have at most 64 bytes of a-z, A-Z, 0-9, `_`, `-`
 * and `.`. Other texts have at most 2000 bytes unless their array has another size. */

/* ---- plain values ------------------------------------------------------------------------------------------ */

typedef struct kerf_vec3 {
    double x, y, z;
} kerf_vec3;
typedef struct kerf_quat {
    double w, x, y, z;
} kerf_quat; /* unit quaternion */
typedef struct kerf_pose {
    kerf_vec3 position;
    kerf_quat rotation;
} kerf_pose;

/* Exponents of m, kg, s, A, K, mol, cd, rad. */
typedef struct kerf_dimension {
    int8_t exponent[8];
} kerf_dimension;

typedef int32_t kerf_status; /* 0 ok, < 0 failure */
enum { KERF_OK = 0, KERF_FAILED = -1, KERF_OUT_OF_RANGE = -2, KERF_CAPACITY = -3 };

/* ---- self-description -------------------------------------------------------------------------------------- */

typedef struct kerf_param {
    const char* id;           /* snake_case, unique within its component                            */
    const char* help;         /* one sentence                                                       */
    kerf_dimension dimension; /* all zero for a plain number                                        */
    const char* display_unit; /* "mm", "deg", "rpm", "N/mm"; "" for a plain number                  */
    double min, max, def;     /* SI                                                                 */
    const char* source;       /* origin of the default, and whether it is calibrated or assumed     */
} kerf_param;

/* A drive: a value that the trigger or the procedure sets on a powered tool during use. */
typedef struct kerf_drive {
    const char* id; /* spindle_speed, stroke_rate, amplitude, irrigation, trigger … */
    const char* help;
    kerf_dimension dimension;
    const char* display_unit;
    double min, max, def; /* SI */
    double least;         /* magnitude below which the tool runs but does not cut; 0: no such limit */
} kerf_drive;

/* A quantity that a law reports each tick. The session records it. */
typedef struct kerf_signal {
    const char* id;
    const char* help;
    kerf_dimension dimension;
    const char* display_unit;
} kerf_signal;

/*   note     has no effect on the result of the step
 *   damage   damages the tool: the step fails, unless the procedure allows the event in that step */
enum { KERF_EVENT_NOTE = 0, KERF_EVENT_DAMAGE = 1 };

/* An event that a law can report at a tick. The session records its id. */
typedef struct kerf_event {
    const char* id;   /* "<plugin>.<name>"; <plugin> is the plugin's id or the part of it after its last dot */
    const char* help; /* one sentence */
    uint32_t effect;  /* KERF_EVENT_… */
    uint32_t reserved;
} kerf_event;

/* ---- the tool: geometry as data ----------------------------------------------------------------------------- */

/* A point of the outline: the polyline (z, radius) from the tip backwards, z decreasing, radii 0 to 100 mm.
 *   revolution   turned about the tool's z axis. The radius may rise and fall, also in the cutting part (steps, a ball
 *                behind its equator): every sweep is exact
 *   prism        a blade: `radius` is half of its width along x, the front may be round, and two flat sides lie at
 *                ± half of its thickness across y; the whole outline must be convex */
typedef struct kerf_profile_point {
    double z, radius;
} kerf_profile_point;

enum { KERF_SOLID_REVOLUTION = 1, KERF_SOLID_PRISM = 2 };

/* A part of an outline that removes no bone: the indices of its first and its last point. */
typedef struct kerf_gap {
    uint32_t first, last;
} kerf_gap;

/* A tool's outline as the host stores it. */
typedef struct kerf_solid {
    uint32_t size;
    uint32_t kind;
    const kerf_profile_point* profile;
    uint32_t profile_count;
    uint32_t cutting_first; /* first point of the part that removes bone */
    uint32_t cutting_count; /* number of its points */
    double bore;            /* [m] radius of the bore through the cutting part; 0: the tool is not hollow */
    uint32_t gap_count;
    uint32_t reserved;
    kerf_gap gap[KERF_MAX_GAPS]; /* within the cutting part, from the tip backwards */
} kerf_solid;

/* The shape that a tool returns to the host: at most `profile_capacity` points. The host sets all outputs to zero
 * before the call. */
typedef struct kerf_tool_shape {
    uint32_t size;
    uint32_t profile_capacity;
    kerf_profile_point* profile;
    uint32_t profile_count; /* out */
    uint32_t cutting_count; /* out: number of points of the part that removes bone; 0: the tool removes none */
    uint32_t cutting_first; /* out: first of these points; the points before it, as of a pilot, remove no bone */
    uint32_t reserved;
    double bore; /* out, revolution: radius [m] of a bore through the cutting part, as of a trephine; less than each
                    radius of that part; 0: none */
    kerf_gap gap[KERF_MAX_GAPS]; /* out: safe parts within the cutting part, from the tip backwards, as a neck between
                                    two heads */
    uint32_t gap_count;          /* out */
    uint32_t reserved2;
    double grip_z;         /* out: point of the axis at which the hand grips the tool [m], < 0 */
    uint32_t kind;         /* out: KERF_SOLID_…; KERF_SOLID_REVOLUTION before the call */
    uint32_t hands;        /* out: number of hands on the tool, 1 or 2; 0 means 1 */
    double kerf;           /* out, prism: thickness of the part that removes bone [m], > 0 */
    double thickness;      /* out, prism: thickness of the blade behind it [m], > 0 and ≤ kerf */
    double mass;           /* out: mass of the tool with its handpiece [kg]; 0: none */
    double centre_z;       /* out, with a mass: position of the centre of mass on the axis [m] */
    double gyration;       /* out, with a mass: radius of gyration about that centre [m], > 0 */
    double tip_deflection; /* out: deflection of the tip by 1 N across it, shaft clamped at the grip [m/N]; 0: rigid */
    double tip_slope;      /* out: rotation of the tip by the same force [rad/N]; 0 if and only if tip_deflection is */
    double thread_radius;  /* out, revolution: outer radius of the screw thread [m], not less than the cutting part;
                              0: no thread */
    double thread_lead;    /* out, with a thread: advance in one turn [m], > 0 */
    uint32_t stay_count;   /* out, with a thread: number of points, from the tip, that stay in bone when the driver
                              leaves; 0: none */
    uint32_t thread_count; /* out, with a thread: number of points from the tip to the thread's end */
    char refusal[240];     /* out, with KERF_OUT_OF_RANGE: the parameters that conflict, their values and the values
                              that are needed; UTF-8, ends with NUL */
} kerf_tool_shape;

/*   axis   along its axis, tip first: a drill, a saw that plunges
 *   side   across its axis, towards +x: a file, a side-cutting burr. The bone lies on that side
 *   turn   along its axis by the lead of its thread for each turn: a screw, a tap */
enum { KERF_FEED_AXIS = 0, KERF_FEED_SIDE = 1, KERF_FEED_TURN = 2 };

typedef struct kerf_tool {
    uint32_t size;
    uint32_t drive_count;
    const kerf_drive* drives; /* [library] */
    /* Remeshing strategies that suit the cut of this tool, best first, the most accurate last: "kerf.burring.displace".
       The host tries the next one where a strategy is not installed or declines a cut. [library] */
    const char* const* strategies;
    uint32_t strategy_count;
    uint32_t feed; /* KERF_FEED_…: how a hand moves it through bone; used by `kerf check` and `kerf plan` */
    /* Writes the tool's outline for these parameters. [main] */
    kerf_status (*shape)(const double* params, kerf_tool_shape* out);
} kerf_tool;

/* ---- bone: an opaque handle with batch queries --------------------------------------------------------------- */

typedef struct kerf_bone kerf_bone;

typedef struct kerf_bone_sample {
    double engagement; /* [-] 0 in air … 1 in uncut bone; of the committed cut, which lags by about one voxel */
    double gap;        /* [m] distance along the direction to uncut bone; ≥ 0                          */
    double weight[KERF_MAX_TISSUES];  /* [-] fraction of each tissue; sums to 1 where there is bone                   */
    double density[KERF_MAX_TISSUES]; /* [kg/m³] of each tissue at the point                                          */
    int32_t body;                     /* index of the sampled body; -1: none */
    uint32_t reserved;
} kerf_bone_sample;

typedef struct kerf_surface_point {
    double distance;  /* [m] signed distance to the present surface, negative inside, clamped to a few voxels */
    kerf_vec3 normal; /* outward unit normal, tool frame; zero where no surface is near                       */
    int32_t body;
    uint32_t reserved;
} kerf_surface_point;

/* A thread that a tap or a screw has cut into a body. It stays there when the tool leaves. Its groove is a right-hand
 * helix about z of the frame `tool_from_thread`, whose z points into the bone; x points to the groove at z = 0. */
typedef struct kerf_thread {
    kerf_pose tool_from_thread;    /* at the pose of this tick */
    double lead;                   /* [m] advance along z in one turn, > 0 */
    double radius, core;           /* [m] outer radius of the groove; radius of the hole around which it is cut */
    double from, to;               /* [m] of z: the ends of the groove, from <= to */
    double tapped_to;              /* [m] of z: end of the part that a tap has cut clear of chips; <= from: none */
    double tapped_radius;          /* [m] outer radius of the groove of that tap */
    double volume;                 /* [m³] of bone that the groove has removed */
    double slip_from, slip_step;   /* [m] of z: start of the first slip bin, and length of each bin, > 0 */
    double slip[KERF_THREAD_BINS]; /* [m] of each bin: distance by which its bone has yielded along z, >= 0 */
    int32_t body;                  /* index of the body that contains it */
    uint32_t number;               /* number that the host gave this thread; KERF_NEW_THREAD for a new one */
} kerf_thread;
#define KERF_NEW_THREAD 0xffffffffu

typedef struct kerf_bone_query {
    uint32_t size;
    uint32_t tissue_count;
    double reach; /* [m] distances are known up to this far on either side of a surface */
    /* Samples the committed bone at cutting edges. `points` and `directions` (unit) are in the tool frame at the pose
       of this tick. `direction_count` is `count`, one direction a point, or 1; with any other number the first
       direction is used for all points. One query of many points costs less than many queries. [haptic, nonblocking] */
    void (*sample)(const kerf_bone* bone, const kerf_vec3* points, uint32_t count, const kerf_vec3* directions,
                   uint32_t direction_count, kerf_bone_sample* out);
    /* Writes the distance and normal of the present surface nearest to each of `count` contact points, which are in
       the tool frame at the pose of this tick. [haptic, nonblocking] */
    void (*nearest)(const kerf_bone* bone, const kerf_vec3* points, uint32_t count, kerf_surface_point* out);
    /* Returns the number of threads in bodies near the tool, and writes the first `capacity` of them. Null: the bone
       has no threads. [haptic, nonblocking] */
    uint32_t (*threads)(const kerf_bone* bone, kerf_thread* out, uint32_t capacity);
    const kerf_bone* bone;
} kerf_bone_query;

/* ---- force: the law of one tick ------------------------------------------------------------------------------ */

enum { KERF_CUT = 0, KERF_CONTACT = 1, KERF_FRICTION = 2, KERF_HOLD = 3 };

/* A channel: one monotone scalar force. Its rate is s = dᵀu, where u is the rate of the tool (velocity of the tip,
 * angular velocity) in the tool frame. Its force on the tool is −d λ(s). T is `dt`, g is `gap`, τ is `tau`, η is `eta`
 * and δ is `delta`.
 *   cut       λ = 0 for s ≤ g/T; else with s' = s − g/T: λ = τ(1 − e^(−s'/w)) + η s'
 *   contact   λ = max(0, k(δ + sT) + b(s + min(δ, 0)/T))
 *   friction  λ = τ clamp(s/w, −1, 1)
 *   hold      λ = k(δ + sT) + b s; with τ > 0 clamped to −τ … τ
 * `follow` is a wrench on the tool, about its tip, per newton of filtered λ. It is for loads that do no work against s:
 * reaction torque, imbalance. */
typedef struct kerf_channel {
    uint32_t kind;
    uint32_t id;      /* constant over ticks for one resistance: the host filters λ for `follow` by id */
    double d[6];      /* linear [-], angular [m] */
    double follow[6]; /* force [N/N], torque [N·m/N]; each from -1e6 to 1e6 */
    double tau;       /* [N] */
    double w;         /* [m/s] ≥ 1e-6 */
    double eta;       /* [N·s/m] ≥ 0 */
    double gap;       /* [m] ≥ 0 */
    double k, b;      /* [N/m], [N·s/m] ≥ 0 */
    double delta;     /* [m] contact: penetration, negative outside; hold: stretch */
} kerf_channel;

/* The law that one evaluation returns. The host sets all outputs to zero before the call. */
typedef struct kerf_law {
    uint32_t size;
    uint32_t count; /* out, ≤ KERF_MAX_CHANNELS */
    kerf_channel* channel;
    double wrench[6]; /* out: wrench on the tool that is not a resistance, such as a motor's reaction; about its tip,
                         tool frame [N, N·m], each from -1e5 to 1e5. The host scales the sum of this and all
                         `follow` loads down to half of the coupling's limits if it is larger */
    unsigned char note[KERF_NOTE_BYTES]; /* out: values for `commit`, so that it need not query the bone again. The host
                                            copies the bytes of the evaluation that it solved */
} kerf_law;

typedef struct kerf_tick_in {
    uint32_t size;
    uint32_t hand; /* index of the hand on the tool */
    uint64_t tick;
    double dt;                 /* [s] length of this step: the tick, or one of up to 16 equal parts of a fast tick */
    const double* tool_params; /* SI, declared order: parameters of the held tool */
    const double* force_params;
    const double* drive; /* commanded values of the tool's drives, declared order */
    const kerf_bone_query* bone;
    uint32_t tool_param_count;
    uint32_t tool;             /* index of the held tool in the law's `tools`; 0 for a law with `needs` */
    const char* tool_id;       /* id of the held tool */
    const kerf_solid* outline; /* outline of the held tool */
    const uint32_t* bound; /* index of each of the law's `needs` into `tool_params` or `drive`; null without needs */
} kerf_tick_in;

/* The motion and the forces of one step. */
typedef struct kerf_advance {
    uint32_t size;
    uint32_t channel_count;
    double rate[6];              /* rate of the tool at which hand and law balance, tool frame [m/s, rad/s] */
    const kerf_channel* channel; /* the channels of the law that was solved */
    const double* lambda;        /* the force λ of each of these channels [N] */
    double following[6]; /* wrench on the tool that the host applied for `follow` and the law's own wrench, about its
                            tip, tool frame [N, N·m]. It is filtered and limited, so it is not a sum over `lambda` */
    const unsigned char* note; /* the note of that law; null when no law was evaluated */
} kerf_advance;

/*   cut      `value` KERF_CUT_REGION: removes the volume that the tool's cutting part sweeps in this step;
 *            KERF_CUT_THREAD: removes the cylinder around the tool's thread at the end of the tick: a stripped thread
 *   hold     makes body `value` rigid to the tool: it moves with it, and other bodies stop it
 *   release  releases the body that is rigid to the tool
 *   event    reports number `value` of the law's declared events */
enum { KERF_ACTION_CUT = 1, KERF_ACTION_HOLD = 2, KERF_ACTION_RELEASE = 3, KERF_ACTION_EVENT = 4 };

/* The volume that a cut removes. */
enum { KERF_CUT_REGION = 0, KERF_CUT_THREAD = 1 };

typedef struct kerf_action {
    uint32_t kind;
    uint32_t value;
} kerf_action;

typedef struct kerf_commit_out {
    uint32_t size;
    uint32_t action_count; /* out, ≤ KERF_MAX_ACTIONS */
    kerf_action* action;
    double* signal;        /* out, declared order */
    kerf_thread* thread;   /* out: a thread, in the tool's frame before the motion; null: the host stores no threads */
    uint32_t thread_count; /* out: 1 if `thread` is a new thread or has changed, 0 otherwise */
    uint32_t reserved;
} kerf_commit_out;

enum { KERF_NEED_PARAM = 1, KERF_NEED_DRIVE = 2 };

/* A requirement of a law on its tool: a parameter or a drive with this id and dimension. */
typedef struct kerf_need {
    const char* id;
    const char* help;
    kerf_dimension dimension;
    uint32_t kind; /* KERF_NEED_… */
} kerf_need;

/* What a law leaves out on purpose, as bits of `does_not`. `kerf check` skips the tests of that; `kerf describe` and
 * the plugin's badge show it. */
enum {
    KERF_DOES_NOT_RESIST_SIDEWAYS = 1,   /* no force across its feed */
    KERF_DOES_NOT_DEPEND_ON_DENSITY = 2, /* the same force in soft and dense bone */
    KERF_DOES_NOT_BRAKE_TURNING = 4,     /* no torque about the shaft */
    KERF_DOES_NOT_REST_ON_BONE = 8,      /* no contact of a tool at rest */
    KERF_DOES_NOT_ALL = 15
};

/* A law takes the tools of its own plugin that `tools` lists; without `tools`, any tool that has all of `needs`. */
typedef struct kerf_force {
    uint32_t size;
    uint32_t state_size, state_align;
    const kerf_signal* signals;
    uint32_t signal_count;
    const kerf_event* events;
    uint32_t event_count;
    const char* const* tools; /* ids of tools of the same plugin */
    uint32_t tool_count;
    const kerf_need* needs;
    uint32_t need_count;
    uint32_t budget_ns; /* maximum time of one `resist` [ns] */
    /* Maximum work of one `resist`, for any parameters. `kerf check` counts it, with the same result on every machine.
       0: not declared. */
    uint32_t max_channels;
    uint32_t max_points; /* of all its queries together */
    uint32_t max_queries;
    uint32_t does_not; /* KERF_DOES_NOT_…, or 0 */
    /* Writes the initial state of the law. The parameters and the resolution of the bone stay the same until the host
       calls `begin` again: compute values that depend on them alone here. [haptic, nonblocking] */
    void (*begin)(const kerf_tick_in* in, void* state);
    /* Evaluates the law at the present pose. Pure: the host may call it again. Another status than KERF_OK releases the
       force, here and in `commit`. [haptic, nonblocking] */
    kerf_status (*resist)(const kerf_tick_in* in, const void* state, kerf_law* out);
    /* Updates the state with the motion that happened. Called once for each motion that was solved. Signals are finite
       numbers. [haptic, nonblocking] */
    kerf_status (*commit)(const kerf_tick_in* in, const kerf_advance* advance, void* state, kerf_commit_out* out);
} kerf_force;

/* ---- components and the entry --------------------------------------------------------------------------------- */

/* Kinds of components, and the version of each kind's table. The host skips components of an unknown kind. It refuses
 * a plugin with another version of a known kind. */
enum { KERF_KIND_TOOL = 1, KERF_KIND_FORCE = 2, KERF_KIND_REMESHER = 3, KERF_KIND_DEVICE = 4 };
enum { KERF_TOOL_VERSION = 1, KERF_FORCE_VERSION = 1, KERF_REMESHER_VERSION = 1, KERF_DEVICE_VERSION = 1 };

/* An optional part of a component: a planner may switch it off where a scene does not need it. */
enum {
    KERF_FEATURE_EFFECT = 1,     /* a physical effect: absent where its parameters are `off` */
    KERF_FEATURE_RESOLUTION = 2, /* a resolution: coarser and cheaper towards `off`; one parameter */
};
/* Entries with the same id are one feature and are switched together. */
typedef struct kerf_feature {
    const char* id;   /* snake_case */
    const char* help; /* one sentence: the effect of the feature */
    uint32_t kind;
    uint32_t param; /* index into the component's params */
    double off;     /* SI, within that parameter's range */
} kerf_feature;

struct kerf_remesher; /* kerf/remesh.h */
struct kerf_device;   /* kerf/device.h */

typedef struct kerf_component {
    uint32_t size;
    uint32_t kind;
    uint32_t version; /* of the kind's table: KERF_TOOL_VERSION … */
    uint32_t param_count;
    uint32_t feature_count;
    uint32_t reserved;
    const char* id;           /* unique among the plugin's components of its kind; no dot in a strategy's or device's */
    const char* help;         /* one sentence */
    const kerf_param* params; /* [library] */
    const kerf_feature* features; /* [library] */
    union {                       /* [library]; by kind */
        const void* table;
        const kerf_tool* tool;
        const kerf_force* force;
        const struct kerf_remesher* remesher;
        const struct kerf_device* device;
    };
} kerf_component;

/* ---- the host ------------------------------------------------------------------------------------------------ */

/* The interface that a host offers to a plugin: services by id and version. */
typedef struct kerf_host {
    uint32_t size;
    uint32_t abi;
    const char* name;    /* "kerf" */
    const char* version; /* "0.1.0" */
    /* Returns a service, or null where this host does not offer that version of it. [main] */
    const void* (*find)(const struct kerf_host* host, const char* id, uint32_t version);
} kerf_host;

/* Service `kerf.log`: kerf_log. Prints lines of a plugin under the plugin's name. */
#define KERF_LOG_ID "kerf.log"
#define KERF_LOG_VERSION 1u
enum { KERF_LOG_NOTE = 0, KERF_LOG_WARNING = 1 };
typedef struct kerf_log {
    uint32_t size;
    uint32_t reserved;
    /* Prints one line, at most 500 bytes of it. After 100 lines of a plugin it prints no more. [main], or in a
       strategy's call */
    void (*write)(const kerf_host* host, uint32_t level, const char* text);
} kerf_log;

/* Sizes of all structs that cross the boundary. With them the loader names a struct that differs. */
typedef struct kerf_layout {
    uint32_t param, drive, signal, event, solid, tool_shape, tool, bone_sample, surface_point, bone_query, channel, law,
        tick_in, advance, action, commit_out, force, component, feature, need, thread, host, log;
} kerf_layout;

#define KERF_LAYOUT_INIT                                                                                             \
    {                                                                                                                \
        sizeof(kerf_param), sizeof(kerf_drive), sizeof(kerf_signal), sizeof(kerf_event), sizeof(kerf_solid),         \
            sizeof(kerf_tool_shape), sizeof(kerf_tool), sizeof(kerf_bone_sample), sizeof(kerf_surface_point),        \
            sizeof(kerf_bone_query), sizeof(kerf_channel), sizeof(kerf_law), sizeof(kerf_tick_in),                   \
            sizeof(kerf_advance), sizeof(kerf_action), sizeof(kerf_commit_out), sizeof(kerf_force),                  \
            sizeof(kerf_component), sizeof(kerf_feature), sizeof(kerf_need), sizeof(kerf_thread), sizeof(kerf_host), \
            sizeof(kerf_log)                                                                                         \
    }

typedef struct kerf_entry {
    uint32_t magic;
    uint32_t abi;
    uint32_t size;
    uint32_t component_count;
    kerf_layout layout;
    const char* plugin_id;            /* "kerf.drilling" */
    const char* plugin_version;       /* "0.1.0" */
    const char* licence;              /* SPDX */
    const char* toolchain;            /* printed, but not compared */
    const kerf_component* components; /* [library] */
    /* Called once after loading, before any other function of the plugin. Null: not needed. A status other than KERF_OK
       refuses the plugin. [main] `host` is valid while the library is loaded [library] */
    kerf_status (*open)(const kerf_host* host);
} kerf_entry;

#define KERF_ENTRY_SYMBOL "kerf_plugin_entry"

#ifdef __cplusplus
}
#endif
#endif
