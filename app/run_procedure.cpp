// SPDX-License-Identifier: Apache-2.0
#include "app/run_procedure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

#include "app/belongings.h"
#include "app/hand_inputs.h"
#include "app/run_metrics.h"
#include "app/signal_table.h"
#include "core/field/bone_surface.h"
#include "core/field/removed_volume.h"
#include "core/procedure/quantity.h"
#include "core/procedure/read_map.h"
#include "core/session/content_hash.h"
#include "core/session/envelope.h"
#include "core/session/read_run.h"
#include "core/session/recorder.h"
#include "core/session/report.h"
#include "core/session/stl.h"
#include "core/session/summary.h"
#include "core/session/write_file.h"

namespace kerf {

namespace {

constexpr int volume_interval = 50;  // ticks between counts of the removed volume
constexpr double crumb = 10e-9;      // [m³] smaller pieces are no bodies: they are washed away

std::vector<std::size_t> bodies_of(const Separation& separation) {
    std::vector<std::size_t> bodies;
    for (const auto& part : separation.parts) bodies.push_back(part.body);
    return bodies;
}

/// SQLite keeps no −0: an input is made the way it will be read again, so that a replay starts from the same bits.
Pose without_negative_zeros(const Pose& p) {
    return {{p.position.x + 0.0, p.position.y + 0.0, p.position.z + 0.0},
            {p.rotation.w + 0.0, p.rotation.x + 0.0, p.rotation.y + 0.0, p.rotation.z + 0.0}};
}

/// How deep the tip is below the surface of the bone as it was before any cut [m], where the body has moved to.
double tip_inside(const Simulation& simulation, const StepMonitor& monitor, Vec3 tip) {
    const auto& owners = monitor.owners().step;
    const std::size_t owner = owners.empty() ? 0 : owners[std::min(monitor.current(), owners.size() - 1)];
    const LiveBody& live = *simulation.bodies()[owner];
    return -uncut_distance(*live.bone, locate(*live.bone, inverse(live.world_from_body) * tip));
}

/// The material under the tip, present bone only; −1 in air.
std::int32_t tissue_at(const Scene& scene, const Simulation& simulation, Vec3 tip) {
    // A voxel ahead of the tip: the tip itself lies on the border of what it cut.
    const Vec3 ahead = tip + scene.procedure.spacing * rotate(simulation.world_from_tool().rotation, {0, 0, 1});
    const BrickPlace place = locate(scene.body, ahead);
    if (std::max(scene.body.surface.at(place), simulation.exact().at(place)) > 0.0) return -1;
    double weight[KERF_MAX_TISSUES];
    material_weights(scene.body, place, weight);
    return static_cast<std::int32_t>(std::max_element(weight, weight + scene.body.materials.size()) - weight);
}

TickRow row_of(const TickResult& result, const Scene& scene, const Simulation& simulation, const StepMonitor& monitor,
               const SignalTable& signals, const Pose& handle, std::int32_t tissue, double removed) {
    TickRow row;
    row.tick = simulation.ticks() - 1;
    row.time = static_cast<double>(row.tick) * Simulation::dt;
    row.step = monitor.current() < scene.procedure.steps.size() ? static_cast<std::int32_t>(monitor.current()) : -1;
    row.device_from_handle = handle;
    row.world_from_tool = result.world_from_tool;
    row.modelled = result.bone_on_tool;
    row.coupled = result.coupled_on_hand;
    row.limited = result.limited_on_hand;
    row.commanded = result.command.wrench;
    row.thrust = result.thrust;
    row.torque = result.torque;
    row.depth =
        scene.frames[std::min(monitor.current(), scene.frames.size() - 1)].depth_of(result.world_from_tool.position);
    row.feed_rate = result.rate[2];
    row.tissue = tissue;
    row.iterations = result.iterations;
    row.power_hand = result.power_hand;
    row.removed = removed;
    signals.fill(simulation, row);
    return row;
}

/// What the host knows of one of its own events beyond its id.
std::string detail_of(const std::string& event, const Simulation& simulation) {
    if (event == "haptics.quarantined") return text_of(simulation.law_fault());
    if (event != "haptics.unresisted") return "";
    const auto in_mm = [](double v) { return quantity_text(std::round(v * 1e4) * 1e-4, "mm"); };
    const Unresisted& where = simulation.unresisted();
    return "the tool, " + in_mm(-where.point.z) + " behind its tip, is " + in_mm(where.depth) +
           " or more in uncut bone, and no channel of " + name_of_law(*simulation.setup().force) + " resists it there";
}

std::string text_of(const Separation& separation) {
    const auto volume = [](double v) { return quantity_text(std::round(v * 1e9) * 1e-9, "mm3"); };
    std::string text;
    if (separation.parts.size() > 1)
        for (const auto& part : separation.parts)
            text += (text.empty() ? "body " : ", body ") + std::to_string(part.body) + ": " + volume(part.volume);
    if (separation.crumbs == 0) return text;
    return text + (text.empty() ? "" : "; ") + std::to_string(separation.crumbs) +
           (separation.crumbs == 1 ? " crumb, " : " crumbs, ") + volume(separation.crumb_volume);
}

/// What was cut already when a step began.
class CutBefore {
public:
    void begin(const PresentBone& bone) {
        cut_.clear();
        came_from_.clear();
        for (std::size_t body = 0; body < bone.count(); ++body) {
            cut_.push_back(bone.cut(body));
            came_from_.push_back(body);
        }
    }
    /// There are other bodies now: those that came apart since then were part of others.
    void follow(const PresentBone& bone) {
        came_from_.resize(std::min(came_from_.size(), bone.count()));
        for (std::size_t body = came_from_.size(); body < bone.count(); ++body) {
            const std::size_t before = bone.piece(body).came_off;
            if (before == body) cut_.push_back(CutField(*bone.piece(body).bone, 0));  // there was no such bone
            came_from_.push_back(before == body ? cut_.size() - 1 : came_from_[before]);
        }
    }
    /// Whether a point of a body may lie on an earlier cut: within half a voxel of it.
    [[nodiscard]] bool reaches(const Body& bone, std::size_t body, Vec3 p) const {
        return cut_[came_from_[body]].at(locate(bone, p)) > -0.5 * bone.grid().spacing;
    }
    /// Share of a body's bone at a point that was gone already [–].
    [[nodiscard]] double share_gone(const Body& bone, std::size_t body, Vec3 p) const {
        return std::clamp(0.5 + cut_[came_from_[body]].at(locate(bone, p)) / bone.grid().spacing, 0.0, 1.0);
    }

private:
    std::vector<CutField> cut_;
    std::vector<std::size_t> came_from_;
};

/// What the cut of a step, and no earlier one, has left of all bodies, each seen where it was before it moved.
std::optional<CutWall> wall_of(const Scene& scene, const Simulation& simulation, const CutBefore& before,
                               const StepMonitor& monitor, std::size_t step) {
    const AxisFrame& frame = scene.frames[step];
    if (frame.across == Vec3{}) return {};
    const WallWindow window{.entry = frame.entry,
                            .along = frame.along,
                            .normal = frame.across,
                            .half_width = scene.tool(step).outline.cutting.largest_radius(),
                            .depth = std::max(0.0, monitor.steps()[step].deepest)};
    std::vector<Vec3> points;
    const PresentBone& bone = simulation.present();
    for (std::size_t body = 0; body < bone.count(); ++body) {
        const Body& whole = *bone.piece(body).bone;
        std::vector<Vec3> some;
        add_wall_points(whole, bone.cut(body), window, some);
        std::copy_if(some.begin(), some.end(), std::back_inserter(points),
                     [&](Vec3 p) { return !before.reaches(whole, body, p); });
    }
    return fit_wall(points, window, scene.tool(step).outline.cutting.thickness());
}

/// The hole that a step, and no earlier one, has left in the body that its axis belongs to, seen where that body was
/// before it moved. Nothing for a blade.
std::optional<HoleResult> hole_of(const Scene& scene, const Simulation& simulation, const CutBefore& before,
                                  const StepMonitor& monitor, std::size_t step) {
    const ToolSolid& cutting = scene.tool(step).outline.cutting;
    const StepState& state = monitor.steps()[step];
    if (cutting.is_prism() || cutting.outline().empty() || !state.step->has_depth() || !state.has_cut_bone()) return {};
    const AxisFrame& frame = scene.frames[step];
    const std::size_t owner = monitor.owners().step[step];
    const PresentBone& bone = simulation.present();
    const Body& body = *bone.piece(owner).bone;
    const CutField& cut = bone.cut(owner);
    const double spacing = body.grid().spacing;
    const HolePlan plan{.entry = frame.entry, .along = frame.along, .depth = state.advance.front, .cutting = cutting};
    HoleResult result;
    result.hole = measure_hole(body, plan, [&](Vec3 p) {
        const BrickPlace place = locate(body, p);
        const double was = std::clamp(0.5 - uncut_distance(body, place) / spacing, 0.0, 1.0),
                     gone = std::clamp(0.5 + cut.at(place) / spacing, 0.0, 1.0);
        return was <= 0.0 || gone <= 0.0 ? 0.0 : was * std::max(0.0, gone - before.share_gone(body, owner, p));
    });
    if (!result.hole) return result;
    // Medial and lateral, cranial and caudal; without the landmark `midline` the sides have no names.
    const Vec3 to_side =
        frame.medial != Vec3{} ? frame.medial : rotate(quat_between({0, 0, 1}, frame.along), {1, 0, 0});
    const Vec3 up = cross(to_side, frame.along);
    for (const Limit& limit : state.step->limits)
        if (limit.quantity == "breach")
            result.breaches.emplace_back(limit.diameter, breach_of(body, plan, *result.hole, 0.5 * limit.diameter,
                                                                   to_side, up.z >= 0.0 ? up : -up));
    return result;
}

std::string surface_file(std::size_t body) { return body == 0 ? "bone.stl" : "bone-" + std::to_string(body) + ".stl"; }

/// The page of the session that lies in a folder.
std::string write_report(const std::string& folder) {
    std::string error;
    const auto run = read_run(folder + "/session.db", error, true);
    return run ? write_file(folder + "/report.html", report_html(run->summary, run->drawn))
               : folder + "/report.html could not be made: " + error;
}

void append(const Mesh& more, Mesh& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), more.vertices.begin(), more.vertices.end());
    mesh.normals.insert(mesh.normals.end(), more.normals.begin(), more.normals.end());
    mesh.tissue.insert(mesh.tissue.end(), more.tissue.begin(), more.tissue.end());
    for (const auto& [a, b, c] : more.triangles) mesh.triangles.push_back({a + first, b + first, c + first});
}
/// Each piece where it is at the end.
Mesh all_surfaces(const Simulation& simulation, int stride) {
    Mesh all;
    for (std::size_t body = 0; body < simulation.bodies().size(); ++body) {
        const LiveBody& live = *simulation.bodies()[body];
        if (!live.is_present) continue;
        Mesh one = bone_surface(*live.bone, simulation.exact(body), stride);
        for (Vec3& p : one.vertices) p = live.world_from_body * p;
        for (Vec3& n : one.normals) n = rotate(live.world_from_body.rotation, n);
        append(one, all);
    }
    return all;
}

}  // namespace

std::string refusal_of_rehearsal(const Procedure& procedure, const std::string& id) {
    std::vector<std::string> known;
    for (const Rehearsal& r : procedure.rehearsals) {
        if (id.empty() || r.id == id) return "";
        known.push_back(r.id);
    }
    return known.empty() ? "the procedure has no rehearsal, and there is no device. Add one under `rehearsals:`."
                         : "there is no rehearsal `" + id + "`. Write " + listed(known) + ".";
}

RunOutcome run_procedure(const Scene& scene, const PluginRegistry& plugins, const RunRequest& request) {
    RunOutcome outcome;
    if (outcome.error = refusal_of_rehearsal(scene.procedure, request.rehearsal); !outcome.error.empty()) {
        outcome.is_bad_input = true;
        return outcome;
    }
    const auto rehearsal =
        std::find_if(scene.procedure.rehearsals.begin(), scene.procedure.rehearsals.end(),
                     [&](const Rehearsal& r) { return request.rehearsal.empty() || r.id == request.rehearsal; });

    RunSummary& summary = outcome.summary;
    summary.procedure = scene.procedure.id;
    summary.procedure_version = scene.procedure.version;
    summary.variant = scene.procedure.variant;
    summary.anatomy = scene.anatomy.id;
    summary.rehearsal = rehearsal->id;
    summary.hand = request.replay.empty() ? "simulated" : "replay";
    summary.device = scene.device->id;
    summary.force_scale = scene.gains.force_scale;
    summary.coupling_stiffness = scene.procedure.is_direct ? 0.0 : scene.gains.stiffness;
    summary.versions.emplace_back("kerf", KERF_VERSION);
    for (const auto& plugin : plugins.plugins())
        summary.versions.emplace_back(plugin->entry().plugin_id, plugin->entry().plugin_version);
    for (const auto& material : scene.body.materials) summary.tissues.push_back(material.id);
    const SignalTable signals(scene.tools);
    summary.signals = signals.columns;
    summary.anatomy_notes = scene.import.notes;

    // The record is open before the first tick, so that whatever happens leaves something to read.
    OutputLock lock;
    MadeFolders made;
    std::unique_ptr<Recorder> recorder;
    if (!request.out.empty()) {
        if (outcome.error = prepare_output(request.out, lock, made); !outcome.error.empty()) {
            outcome.is_bad_input = true;
            return outcome;
        }
        SessionHeader header;
        header.procedure = summary.procedure;
        header.procedure_version = summary.procedure_version;
        header.anatomy = summary.anatomy;
        header.rehearsal = summary.rehearsal;
        header.hand = summary.hand;
        header.procedure_text = scene.procedure.text;
        header.anatomy_hash = scene.anatomy_hash;
        header.anatomy_notes = scene.import.notes;
        header.versions = summary.versions;
        header.envelope.uuid = random_uuid();
        header.envelope.start = utc_now();
        header.envelope.learner = request.learner;
        header.envelope.mode = request.mode;
        header.conditions = {scene.device->id, scene.gains.force_scale, "", summary.coupling_stiffness,
                             scene.procedure.variant};
        header.signals = summary.signals;
        header.tissues = summary.tissues;
        auto created = Recorder::create(request.out + "/session.db", header);
        if (created.recorder == nullptr) {
            outcome.error = created.error;
            return outcome;
        }
        recorder = std::move(created.recorder);
        made.keep();
    }

    const HandPlan plan = plan_of(*rehearsal, scene);
    simulated_hand::SimulatedHand hand(plan.plant, plan.intent, plan.start, Simulation::dt);
    Simulation simulation(scene.body, scene.tools, scene.gains, plan.start);
    HandInputs hand_inputs(plan, request.replay.empty() ? nullptr : &request.hand_inputs);
    simulation.look_for_pieces(crumb);
    if (!request.replay.empty()) simulation.replay_adoptions(request.adoptions);
    StepMonitor monitor(scene.procedure, scene.anatomy, scene.frames);
    std::vector<Pose> world_from_body(1, identity_pose());
    CutBefore before;
    before.begin(simulation.present());
    double removed = 0.0, removed_before_step = 0.0;  // [m³]
    ContentHash hash;
    RunEnd end = RunEnd::time_over;

    const auto add_event_at = [&](std::uint64_t tick, const std::string& id, const std::string& detail) {
        EventRow event;
        event.tick = tick;
        event.time = static_cast<double>(event.tick) * Simulation::dt;
        event.id = id;
        event.detail = detail;
        kerf::add_event(hash, event);
        if (recorder) recorder->push_event(event);
        if (request.on_event) request.on_event(Recorder::as_kept(std::move(event)));
    };
    const auto add_event = [&](const std::string& id, const std::string& detail) {
        add_event_at(simulation.ticks() - 1, id, detail);
    };

    // Undo and redo leave other bodies than there were.
    const auto find_owners = [&] {
        Owners owners = monitor.owners();
        std::fill(owners.zone.begin(), owners.zone.end(), std::size_t{0});
        std::fill(owners.step.begin(), owners.step.end(), std::size_t{0});
        pass_on(owners, 0, parts_of_the_bone(simulation.present()), scene, simulation.present());
        monitor.belong(std::move(owners));
    };

    // The tick is that after which the loop took the parts over.
    const auto take_separations = [&](std::uint64_t tick) {
        for (const Separation& separation : simulation.take_separations()) {
            add_event_at(tick, separation.parts.size() > 1 ? came_apart_event : crumbled_event, text_of(separation));
            before.follow(simulation.present());
            Owners owners = monitor.owners();
            pass_on(owners, separation.parent, bodies_of(separation), scene, simulation.present());
            monitor.belong(std::move(owners));
        }
    };
    const auto where_they_are = [&] {
        world_from_body.clear();
        for (const auto& body : simulation.bodies()) world_from_body.push_back(body->world_from_body);
    };

    const auto record_cuts = [&] {
        if (recorder == nullptr) return;
        for (const CutRecord& record : simulation.closed())
            recorder->push_cut({record.sequence, record.tick, record.body, record.solid, record.from, record.to});
    };

    const auto lead = [&] {
        std::optional<Guide> guide = scene.guides[monitor.current()];
        if (guide) guide->body = monitor.owners().step[monitor.current()];
        simulation.lead(guide);
    };
    lead();
    const auto most_ticks = static_cast<std::uint64_t>(scene.procedure.time_limit / Simulation::dt);
    while (simulation.ticks() < most_ticks) {
        const bool is_replay = !request.replay.empty();
        if (const std::size_t tool = scene.tool_of_step[monitor.current()]; tool != simulation.tool()) {
            simulation.take_tool(tool);
            record_cuts();
            take_separations(simulation.ticks());
            add_event_at(simulation.ticks(), "tool.taken", scene.procedure.steps[monitor.current()].instrument);
        }
        for (const HandInput& input : hand_inputs.take(simulation.ticks(), hand.leg())) {
            add_event_at(simulation.ticks(), hand_input_event, text_of(input));
            const std::string why_not = carry_out(input, scene, simulation);
            if (!why_not.empty()) {
                add_event_at(simulation.ticks(), "hand.refused", text_of(input) + ": " + why_not);
            } else if (input.kind != HandInput::Kind::drive) {
                if (input.kind == HandInput::Kind::undo || input.kind == HandInput::Kind::redo ||
                    input.kind == HandInput::Kind::subtract)
                    record_cuts();
                if (input.kind == HandInput::Kind::undo || input.kind == HandInput::Kind::redo) find_owners();
                before.follow(simulation.present());
            }
        }
        const Pose handle = without_negative_zeros(is_replay ? request.replay[simulation.ticks()] : hand.reported());
        const TickResult result =
            scene.procedure.is_direct ? simulation.tick_direct({handle}) : simulation.tick({handle});
        simulation.after_tick();
        if (!is_replay) hand.step(result.command, result.world_from_tool.position);

        if (simulation.ticks() % volume_interval == 0) removed = simulation.present().removed();
        take_separations(simulation.ticks() - 1);
        where_they_are();
        const double now = static_cast<double>(simulation.ticks() - 1) * Simulation::dt;
        const std::size_t step = monitor.current();
        const Vec3 tip = result.world_from_tool.position;
        const std::int32_t tissue = tissue_at(scene, simulation, tip);
        monitor.observe({.time = now,
                         .world_from_tool = result.world_from_tool,
                         .is_running = result.is_cutting,
                         .is_resisted = result.thrust > 0.0 && !result.is_at_metal,
                         .thrust = result.thrust,
                         .world_from_body = world_from_body,
                         .held = simulation.held(),
                         .is_bone_ahead = tissue >= 0,
                         .tip_inside = tip_inside(simulation, monitor, tip),
                         .handle = handle.position},
                        simulation.outline().cutting);
        const TickRow row = row_of(result, scene, simulation, monitor, signals, handle, tissue, removed);
        add_tick(hash, row);
        if (request.on_tick) request.on_tick(row);
        const auto add_news = [&] {
            for (const auto& [id, detail] : monitor.news()) add_event(id, detail);
        };
        add_news();
        if (monitor.current() != step) {
            removed = simulation.present().removed();
            monitor.judge_cut(step, wall_of(scene, simulation, before, monitor, step), removed - removed_before_step,
                              now);
            add_news();
            if (auto hole = hole_of(scene, simulation, before, monitor, step)) {
                monitor.judge_hole(step, std::move(*hole), now);
                add_news();
            }
            removed_before_step = removed;
            before.begin(simulation.present());
            if (monitor.current() < scene.procedure.steps.size()) lead();
        }
        for (std::size_t i = 0; i < result.event_count; ++i) {
            add_event(result.events[i], detail_of(result.events[i], simulation));
            monitor.report(result.events[i], now);
            add_news();
        }
        if (recorder) {
            recorder->push(row);
            record_cuts();
            if (!recorder->wait_for_room()) {
                end = RunEnd::unrecorded;
                break;
            }
        }
        if (request.progress && simulation.ticks() % 250 == 0)
            request.progress(is_replay
                                 ? static_cast<double>(simulation.ticks()) / static_cast<double>(request.replay.size())
                                 : static_cast<double>(hand.leg()) / static_cast<double>(plan.intent.legs.size()),
                             "working, " + std::to_string(simulation.ticks() / 1000) + " s simulated");
        if (result.is_quarantined && linear(result.command.wrench) == Vec3{}) {  // it has faded
            end = RunEnd::fault;
            break;
        }
        if (monitor.current() >= scene.procedure.steps.size()) {
            end = RunEnd::steps_done;
            break;
        }
        if (request.is_interrupted && request.is_interrupted()) {
            end = RunEnd::interrupted;
            outcome.was_interrupted = true;
            break;
        }
        if (is_replay ? simulation.ticks() >= request.replay.size() : hand.is_done()) {
            end = RunEnd::path_ended;
            break;
        }
    }

    simulation.finish();
    record_cuts();
    take_separations(simulation.ticks());  // a tick that never came: a replay takes over what is left at its end too
    hash.add(simulation.present().hash());
    summary.duration = static_cast<double>(simulation.ticks()) * Simulation::dt;
    summary.ticks = simulation.ticks();
    summary.removed = simulation.present().removed();
    for (std::size_t m = 0; m < scene.body.materials.size(); ++m)
        summary.removed_by_tissue.emplace_back(scene.body.materials[m].id, simulation.present().removed_of_material(m));
    summary.hash = hash.value();
    judge(monitor, end, summary.duration, scene.procedure.time_limit, summary);
    if (end == RunEnd::fault) summary.reasons.front() += " " + text_of(simulation.law_fault());
    outcome.over_budget = simulation.laws_over_budget();
    summary.metrics = metrics_of(monitor, scene);
    summary.metrics.push_back(port_energy_row(simulation.passivity()));
    const PresentBone& bone = simulation.present();
    for (std::size_t body = 0; body < bone.count(); ++body)
        summary.pieces.push_back({body, bone_volume(*bone.piece(body).bone, bone.cut(body)), surface_file(body)});
    for (MetricRow& row : piece_metrics(summary, bone_volume(scene.body, CutField(scene.body, 0)) + bone.added(),
                                        bone.crumbs(), bone.crumb_volume()))
        summary.metrics.push_back(std::move(row));
    outcome.is_as_expected = ended_as_expected(*rehearsal, monitor, summary.verdict);

    if (recorder == nullptr) return outcome;
    if (request.progress) request.progress(1.0, "writing the results");
    const DrawnSurface drawn = drawn_surface(all_surfaces(simulation, 2));
    for (const std::string& error :
         {recorder->finish(summary, drawn), write_file(request.out + "/summary.json", summary_json(summary)),
          write_report(request.out)})
        if (!error.empty()) outcome.error += (outcome.error.empty() ? "" : "\n      ") + error;
    for (const PieceRow& piece : summary.pieces)
        if (const std::string error =
                write_file(request.out + "/" + piece.file,
                           stl_bytes(bone_surface(*bone.piece(piece.body).bone, bone.cut(piece.body))));
            !error.empty())
            outcome.error += (outcome.error.empty() ? "" : "\n      ") + error;
    return outcome;
}

}  // namespace kerf
