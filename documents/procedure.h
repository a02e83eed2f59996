// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/plugin/component_info.h"
#include "documents/anatomy.h"
#include "documents/assist.h"
#include "documents/hand_input.h"
#include "documents/implant_plan.h"
#include "documents/made/request.h"
#include "documents/measure_plan.h"
#include "documents/translations.h"
#include "kerf/math.hpp"
#include "text/source.h"

/// `kind: Procedure` as checked values: all SI, nothing left to parse. Reader: documents/read_procedure.h.
namespace kerf::documents {

struct ParameterSetting {
    std::string id;
    double value = 0.0;  ///< SI
};

/// A sleeve through which an instrument works, on the axis of its step.
struct Sleeve {
    double bore = 0.0;      ///< [m] its inner diameter
    double length = 30e-3;  ///< [m]
    double gap = 1e-3;      ///< [m] from its mouth to the planned entry
};

struct Instrument {
    std::string id;
    std::string plugin;                    ///< "kerf.drilling"
    std::string tool;                      ///< component id of kind tool
    std::string force;                     ///< component id of kind force
    std::string force_plugin;              ///< that of the force; most often `plugin`
    std::vector<double> tool_parameters;   ///< SI, declared order, defaults filled in
    std::vector<double> force_parameters;  ///< SI, declared order, defaults filled in
    std::vector<double> drives;            ///< SI, declared order, defaults filled in
    std::vector<EventInfo> damages{};      ///< events of the force that spoil the tool
    int hands = 0;                         ///< 1 or 2; 0: as many as the tool asks for
    std::optional<Sleeve> guide{};
    bool is_inserted = false;  ///< `remeshing: insert`: an implant that is released joins the scene as a body
    std::string remeshing{};   ///< strategy of the exact surface that it leaves, by full id; empty: none
    std::vector<ParameterSetting> remeshing_parameters{};  ///< those of the strategy that the document sets
};

/// A goal or limit on one number: `at_least` and/or `at_most`, SI.
struct Bound {
    std::optional<double> at_least, at_most;
};

/// A signal of a step's force law, as a goal or limit of the step names it.
struct NamedSignal {
    std::string id{};       ///< empty: none
    std::size_t index = 0;  ///< among the signals of the law
    std::string unit{};     ///< for people; "" for a plain number
};

struct Goal {
    /// "entry" (first bone met), "depth" (of the tip along the step's axis, from the entry [m]), "separated" (the bone
    /// has come apart, in this step or before), "held" (the tool holds the body that the step's axis leads to),
    /// "moved" (how far that body's bone has been moved, at the entry [m]), "removed_volume" (in the step [m³]) or
    /// "signal" (of the step's law [SI], in any tick of the step); or "measure" [rad] or [m], whenever the tool has
    /// come out of the bone.
    std::string quantity{};
    Bound bound{};  ///< of "depth", "moved", "removed_volume", "signal" and "measure"
    text::SourcePosition place{};
    NamedSignal signal{};   ///< for "signal"
    std::string measure{};  ///< for "measure": id of a Measure

    /// How results call it.
    [[nodiscard]] const std::string& name() const noexcept {
        return !signal.id.empty() ? signal.id : !measure.empty() ? measure : quantity;
    }
};

/// How bad it is to break a limit: it sets the band of the run's score.
enum class Severity : std::uint8_t { minor, serious, critical };

struct Limit {
    /// While the step lasts: "depth" [m], "clearance" (of the cutting region to `zone` [m], negative inside), "thrust"
    /// [N], "torque" about the shaft [N·m], "lateral_force" across the shaft [N], "speed" of the tip in bone [m/s],
    /// "removed_volume" [m³], "duration" [s], "signal" (of the step's law [SI]), "plunge" [m] past a far face,
    /// "time_in_air" [s] or "damage" (an event that spoils the tool). Forces are the bone's, unscaled.
    /// When it has ended, of the wall its cut left: "plane_angle" [rad], "plane_offset" [m] or "flatness" [m]; of the
    /// hole it left: "hole_angle" [rad], "entry_offset", "narrowest_offset", "end_offset", "breach" [m] or
    /// "excess_removal" [–]; of where things are then: "reduction_offset" [m], "reduction_angle", "axes_angle" [rad] or
    /// "tip_apex" [m]; or a "measure" of the bone [rad] or [m].
    std::string quantity{};
    std::string zone{};  ///< for "clearance"
    Bound bound{};
    std::string reason{};  ///< the sentence a trainee reads when it is broken
    text::SourcePosition place{};
    std::string event{};              ///< for "damage"
    double diameter = 0.0;            ///< [m] for "breach": of the cylinder that is to lie in the hole
    std::string landmark{}, other{};  ///< for "axes_angle" two axes, for "tip_apex" a point and an axis
    NamedSignal signal{};             ///< for "signal"
    std::string measure{};            ///< for "measure": id of a Measure
    Severity severity = Severity::serious;
    std::string guard{};  ///< why no hand breaks it in the shipped scene; empty if one does

    /// Measured on the wall of the cut, in the step's plane.
    [[nodiscard]] bool is_of_wall() const noexcept {
        return quantity == "plane_angle" || quantity == "plane_offset" || quantity == "flatness";
    }
    /// Measured on the hole that a turning tool left.
    [[nodiscard]] bool is_of_hole() const noexcept {
        return quantity == "hole_angle" || quantity == "entry_offset" || quantity == "narrowest_offset" ||
               quantity == "end_offset" || quantity == "breach" || quantity == "excess_removal";
    }
    /// Judged when the step has ended.
    [[nodiscard]] bool is_of_end() const noexcept {
        return is_of_wall() || is_of_hole() || is_of_places() || quantity == "measure";
    }
    /// Where parts of the bone and the tool are.
    [[nodiscard]] bool is_of_places() const noexcept {
        return quantity == "reduction_offset" || quantity == "reduction_angle" || quantity == "axes_angle" ||
               quantity == "tip_apex";
    }
    /// How rehearsals and results call it.
    [[nodiscard]] const std::string& name() const noexcept {
        return !zone.empty()        ? zone
               : !event.empty()     ? event
               : !signal.id.empty() ? signal.id
               : !measure.empty()   ? measure
                                    : quantity;
    }
};

inline constexpr double default_feed = 1e-3;  ///< [m/s] of a step that states none

struct Step {
    std::string id, title;
    std::string instrument;  ///< id of an Instrument
    std::string axis;        ///< name of the landmark axis, or of a hole: `plate.lag`
    std::vector<Goal> goals;
    std::vector<Limit> limits;
    std::string
        plane{};  ///< name of the landmark plane that the tool's flat side lies in; empty: turned anyhow about the axis
    std::string hint{};                  ///< how to do it, for the trainee; empty: none
    std::vector<std::string> allowed{};  ///< events that spoil the tool and do not fail this step
    double feed = default_feed;          ///< [m/s] at which the tool is meant to work

    /// Whether anything is to be reached in bone, and not only with a piece of it. A signal or measure belongs to
    /// either.
    [[nodiscard]] bool cuts() const noexcept {
        return std::any_of(goals.begin(), goals.end(), [&](const Goal& goal) {
            const bool is_of_either = goal.quantity == "signal" || goal.quantity == "measure";
            return !is_of_piece(goal) && (!is_of_either || !is_with_piece());
        });
    }
    /// Whether a piece is to be held or moved.
    [[nodiscard]] bool is_with_piece() const noexcept { return std::any_of(goals.begin(), goals.end(), is_of_piece); }
    [[nodiscard]] static bool is_of_piece(const Goal& goal) noexcept {
        return goal.quantity == "held" || goal.quantity == "moved";
    }
    /// Whether a depth is to be reached in bone.
    [[nodiscard]] bool has_depth() const noexcept {
        return std::any_of(goals.begin(), goals.end(), [](const Goal& goal) { return goal.quantity == "depth"; });
    }
};

inline constexpr double default_turning = 0.5;  ///< [1/s] of a hand that turns a driver: 30 rpm [assumed]

/// One waypoint of a rehearsal, in the frame of a step: depth along its axis, shifts and a tilt; and how the hand gets
/// there.
struct Waypoint {
    double depth = 0.0;  ///< [m] from the planned entry (the first bone along the axis) into the bone; < 0 outside
    bool is_across_surface = false;   ///< counted straight into the bone's surface at the entry, not along the axis
    double medial = 0.0;              ///< [m] sideways, towards the landmark `midline`
    double medial_angle = 0.0;        ///< [rad] the whole way, from the axis towards `midline`, about the planned entry
    double cranial_angle = 0.0;       ///< [rad] the same, from the axis towards the patient's head
    double aside = 0.0;               ///< [m] sideways in the step's plane, along the tool's x
    double off_plan = 0.0;            ///< [m] to a side that the step's frame chooses; only of a bad hand
    double tilt = 0.0;                ///< [rad] about the axis, out of the step's plane
    bool is_displaced = false;        ///< where the fracture has moved it to
    std::size_t step = 0;             ///< whose frame
    std::optional<double> speed{};    ///< [m/s] on the way there; none: the hand's feed or approach
    std::optional<double> push{};     ///< [N] on the way there; none: the hand's
    double skip_distance = 0.0;       ///< [m] beside the way at which it is given up; 0: never
    std::vector<HandInput> inputs{};  ///< asked for on arrival, in this order
    double turn = 0.0;                ///< [rad] by which the hand turns the tool about its z on the way there
    double turning = default_turning;     ///< [1/s] revolutions of that turn
    std::optional<double> turn_torque{};  ///< [N·m] with which the hand turns at most; none: what the driver withstands
    std::optional<double> until_torque{};  ///< [N·m] at which the turn is over
    std::string until_event{};             ///< of the tool's law, with which the turn is over; empty: none
    double regrip = 0.0;                   ///< [rad] after which the hand regrips; 0: never
};

inline constexpr double hardest_push = 500.0;  ///< [N] of a simulated hand

/// Intent, carried out by the simulated hand; it never writes the tool's pose.
struct Rehearsal {
    std::string id, title;
    std::string expect;           ///< "pass", "fail" or "incomplete"
    std::string expect_limit;     ///< for "fail": the zone (or quantity) whose limit must be the only one broken
    std::string expect_step{};    ///< for "fail": the only step in which it is broken; empty: any
    bool expects_others = false;  ///< for "fail": other limits may break too, and goals be missed
    double feed = 1e-3;           ///< [m/s] what the hand aims at in bone
    double approach = 10e-3;      ///< [m/s] in air
    double push = 60.0;           ///< [N] the most it pushes, bone side; no more than `hardest_push`
    double reaction = 0.15;       ///< [s]
    std::vector<Waypoint> path;
};

/// A metric of the results from which the score follows.
struct ScoredMetric {
    std::string metric;              ///< id in the results: "insert.entry-offset", "measure.gonial_angle.after"
    std::string step;                ///< whose goals it counts with; empty: the whole run
    std::string unit;                ///< for people
    double full = 0.0, none = 0.0;   ///< SI: what earns all, and nothing
    double weight = 1.0;             ///< [–]
    std::optional<double> target{};  ///< SI; `full` and `none` are then distances from it, to either side
    text::SourcePosition place{};
};

/// How true a procedure asks its forces and volumes to be, of what the same physics gives on the finest field [–].
struct Accuracy {
    double force = 0.07;   ///< a hand feels no less [pang-1991]; of the torque about the shaft as well
    double volume = 0.02;  ///< of bone removed
};
/// What it may cost.
struct Budget {
    double tick = 300e-6;   ///< [s] of the processor, 999 ticks of 1000
    bool is_given = false;  ///< by the procedure: only then is there anything to keep `kerf plan` looking
};

/// When a zone is drawn, if the trainee gets help.
struct ZoneDisplay {
    enum class Show { never, near, always, after } show = Show::always;  ///< `after`: once the run is over
    std::string zone{};
    double within = 5e-3;  ///< [m] of the tool: for `near`
};

/// The same procedure with a few values changed.
struct Variant {
    std::string id, title;
};

class Document;

struct Procedure {
    std::string file;  ///< as the user typed it; stderr only, never written to a result
    std::string id, title, version, status;
    std::vector<std::string> authors;
    std::string text;  ///< the document itself, for the session; with changes applied: what came of it
    std::shared_ptr<const Document> document;  ///< the places of its values; null for one that was never read
    std::string variant;                       ///< id of the one that was chosen; empty: none
    std::vector<Variant> variants;
    std::vector<std::string> needs_landmarks, needs_zones, needs_tissues;
    std::optional<MakeRequest> made{};  ///< an anatomy to make; otherwise a file
    std::string anatomy_name;           ///< as it is written
    std::string anatomy_file;           ///< resolved against the document's folder
    double spacing = 0.25e-3;           ///< [m] of the cut field
    Accuracy accuracy;
    Budget budget;
    std::string device;      ///< name of the device record the simulated hand holds
    bool is_direct = false;  ///< `coupling: direct`: the device's own rate goes into the law, as the papers do
    std::optional<double> force_scale;    ///< [–] device newton per bone newton; computed when absent
    std::optional<double> working_force;  ///< [N] of the bone, that the device holds with ease at the computed scale
    double time_limit = 120.0;            ///< [s] simulated
    std::vector<Instrument> instruments;
    std::vector<Implant> implants;
    std::vector<Construction> constructions;
    std::vector<Measure> measures;
    std::vector<Step> steps;
    Assist assist = Assist::full;
    std::vector<ZoneDisplay> zones;     ///< without one: a zone is always drawn
    Translations translations;          ///< of all words for people
    std::vector<ScoredMetric> scoring;  ///< empty: the score counts steps and limits
    std::vector<Rehearsal> rehearsals;
};

}  // namespace kerf::documents
