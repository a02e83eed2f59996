// SPDX-License-Identifier: Apache-2.0
#include "app/remesh_session.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/interruption.h"
#include "app/outputs.h"
#include "app/progress.h"
#include "app/recorded_documents.h"
#include "app/replay.h"
#include "app/standard_streams.h"
#include "bone/exact/exact_surface.h"
#include "documents/yaml/read_map.h"
#include "run/exact/exact_files.h"
#include "run/exact/exact_strategies.h"
#include "session/content_hash.h"
#include "session/exact_summary.h"
#include "session/recorder.h"
#include "text/codes.h"
#include "text/printable_lines.h"
#include "text/write_file.h"

namespace kerf::app {
namespace {

namespace fs = std::filesystem;

std::string json_of(const bone::ExactSurface& made, const run::ExactStrategies& strategies) {
    const session::ExactRow row = run::exact_row(made, strategies);
    nlohmann::ordered_json all{{"notice", session::notice_line}};
    all.update(session::exact_summary(row));
    return text::printable_json(all.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace)) + "\n";
}

void print_table(const bone::ExactSurface& made, double seconds) {
    for (const std::string& note : made.notes) print(note + "\n");
    print(formatted("  %zu records in %zu straight stretches, %.1f s\n\n", made.records, made.stretches, seconds));
    print("  body   triangles   mesh, mm3   field, mm3\n");
    for (const bone::ExactPiece& piece : made.pieces)
        print(formatted("  %4zu %11zu %11.1f  %11.1f\n", piece.body, piece.mesh.mesh.triangles.size(),
                        piece.volume * 1e9, piece.field_volume * 1e9));
    print(formatted("\n  removed: mesh %.2f mm3, field %.2f mm3; a difference of %.2f mm3 is expected of the field\n",
                    made.removed * 1e9, made.field_removed * 1e9, made.allowed * 1e9));
    if (made.handed_over > 0)
        print(formatted("  %d of %zu stretches were handed over to a strategy that replaces the first\n",
                        made.handed_over, made.stretches));
    if (made.crumbs > 0)
        print(formatted("  %zu crumbs of %.3f mm3 that are no body of the field are left out\n", made.crumbs,
                        made.crumb_volume * 1e9));
    print("  digest " + session::hex16(made.digest) + "\n");
}

/// Returns the full id of the strategy that the user names. If none or several match, `error` lists the ids.
std::optional<std::string> full_id_of(const std::string& wanted, const ComponentCatalog& catalog, std::string& error) {
    std::vector<std::string> known, meant;
    for (const ComponentInfo& component : catalog) {
        if (component.kind != KERF_KIND_REMESHER) continue;
        known.push_back(component.full_id());
        if (component.matches_id(wanted)) meant.push_back(known.back());
    }
    if (meant.size() == 1) return meant.front();
    error = "the strategy `" + text::shown(wanted) + "` ";
    if (meant.size() > 1) {
        error += "has " + std::to_string(meant.size()) + " owners: expected one of " + documents::listed(meant) +
                 ". Write its full id.";
        return std::nullopt;
    }
    const std::string closest_one = documents::closest(wanted, known);
    error += known.empty()
                 ? "is not installed: no plugin with strategies is. Install the package `kerf-remesh-cgal`."
                 : "is unknown: expected " + documents::listed(known, wanted) + "." + documents::or_choose(closest_one);
    return std::nullopt;
}

/// Makes the surface when the session has been repeated, while its bone is still in memory.
class Remesher final : public run::RunObserver {
public:
    Remesher(const run::Scene& scene, const run::ExactStrategies& strategies, const Interruption& interruption)
        : scene_(&scene), strategies_(&strategies), interruption_(&interruption) {}

    void on_progress(double fraction, const std::string& /*what*/) override {
        show_progress(0.9 * fraction, "repeating the session");
    }
    [[nodiscard]] std::optional<run::RunEnd> end() override {
        return interruption_->has_come() ? std::optional(run::RunEnd::interrupted) : std::nullopt;
    }
    [[nodiscard]] std::string on_result(const session::RunSummary& /*summary*/, const Simulation& simulation) override {
        if (interruption_->has_come()) return {};
        show_work("");
        StillWorking sign_of_life("making the exact surface");
        bone::ExactTools tools = strategies_->tools(*scene_);
        tools.progress = [&](double fraction, const std::string& what) { sign_of_life.is_at(fraction, what); };
        tools.is_cancelled = [&] { return interruption_->has_come(); };
        made = bone::exact_surface(simulation, std::move(tools));
        return {};
    }

    bone::ExactSurface made;

private:
    const run::Scene* scene_;
    const run::ExactStrategies* strategies_;
    const Interruption* interruption_;
};

std::string write_pieces(const std::string& folder, const bone::ExactSurface& made, const std::string& json) {
    text::MadeFolders folders;
    std::string error = folders.make(folder);
    if (error.empty()) error = run::write_exact_surfaces(folder, made);
    if (error.empty()) error = text::write_file(folder + "/remesh.json", json);
    if (error.empty()) folders.keep();
    return error;
}

}  // namespace

ExitCode remesh_session(const RemeshOptions& options, const Environment& with) {
    std::string error;
    std::string wanted;
    if (!options.strategy.empty()) {
        const auto id = full_id_of(options.strategy, with.plugins.catalog(), error);
        if (!id) return complain("--strategy: " + error, exit_bad_input);
        wanted = *id;
    }
    std::string folder = options.out;
    if (folder.empty()) folder = fs::path(options.session).parent_path().string();
    if (folder.empty()) folder = ".";
    if (error = refusal_of_folder(folder); !error.empty()) return complain(error, exit_bad_input);
    RecordedDocuments of_session;
    if (const auto refusal = read_documents_of(options, with, of_session)) return complain(*refusal);
    const session::RecordedInputs& recorded = of_session.recorded;
    // While this process has one thread and little memory.
    run::ExactStrategies strategies(with.here.strategies(with.plugins));
    if (error = strategies.start(of_session.documents->procedure, wanted); !error.empty()) {
        print_error(text::to_text({text::error_about(of_session.file, text::code_text(text::Code::no_strategy),
                                                     "No exact surface can be made: " + error)}));
        return exit_fault;
    }
    const Interruption interruption;
    DocumentRefusal refusal;
    const auto bone = scene_of(of_session, options.session, refusal);
    if (!bone) return complain(refusal);

    run::RunRequest request;
    if (error = repeat(recorded, options.session, request); !error.empty()) return complain(error, exit_bad_input);
    Remesher remesher(*bone, strategies, interruption);
    request.observers = {&remesher};
    const auto start = std::chrono::steady_clock::now();
    const run::RunOutcome outcome = run::run_procedure(*bone, with.plugins, request);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!outcome.error.empty()) return complain(outcome.error, outcome.is_bad_input ? exit_bad_input : exit_fault);
    if (interruption.has_come()) return complain("interrupted; nothing is written", exit_fault);
    if (!recorded.hash.empty() && recorded.hash != session::hex16(outcome.summary.hash))
        return complain(options.session + ": the replay hash differs: got " + session::hex16(outcome.summary.hash) +
                            ", expected " + recorded.hash + ". The recorded cuts cannot be used.",
                        exit_fault);
    const bone::ExactSurface& made = remesher.made;
    if (!made.error.empty()) {
        for (const std::string& note : made.notes) print_error(note + "\n");
        return complain(made.error, exit_fault);
    }
    print_table(made, seconds);
    if (error = write_pieces(folder, made, json_of(made, strategies)); !error.empty())
        return complain(error, exit_fault);
    print("  " + folder + "/remesh.json\n" + session::notice_line + ".\n");
    return exit_pass;
}

}  // namespace kerf::app
