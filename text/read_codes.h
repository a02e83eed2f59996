// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <string>

/// Codes of all problems with documents. codes.cpp explains each one. The number is the code in messages: 412 is
/// `E0412`, as a warning `W0412`. A number is never reused, so that a search for it finds its meaning.
namespace kerf {

enum class Code {
    // The file and its YAML
    file_unreadable = 101,    ///< missing, a folder, or no permission
    file_too_large = 102,     ///< over 1 MB
    not_text = 103,           ///< not UTF-8, or contains a control character
    file_empty = 104,         ///< no content except comments
    syntax = 105,             ///< not YAML
    several_documents = 106,  ///< a second document after `---`
    nested_too_deep = 107,    ///< more than 64 levels
    duplicate_key = 108,      ///< a key twice in one map
    anchor_or_alias = 109,    ///< `&name` or `*name`
    tag = 110,                ///< `!name`
    key_not_text = 111,       ///< a key that is empty, a list or a map
    too_many_errors = 112,    ///< the rest is not shown

    // Its structure
    wrong_api_version = 201,
    wrong_kind = 202,  ///< an anatomy where a procedure is needed, or the reverse
    unknown_key = 203,
    missing_key = 204,
    wrong_shape = 205,   ///< a list where a map is needed, and the like
    empty_value = 206,   ///< a key without a value, or an empty list
    unknown_word = 207,  ///< not one of the few words allowed here
    duplicate_id = 208,
    malformed_word = 209,  ///< an id or a version in a wrong form
    path_outside = 210,    ///< absolute, or leaving the document's folder
    one_of = 211,          ///< not exactly one of several keys

    patch_nowhere = 212,      ///< a path to nothing
    nothing_to_remove = 213,  ///< `~` for an item that does not exist

    // References
    unknown_plugin = 301,
    unknown_tool = 302,
    unknown_force = 303,
    unknown_parameter = 304,
    unknown_drive = 305,
    unknown_instrument = 306,
    undeclared_zone = 307,      ///< not in needs.zones
    undeclared_landmark = 308,  ///< not in needs.landmarks
    unknown_limit = 309,        ///< a rehearsal expects a broken limit that no step has
    unused_instrument = 310,    ///< warning
    unknown_variant = 311,
    unknown_step = 312,     ///< a waypoint refers to a step that does not exist
    unknown_implant = 313,  ///< a waypoint inserts an implant that does not exist
    /// A step allows an event that its instrument does not report as damage, or a turn waits for it.
    unknown_event = 314,
    unknown_path = 315,          ///< a rehearsal follows a path that is not in `paths`
    unused_path = 316,           ///< warning
    unknown_signal = 317,        ///< a goal or limit refers to a signal that the step's law does not declare
    unknown_measure = 318,       ///< a goal or limit refers to a measure that does not exist
    unknown_construction = 319,  ///< a measure refers to an unknown landmark or construction
    unknown_strategy = 320,      ///< no plugin has the remeshing strategy, or two have one of this name

    // Numbers
    not_a_number = 401,
    missing_unit = 402,
    unknown_unit = 403,
    wrong_dimension = 404,
    not_three_numbers = 405,
    empty_bound = 406,    ///< neither at_least nor at_most, or at_least above at_most
    degenerate = 407,     ///< a solid or axis without extent, or an invalid shell
    contradiction = 408,  ///< a goal beyond a limit of its step, or two limits or goals that exclude each other
    out_of_range = 412,
    too_fine = 413,  ///< the bone would need too much memory

    // Requirements of the procedure on the anatomy
    missing_landmark = 501,
    missing_zone = 502,
    missing_tissue = 503,
    axis_is_a_point = 504,
    missing_midline = 505,
    missing_fracture = 519,
    other_landmark = 520,      ///< a limit needs an axis, or a point
    not_a_plane = 506,         ///< a step's `plane` is a point or an axis of the anatomy
    axis_off_plane = 507,      ///< a step's axis leads out of its plane
    needs_plane = 508,         ///< a quantity is measured in the plane of a step that has none
    needs_piece = 509,         ///< a step takes a piece that no step before it separates from the bone
    needs_hole = 510,          ///< a quantity is measured on the hole of a tool that makes none
    no_hole = 511,             ///< a thread has no hole to enter
    core_too_wide = 512,       ///< a screw's core is wider than its hole
    other_lead = 513,          ///< the leads of a tap and its screw differ
    screw_too_long = 514,      ///< its tip would leave the bone
    seats_too_soon = 515,      ///< its head seats before its goal is reached
    hole_too_wide = 517,       ///< a screw's thread does not reach the wall of its hole, or of its tap
    needs_implant = 518,       ///< a quantity of an implant is needed, and the tool is none
    needs_driver = 516,        ///< a waypoint regrips a tool without a thread that stays in bone
    closed_plate_hole = 521,   ///< metal closes the hole of an implant, or none surrounds it
    plate_off_bone = 522,      ///< an implant's planned pose meets no bone
    plate_in_bone = 523,       ///< an implant's planned pose lies through bone
    unknown_plate_hole = 524,  ///< a step's axis names a hole that no placed implant has
    narrow_plate_hole = 525,   ///< a screw's thread is wider than the hole it goes through
    wide_plate_hole = 526,     ///< a screw's head is narrower than the hole
    other_sort = 528,          ///< a measure is made of points where lines are needed, and the like
    no_measure = 529,          ///< the bone has no surface at the position of a measure
    missing_plate = 527,  ///< a rehearsal that is expected to pass uses a hole of an implant that is not placed yet

    // Fitted landmarks
    /// A fit refers to a landmark that is no fitted sphere, or its bone is selected by a landmark fitted from it.
    fit_reference = 618,

    // Data files. The codes of import are defined in the files that detect them
    no_data_file = 620,

    // Requirements on a run
    unknown_device = 701,
    too_many_tools = 702,   ///< more instruments than a run can have
    impossible_tool = 703,  ///< the plugin refuses these parameters
    path_too_short = 704,   ///< a rehearsal with fewer than two waypoints
    starts_in_bone = 705,
    narrow_kerf = 706,  ///< under two voxels
    blade_beyond_region = 707,
    narrow_hole = 708,  ///< under four voxels
    waypoint_beyond_region = 710,
    too_slow_to_cut = 711,
    short_of_goal = 712,
    short_of_time = 713,
    no_force_scale = 714,
    felt_below_friction = 715,
    narrow_guide = 716,     ///< a tool does not fit into its sleeve
    short_of_sleeve = 717,  ///< a tool does not reach through its sleeve
    no_strategy = 718,      ///< the strategy for an instrument's exact surface is not installed
};

/// Returns `E0412`; `W0412` for a warning.
inline std::string code_text(Code code, char letter = 'E') {
    char text[8];
    std::snprintf(text, sizeof text, "%c%04d", letter, static_cast<int>(code) % 10000);
    return text;
}

}  // namespace kerf
