// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/field/surface/mesh.h"
#include "kerf/abi.h"
#include "kerf/math.hpp"
#include "session/drawn_surface.h"

/// The results of a run as plain values. The recorder writes them, the report draws them.
namespace kerf::session {

/// Maximum number of recorded signals, over all tools of a run. Further signals are left out.
inline constexpr std::size_t max_signal_columns = 2 * KERF_MAX_SIGNALS;

/// One tick. SI units. Forces act on the hand, in the world frame (LPS) and in bone newtons, unless noted otherwise.
struct TickRow {
    std::uint64_t tick = 0;
    double time = 0.0;            ///< [s]
    std::int32_t step = -1;       ///< index of the running step; −1: none
    Pose device_from_handle{};    ///< input: pose that the device reported, world frame
    Pose world_from_tool{};       ///< the solved tool pose
    Vec6 modelled{};              ///< wrench of the bone on the tool, world frame, about the tip [N, N·m]
    Vec6 coupled{};               ///< wrench of the coupling on the hand, bone newtons
    Vec6 limited{};               ///< `coupled` after the device's limits
    Vec6 commanded{};             ///< wrench sent to the device (device newtons)
    double thrust = 0.0;          ///< [N] modelled, against the feed: positive while the bone resists
    double torque = 0.0;          ///< [N·m] about the shaft
    double depth = 0.0;           ///< [m] of the tip beyond the entry, along the step's axis; < 0 before it
    double feed_rate = 0.0;       ///< [m/s] of the tool along its shaft
    std::int32_t tissue = -1;     ///< index into Recording::tissues at the tip; −1: none
    std::int32_t iterations = 0;  ///< of the solve
    double power_hand = 0.0;      ///< [W] from the hand into the tool (bone newtons)
    double power_drive = 0.0;     ///< [W] from the motor
    double removed = 0.0;         ///< [m³] total so far
    double signals[max_signal_columns]{};
};

struct EventRow {
    std::uint64_t tick = 0;
    double time = 0.0;
    std::string id;  ///< core's closed vocabulary, or "<plugin>.<name>"
    std::string detail;
};

struct StepRow {
    std::string id, title;
    bool done = false;
    double start = 0.0, end = 0.0;  ///< [s]
    std::vector<std::string> broken_limits;
};

/// One measured number. `uncertainty` < 0: not known.
struct MetricRow {
    std::string id;  ///< "pilot-hole.depth"
    int revision = 1;
    std::string scope;  ///< step id, or "run"
    int occurrence = 1, occurrences = 1;
    double value = 0.0;     ///< SI
    std::string unit;       ///< display unit, "mm"
    double per_unit = 1.0;  ///< SI per display unit, 1e-3 for mm
    double uncertainty = -1.0;
    std::string status;  ///< "ok", "broken", "info"; "grade B/C" for graded metrics
    std::string help;
};

/// The scope of metrics that check the simulation itself, not the operation.
inline constexpr const char* simulation_scope = "simulation";
inline bool is_of_simulation(const MetricRow& metric) noexcept { return metric.scope == simulation_scope; }

struct CutRow {
    std::uint64_t sequence = 0, tick = 0;
    std::uint32_t body = 0, solid = 0;
    Pose from{}, to{};  ///< body_from_tool
};

struct SignalColumn {
    std::string id, help, unit;
    double per_unit = 1.0;
};

/// A connected piece of bone at the end of a run, or an implant in it.
struct PieceRow {
    std::size_t body = 0;  ///< 0: the first body, or its largest part
    double volume = 0.0;   ///< [m³]
    std::string file;      ///< its surface, in the session's folder
    bool is_metal = false;
};

/// The exact surface of a run, cut by strategies. Not part of the replay hash or of any verdict.
struct ExactRow {
    struct Strategy {
        std::string id, module, kernel;  ///< full id; the plugin's id and version; the library that results depend on
        std::uint64_t module_hash = 0;   ///< FNV-1a of the plugin's library
        std::vector<std::pair<std::string, std::string>> parameters;  ///< id, and value with its unit
    };
    struct Piece {
        std::size_t body = 0;
        std::string file;
        std::size_t triangles = 0;
        double volume = 0.0, field_volume = 0.0;                 ///< [m³]
        std::vector<std::pair<std::string, double>> wall_areas;  ///< [m²] of surface that tools left, by tissue
    };
    std::vector<Strategy> strategies;
    std::vector<Piece> pieces;                                 ///< empty without a surface
    std::uint64_t digest = 0;                                  ///< of all pieces
    std::string why_not;                                       ///< the reason for no exact surface; for people
    std::size_t records = 0, stretches = 0;                    ///< of the cut log; straight stretches joined from them
    double removed = 0.0, field_removed = 0.0, allowed = 0.0;  ///< [m³] the last: allowed difference of the first two
    std::size_t crumbs = 0;                                    ///< parts of the mesh without a body in the field
    double crumb_volume = 0.0;                                 ///< [m³]
    int refusals = 0, handed_over = 0;  ///< refused results; stretches declined by one strategy and cut by another
    std::vector<std::string> notes;     ///< for people
};

/// The clock of a run that was paced by time. Not part of the replay hash or of a replay.
struct ClockRow {
    struct Times {
        double median = 0.0, p99 = 0.0, p999 = 0.0, worst = 0.0;  ///< [s]
    };
    /// Ticks of a class of a histogram.
    struct Class {
        double up_to = 0.0;                       ///< [s] upper end
        std::uint64_t lateness = 0, compute = 0;  ///< ticks
    };
    struct SlowTick {
        std::uint64_t tick = 0;
        double lateness = 0.0, response = 0.0, compute = 0.0;  ///< [s] response: from the due time until all was done
        std::string cause, part;                               ///< for people; the part of the tick that took longest
        double part_time = 0.0;                                ///< [s]
        std::uint64_t page_faults = 0;
    };
    double period = 0.0;  ///< [s]
    std::uint64_t ticks = 0, late_ticks = 0, missed_periods = 0;
    std::uint64_t pauses = 0;  ///< gaps of three missed periods or more
    /// Times at which the force began to fade: after a pause of the machine, with the loss of the device, and for
    /// another fault, such as of a law or a leap of the hand.
    std::uint64_t fades_by_machine = 0, fades_by_device = 0, fades_by_fault = 0;
    std::uint64_t over_period = 0;  ///< ticks that computed longer than a period
    Times lateness, compute;
    std::vector<Class> histogram;                                    ///< in order of `up_to`
    std::vector<std::pair<std::string, std::uint64_t>> late_causes;  ///< late ticks by cause, for people
    std::vector<SlowTick> slowest;                                   ///< at most ten, the slowest first
    int priority = 0;                                                ///< of SCHED_FIFO; 0: normal class
    bool is_memory_locked = false;
    double load = 0.0;  ///< [–] mean load of one minute at the end
    std::string kernel;
    std::vector<std::string> refusals;  ///< of the system, for people
};

enum class Verdict { pass, fail, incomplete, invalid };
const char* to_text(Verdict verdict) noexcept;

/// A part of the score that a run did not earn.
struct DeductionRow {
    std::string step{};          ///< id; empty: the whole run
    std::string kind{};          ///< "limit", "goal", "metric", "step" or "run"
    std::string name{};          ///< of the limit, goal or metric
    std::string detail{};        ///< for people; may be empty
    std::optional<double> at{};  ///< [s] when it was decided
    double loss = 0.0;           ///< points of the score
};

/// A zone of the anatomy, at its pose at the end.
struct ZoneRow {
    std::string id;
    DrawnSurface surface{};
};

/// Where the tool came closest to a zone in a step with a limit on it.
struct ApproachRow {
    std::string step, zone;  ///< ids
    double clearance = 0.0;  ///< [m] negative inside the zone
    double time = 0.0;       ///< [s]
    Vec3 at{};               ///< [m] point of the tool's outline; world frame, moved with the zone since then
};

struct RunSummary {
    std::string procedure, procedure_version, anatomy, rehearsal, hand, device;
    std::string leader{};            ///< name of the device whose user led the tool; empty: none did
    std::string parent{};            ///< uuid of the session that this one continues; empty: none
    std::uint64_t parent_ticks = 0;  ///< number of its ticks that this one repeats
    std::string leader_setup{};      ///< its setup on its table, as one line; empty: none led the tool
    std::string variant{};           ///< of the procedure; empty for none
    Verdict verdict = Verdict::incomplete;
    std::vector<std::string> reasons;
    bool is_missing = false;  ///< a goal was missed, a limit not measured, or the run ended early
    double score = 0.0;       ///< [–] 0 … 100
    int score_rules = 1;      ///< version of the rules that made it; 1: goals and limits that were met
    std::string score_band{};
    std::vector<DeductionRow> deductions{};  ///< they add up to 100 less the score
    double duration = 0.0;                   ///< [s] simulated
    std::vector<StepRow> steps;
    std::vector<MetricRow> metrics;
    std::uint64_t ticks = 0;
    double removed = 0.0;                                           ///< [m³]
    std::vector<std::pair<std::string, double>> removed_by_tissue;  ///< [m³]
    std::vector<PieceRow> pieces{};
    double force_scale = 1.0, coupling_stiffness = 0.0;  ///< K_c [N/m], device newtons
    std::uint64_t hash = 0;
    std::vector<std::pair<std::string, std::string>> versions;
    std::vector<std::string> tissues;
    std::vector<SignalColumn> signals;
    std::vector<std::string> anatomy_notes;  ///< messages of the import, for people
    std::vector<ZoneRow> zones{};            ///< only in the session, for its report
    std::vector<ApproachRow> approaches{};   ///< only in the session, for its report
    std::optional<ExactRow> exact{};         ///< if an instrument leaves an exact surface
    std::optional<ClockRow> clock{};         ///< of a run on the clock
};

}  // namespace kerf::session
