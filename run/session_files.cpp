// SPDX-License-Identifier: Apache-2.0
#include "run/session_files.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "bone/surface/write_stl.h"
#include "core/field/surface/bone_surface.h"
#include "core/haptics/loop/stated_device.h"
#include "core/plugin/process_notes.h"
#include "core/plugin/state_watch.h"
#include "run/exact/exact_files.h"
#include "session/clock_picture.h"
#include "session/envelope.h"
#include "session/report/read_run.h"
#include "session/report/report.h"
#include "session/summary.h"

namespace kerf::run {

namespace {

/// Returns a sentence about an error of a session whose file was damaged while it was open; empty for another error.
std::string note_of_damage(const std::string& error) {
    constexpr std::array<std::string_view, 4> damages{"malformed", "no such table", "not a database", "disk I/O error"};
    const bool is_damage = std::any_of(damages.begin(), damages.end(), [&](std::string_view damage) {
        return error.find(damage) != std::string::npos;
    });
    const ComponentName last = name_of(last_call().component);
    return is_damage && last.is_known()
               ? std::string(" Another program may have written over it, or the plugin that was "
                             "called last: ") +
                     last.plugin + " (" + last.path + ")."
               : "";
}

/// Writes the page of the session in a folder. Returns the error as text, empty on success.
std::string write_report(const std::string& folder) {
    std::string error;
    const auto run = session::read_run(folder + "/session.db", error, true);
    return run ? text::write_file(folder + "/report.html",
                                  session::report_html(run->summary, run->drawn, run->procedure))
               : folder + "/report.html could not be made: " + error;
}

void append(const Mesh& more, Mesh& mesh) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), more.vertices.begin(), more.vertices.end());
    mesh.normals.insert(mesh.normals.end(), more.normals.begin(), more.normals.end());
    mesh.tissue.insert(mesh.tissue.end(), more.tissue.begin(), more.tissue.end());
    for (const auto& [a, b, c] : more.triangles) mesh.triangles.push_back({a + first, b + first, c + first});
}
void place(Mesh& mesh, const Pose& to_from_mesh) {
    for (Vec3& p : mesh.vertices) p = to_from_mesh * p;
    for (Vec3& n : mesh.normals) n = rotate(to_from_mesh.rotation, n);
}
/// Returns the surfaces of all pieces at their final poses.
Mesh all_surfaces(const Simulation& simulation, int stride) {
    Mesh all;
    for (std::size_t body = 0; body < simulation.bodies().size(); ++body) {
        const LiveBody& live = *simulation.bodies()[body];
        if (!live.is_present) continue;
        Mesh one = bone_surface(*live.bone, simulation.exact(body), live.is_cuttable ? stride : 1);
        if (!live.is_cuttable) one.tissue.assign(one.vertices.size(), session::drawn_metal);
        place(one, live.world_from_body);
        append(one, all);
    }
    return all;
}

session::SessionHeader header_of(const Scene& scene, const RunRequest& request, const session::RunSummary& summary) {
    session::SessionHeader header;
    header.procedure = summary.procedure;
    header.procedure_version = summary.procedure_version;
    header.anatomy = summary.anatomy;
    header.rehearsal = summary.rehearsal;
    header.hand = summary.hand;
    header.leader = summary.leader;
    header.parent = summary.parent;
    header.parent_ticks = summary.parent_ticks;
    header.leader_setup = summary.leader_setup;
    for (const documents::Variant& variant : scene.procedure.variants)
        if (variant.id == scene.procedure.variant) header.variant_title = variant.title;
    header.procedure_text = scene.procedure.text;
    header.anatomy_hash = scene.anatomy_hash;
    header.anatomy_notes = scene.import.notes;
    header.versions = summary.versions;
    header.versions.insert(header.versions.end(), request.parts.begin(), request.parts.end());
    header.envelope.uuid = session::random_uuid();
    header.envelope.start = session::utc_now();
    header.envelope.learner = request.learner;
    header.envelope.mode = request.mode;
    header.conditions = {
        scene.device->id,           scene.gains.force_scale, to_text(request.assist_with(scene.procedure)),
        summary.coupling_stiffness, scene.procedure.variant, request.is_examination()};
    if (scene.device->is_connected) header.device_values = StatedDevice::values_of(*scene.device);
    header.signals = summary.signals;
    header.tissues = summary.tissues;
    return header;
}

}  // namespace

std::unique_ptr<SessionFiles> SessionFiles::create(const Scene& scene, const RunRequest& request,
                                                   const session::RunSummary& summary, RunOutcome& refusal) {
    std::unique_ptr<SessionFiles> files(new SessionFiles);
    files->folder_ = request.out;
    if (refusal.error = session::prepare_output(request.out, files->lock_, files->made_); !refusal.error.empty()) {
        refusal.is_bad_input = true;
        return nullptr;
    }
    auto created = session::Recorder::create(request.out + "/session.db", header_of(scene, request, summary));
    refusal.error = created.error;
    files->recorder_ = std::move(created.recorder);
    if (files->recorder_ == nullptr) return nullptr;
    files->made_.keep();
    note_record(request.out + "/session.db");
    return files;
}

void SessionFiles::on_cut(const CutRecord& cut) {
    recorder_->push_cut({cut.sequence, cut.tick, cut.body, cut.solid, cut.from, cut.to});
}

std::optional<RunEnd> SessionFiles::end() {
    return recorder_->wait_for_capacity() ? std::nullopt : std::optional(RunEnd::unrecorded);
}

std::string SessionFiles::on_exact_surface(const bone::ExactSurface& made) {
    return made.error.empty() && lock_.is_at(folder_) ? write_exact_surfaces(folder_, made) : std::string();
}

std::string SessionFiles::on_result(const session::RunSummary& summary, const Simulation& simulation) {
    std::string errors;
    const auto note = [&](const std::string& error) {
        if (!error.empty()) errors += (errors.empty() ? "" : "\n      ") + error;
    };
    check_state();  // before anything is written
    begin("writing the session");
    const std::string error = recorder_->finish(summary, session::drawn_surface(all_surfaces(simulation, 2)));
    if (!lock_.is_at(folder_))
        return folder_ +
               " is no longer there: it was removed, renamed, unmounted or replaced during the run. No results are "
               "written. If it was renamed, keep its session.db and session.db-wal together: they have the recorded "
               "rows.";
    note(error + note_of_damage(error));
    note(text::write_file(folder_ + "/summary.json", session::summary_json(summary)));
    begin("writing the report");
    if (!recorder_->is_removed()) note(write_report(folder_));
    begin("writing the surfaces");
    if (summary.clock) note(text::write_file(folder_ + "/clock.svg", session::clock_svg(summary, *summary.clock)));
    const PresentBone& bone = simulation.present();
    for (const session::PieceRow& piece : summary.pieces) {
        Mesh surface = bone_surface(*bone.piece(piece.body).bone, bone.cut(piece.body));
        if (piece.is_metal)  // at its pose in the bone, whose frame is the patient's
            place(surface,
                  inverse(simulation.bodies()[0]->world_from_body) * simulation.bodies()[piece.body]->world_from_body);
        note(text::write_file(folder_ + "/" + piece.file, bone::stl_bytes(surface)));
    }
    return errors;
}

}  // namespace kerf::run
