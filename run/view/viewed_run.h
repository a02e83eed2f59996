// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/field/surface/paged_table.h"
#include "kerf/math.hpp"
#include "run/device/mouse_totals.h"

/// All that a viewer needs of a run. A viewer includes no other header of Kerf. It shares no mutable state with the
/// run: values come out, commands go in.
///
/// Frames: world is LPS. Units: SI. Times count from the first tick.
namespace kerf::run {

// ---- what does not change during a run ----------------------------------------------------------------------------

/// Triangles of a shape in its own frame, anticlockwise seen from outside.
struct ViewedMesh {
    std::vector<std::array<float, 3>> positions{};  ///< [m]
    std::vector<std::array<float, 3>> normals{};    ///< unit, outwards; one per position
    std::vector<std::array<std::uint32_t, 3>> triangles{};
};

/// sRGB.
struct ViewedColour {
    std::uint8_t red = 0, green = 0, blue = 0;
};

struct ViewedTissue {
    std::string name{};
    ViewedColour colour{};
};

/// A quantity that a law reports in each tick.
struct ViewedSignal {
    std::string name{}, unit{};  ///< for people; no unit: a plain number
    double per_unit = 1.0;       ///< SI per unit
};

struct ViewedTool {
    std::string name{};    ///< for people
    ViewedMesh mesh{};     ///< tool frame: tip at z = 0, +z ahead of it
    ViewedMesh staying{};  ///< of an implant: the part that stays in bone; else empty
    bool is_implant = false;
    /// How a mouse moves it: across its axis, in the plane of a blade, or in the plane of the picture.
    enum class Lead : std::uint8_t { across, in_blade, facing } lead_by = Lead::across;
    double lead = 0.0;  ///< [m] per turn of its thread; 0: it has none
    std::string law{};  ///< name of its force model, for people
    std::vector<ViewedSignal> signals{};
};

struct ViewedZone {
    std::string name{};
    ViewedMesh mesh{};  ///< frame of its body; empty: not drawn
};

/// A goal or limit with its bound, for a bar or a line in a plot.
struct ViewedLimit {
    std::string words{};                          ///< "thrust at most 60 N"
    std::string quantity{};                       ///< "thrust", "depth", "torque", the id of a zone …
    std::string unit{};                           ///< for people; empty: a plain number
    double per_unit = 1.0;                        ///< SI per unit
    std::optional<double> at_least{}, at_most{};  ///< SI
};

struct ViewedStep {
    std::string title{};
    std::string hint{};    ///< how to do it; empty: none
    std::size_t tool = 0;  ///< index into `tools`
    std::vector<ViewedLimit> goals{}, limits{};
    std::optional<double> depth_goal{}, depth_limit{};  ///< [m]
    Vec3 entry{}, along{0, 0, 1};                       ///< of its axis before the first tick, world; `along` is a unit
    double length = 0.0;                                ///< [m] of the axis from its entry to the goal; 0: no plan
    std::optional<Vec3> plane_normal{};                 ///< unit, world, of a step with a plane
};

/// A position of the C-arm. Angles [rad] about the head's axis, 0: the source is in front of the patient, π/2: at the
/// left; and of the source towards the head.
struct ViewedArm {
    std::string words{};  ///< "AP", "lateral"
    double about_head_axis = 0.0, tilt = 0.0;
};

struct ViewedScene {
    std::string title{}, mode{};  ///< of the procedure; "practice"
    /// Zones, limits and plan are left out, and no state, event or word contains them.
    bool is_examination = false;
    /// Help with zones, limits, plan and hints. `off`: they are left out, as in an examination.
    enum class Assist : std::uint8_t { off, on_request, stepwise, full } assist = Assist::full;
    std::vector<ViewedTissue> tissues{};
    std::vector<ViewedTool> tools{};
    std::vector<ViewedMesh> implants{};  ///< shapes of bodies that are inserted whole, such as plates
    std::vector<ViewedZone> zones{};
    std::vector<ViewedStep> steps{};
    double spacing = 0.0;           ///< [m] of the cut field
    double time_limit = 0.0;        ///< [s]
    double repeated = 0.0;          ///< [s] of an earlier run, which this one repeats first, as fast as it can
    std::vector<ViewedArm> arms{};  ///< between which a viewer turns the C-arm; the first one is AP
    std::string hand{};             ///< "rehearsal expert", "mouse", the name of a device
    std::string note{};             ///< the part of the operation that the view lacks, for people; empty: none
    /// A sphere around the tool's motion, which a view without bone shows. `radius` [m] 0: it is unknown.
    Vec3 region_middle{};
    double region_radius = 0.0;
};

// ---- the surface --------------------------------------------------------------------------------------------------

struct ViewedVertex {
    float position[3];      ///< [m] body frame
    std::int8_t normal[3];  ///< unit, outwards, in 127ths
    std::uint8_t tissue;    ///< index into `ViewedScene::tissues`
    std::uint8_t light;     ///< 255: no bone shades the vertex; 0: bone all round
    std::uint8_t reserved[3];
};

/// The surface in the cells of one brick. Immutable: any thread may keep and read it.
struct ViewedPatch {
    std::vector<ViewedVertex> vertices{};
    std::vector<std::array<std::uint16_t, 3>> triangles{};  ///< anticlockwise seen from outside
};

/// The surface of a body. Unchanged patches keep their address from one surface to the next.
///
/// Brick (i, j, k) has the index (k · bricks[1] + j) · bricks[0] + i. Its triangles lie between the samples 8 (i, j, k)
/// and 8 (i + 1, j + 1, k + 1) of the grid. A vertex that belongs to two bricks has the same bits in both.
struct ViewedBodySurface {
    std::array<int, 3> bricks{};
    double spacing = 0.0;  ///< [m] of the samples
    Vec3 origin{};         ///< [m] of sample (0, 0, 0), body frame
    PagedTable<ViewedPatch> patches{0};
};

struct ViewedSurface {
    std::uint64_t version = 0;
    std::vector<ViewedBodySurface> bodies{};  ///< of bone; metal has empty tables
};

// ---- what changes with each tick ----------------------------------------------------------------------------------

inline constexpr std::size_t max_viewed_bodies = 16, max_viewed_limits = 24, max_viewed_zones = 16;

struct ViewedBody {
    enum class Kind : std::uint8_t { absent, bone, metal, staying_part, implant } kind = Kind::absent;
    std::uint16_t shape = 0;  ///< `staying_part`: index into `tools`; `implant`: into `implants`
    Pose world_from_body{};
};

/// The state after a tick. Forces are of bone, unless a line names the device.
struct ViewedState {
    std::uint64_t tick = 0;
    double time = 0.0;      ///< [s]
    std::int32_t step = 0;  ///< that runs; the number of steps after the last one
    std::uint32_t tool = 0;
    bool is_tool_in_hand = true;  ///< false: it was left with its implant
    Pose world_from_tool{}, world_from_handle{};
    std::array<ViewedBody, max_viewed_bodies> bodies{};
    std::uint32_t body_count = 0;

    double thrust = 0.0, torque = 0.0;     ///< [N], [N·m] of bone on the tool, against feed and spin
    double force = 0.0, hand_force = 0.0;  ///< [N] of bone on the tool; on the hand, as the device delivers it
    Vec3 force_on_tool{};                  ///< [N] world
    double depth = 0.0;                    ///< [m] of the tip beyond the entry of the step
    double feed = 0.0;                     ///< [m/s]
    double turned = 0.0;                   ///< [rad] of the tool about its axis in this step
    std::int32_t tissue = -1;              ///< at the tip; −1: none
    std::uint32_t cortices = 0;            ///< that the tip has passed in this step
    double removed = 0.0;                  ///< [m³]
    bool is_running = false;               ///< its drive runs, or it cuts

    std::uint32_t shown_zones = 0;                           ///< bit for each zone that is to be drawn now
    std::int32_t zone = -1;                                  ///< nearest of them; −1: none
    double zone_distance = 0.0;                              ///< [m] of the tool from it; negative inside
    std::array<std::uint8_t, max_viewed_zones> zone_body{};  ///< of each zone: the body with which it moves

    std::uint32_t goals_done = 0;                         ///< bit for each goal of the running step
    std::uint32_t broken = 0;                             ///< bit for each limit of the running step
    std::array<float, max_viewed_limits> limit_values{};  ///< SI: of each limit, worst so far; NaN: none yet

    bool has_help = false;         ///< zones, limits, plan and hint of the running step are to be shown
    std::uint32_t shots = 0;       ///< number of radiographs that were taken
    std::uint32_t late_ticks = 0;  ///< periods without a tick so far
    double device_scale = 1.0;     ///< [–] device newton per newton of bone
    bool is_device_lost = false, is_gate_closed = false, is_faulty = false;
    bool is_over = false;  ///< no tick follows
};

/// A fluoroscopic picture of the bone, with tools and implants: the patient seen from the source, the head up. Outside
/// the circle of the collimator it is black.
struct ViewedRadiograph {
    int columns = 0, rows = 0;
    std::vector<std::uint8_t> grey{};          ///< rows from the top, 0 black
    double time = 0.0;                         ///< [s]
    int shot = 0;                              ///< its number, from 1 on
    std::string words{};                       ///< "AP", "lateral"
    double about_head_axis = 0.0, tilt = 0.0;  ///< [rad], as in ViewedArm
    std::string error{};                       ///< not empty: there is no picture
};

// ---- the inside of a tick, for the author of a law ---------------------------------------------------------------

/// A point at which the law queries bone. Tool frame.
struct ViewedSample {
    Vec3 point{};      ///< [m]
    Vec3 direction{};  ///< unit: of an edge, along which it cuts; of a contact, out of the surface; zero: no bone is
                       ///< near
    /// [m] of a contact: signed distance to the present surface, negative inside; of an edge: distance that it must
    /// travel to uncut bone.
    double distance = 0.0;
    double engagement = 0.0;  ///< [–] of an edge, in the committed cut; of a contact 1 inside bone, else 0
    bool is_edge = false;
    std::int16_t body = -1;  ///< −1: none
};

/// One resistance of the law that the last step of a tick solved. Its force on the tool is −`force` × `along`, at
/// `point`, and its torque −`force` × `about`, about the tip. Tool frame.
struct ViewedChannel {
    enum class Kind : std::uint8_t { cut, contact, friction, hold } kind = Kind::contact;
    /// Null: of the plugin's law; else the name of a wall of the host, such as "metal". A literal.
    const char* wall = nullptr;
    std::uint32_t id = 0;
    Vec3 along{}, about{};  ///< [–], [m]
    Vec3 point{};           ///< [m] on the line of its force; the tip if it is a torque alone
    double rate = 0.0;      ///< [m/s] of the tool along it
    double force = 0.0;     ///< λ [N]
    double slope = 0.0;     ///< dλ/ds [N·s/m]
    double depth = 0.0;     ///< [m] δ of a contact or hold
    double gap = 0.0;       ///< [m] of a cut
};

/// The coupling after a tick. World frame. Forces in bone newtons.
struct ViewedCoupling {
    Pose world_from_handle{};             ///< as the device reported it
    Pose world_from_unstretched{};        ///< of a tool with the handle there and a coupling without stretch
    Vec3 grip_of_tool{}, grip_of_hand{};  ///< [m] the gripped point on the tool, and on the unstretched tool
    Vec3 stretch{};                       ///< [m] of the spring at the centre of compliance, from tool to handle
    double twist = 0.0;                   ///< [rad] of the spring
    Vec3 force{}, torque{};               ///< [N], [N·m] on the hand, within the limits; the torque about the grip
    double max_force = 0.0;               ///< [N]
    double max_torque_across = 0.0, max_torque_along = 0.0;  ///< [N·m] about lines across the shaft, and about it
    bool is_saturated = false;                               ///< the limits reduced force or torque in the tick
    double device_force = 0.0;                               ///< [N] commanded, device newtons
};

/// Signed distances on a square part of a plane. Column 0 is at the left, row 0 at the bottom.
struct ViewedSlice {
    Pose world_from_slice{};  ///< origin in the middle; x to the right, y upwards
    Pose tool_from_slice{};
    double step = 0.0;   ///< [m] between neighbouring samples
    int edge = 0;        ///< number of samples along each side
    double reach = 0.0;  ///< [m] to which distances are clamped
    /// [m] to the committed bone, negative inside: as edges read it. `edge` × `edge`, row by row.
    std::vector<float> distance{};
    /// Index of the tissue, −1: no bone, −2: a body that cannot be cut.
    std::vector<std::int8_t> tissue{};

    /// Returns the point of a sample [m], frame of the slice.
    [[nodiscard]] Vec3 point(int column, int row) const noexcept {
        const double middle = 0.5 * (edge - 1);
        return {step * (column - middle), step * (row - middle), 0.0};
    }
};

inline constexpr std::size_t max_viewed_signals = 16, max_viewed_samples = 1024;

/// The law of one tick, its forces, and the bone around the tool.
struct ViewedInspection {
    std::uint64_t tick = 0;  ///< number of ticks so far, as in ViewedState
    std::size_t tool = 0;    ///< index into `ViewedScene::tools`
    Pose world_from_tool{};
    std::vector<ViewedSample> samples{};    ///< of the law at `world_from_tool`, at most `max_viewed_samples`
    std::size_t sample_count = 0;           ///< number that the law queries
    std::vector<ViewedChannel> channels{};  ///< of the law, then of the host
    std::array<double, max_viewed_signals> signals{};  ///< SI, in the order of `ViewedTool::signals`
    Vec3 following{};  ///< [N] tool frame: force on the tool that is no channel, such as of a motor
    int parts = 1;     ///< of the tick; the channels are those of the last one
    ViewedCoupling coupling{};
    std::shared_ptr<const ViewedSlice> along{}, across{};  ///< through the axis, and at the tip across it
};

/// State and surface at one time.
struct ViewedMoment {
    ViewedState state{};
    std::shared_ptr<const ViewedSurface> surface{};
    std::shared_ptr<const ViewedInspection> inspection{};  ///< null: none was requested
};

/// A sample of the plots, one for each tick.
struct ViewedRow {
    double time = 0.0;  ///< [s]
    float force = 0.0f, hand_force = 0.0f, torque = 0.0f, turned = 0.0f, depth = 0.0f;
    std::int32_t step = 0;
};

struct ViewedEvent {
    double time = 0.0;  ///< [s]
    enum class Kind : std::uint8_t { note, goal, limit, step, image, fault } kind = Kind::note;
    std::string words{};
};

/// The result, after the last tick.
struct ViewedResult {
    std::string verdict{};  ///< "pass", "fail", "incomplete", "invalid"
    double score = 0.0;     ///< of 100; NaN: there is none
    std::vector<std::string> reasons{};
    struct Deduction {
        double points = 0.0, time = 0.0;  ///< [s]
        std::string words;
    };
    std::vector<Deduction> deductions{};  ///< largest first
    std::string folder{};                 ///< with report and session; empty: none
};

// ---- a run, seen by a viewer --------------------------------------------------------------------------------------

/// A run as its viewer sees it. One viewer at a time calls these functions, on one thread.
class ViewedRun {
public:
    virtual ~ViewedRun() = default;

    [[nodiscard]] virtual const ViewedScene& scene() const noexcept = 0;
    /// Writes the newest state. Returns whether it is newer than the last one.   nonblocking
    virtual bool take(ViewedState& state) noexcept = 0;
    /// Appends the rows since the last call.   nonblocking
    virtual void take(std::vector<ViewedRow>& rows) = 0;
    /// Appends the events since the last call.
    virtual void take(std::vector<ViewedEvent>& events) = 0;
    /// Appends the moments since the last call, about sixty for each second of the run.
    virtual void take(std::vector<ViewedMoment>& moments) = 0;
    /// Appends the radiographs that were made since the last call, in the order of their numbers.
    virtual void take(std::vector<std::shared_ptr<const ViewedRadiograph>>& /*radiographs*/) {}
    /// Returns the newest radiograph; null before the first one.
    [[nodiscard]] virtual std::shared_ptr<const ViewedRadiograph> radiograph() const { return nullptr; }
    /// Requests a radiograph of the bone as it is then; `ViewedState::shots` counts it when it is taken. While one is
    /// made, the newest request waits. A run that is over takes none; a replay repeats those of the run. Angles [rad]
    /// as in ViewedArm, at most a turn; others are ignored.   nonblocking
    virtual void request_radiograph(double /*about_head_axis*/, double /*tilt*/) {}
    /// Requests help with the running step, if `ViewedScene::assist` is `on_request`; `ViewedState::has_help` shows it.
    /// nonblocking
    virtual void request_help() {}
    /// Requests that each moment from now on has an inspection, or no longer. The run's thread makes them between
    /// ticks, and no result changes. An examination has none.   nonblocking
    virtual void request_inspection(bool /*is_wanted*/) noexcept {}
    /// Returns the newest surface; null before the first one.
    [[nodiscard]] virtual std::shared_ptr<const ViewedSurface> surface() const = 0;
    /// Returns the end of the last tick that there will be [s]; nothing if it is unknown, as in a live run.
    [[nodiscard]] virtual std::optional<double> duration() const noexcept = 0;
    /// Returns the next action of the running step in words; empty: it has none.
    [[nodiscard]] virtual std::string next_action() const = 0;
    /// Returns the result; nothing while the run continues or is judged.
    [[nodiscard]] virtual std::optional<ViewedResult> result() const = 0;
    /// Returns whether there is nothing more to show: the run failed to start or to write, or was ended elsewhere.
    [[nodiscard]] virtual bool is_closed() const noexcept = 0;
    /// Returns whether a mouse leads the tool.
    [[nodiscard]] virtual bool is_led_by_mouse() const noexcept = 0;
    /// Moves the aim of the hand, if a mouse leads it.   nonblocking
    virtual void lead(const MouseTotals& totals) noexcept = 0;
    /// Ends the run after the present tick; its results are written.
    virtual void stop() noexcept = 0;
};

}  // namespace kerf::run
