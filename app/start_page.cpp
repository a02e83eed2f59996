// SPDX-License-Identifier: Apache-2.0
#include "app/start_page.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <system_error>
#include <utility>
#include <vector>

#include "app/attempts.h"
#include "app/language.h"
#include "app/learner_code.h"
#include "app/listed_name.h"
#include "app/procedure_files.h"
#include "app/read_scene.h"
#include "run/device/opened_device.h"
#include "run/documents.h"
#include "run/view/scene_view.h"
#include "text/printable.h"

namespace kerf::app {

namespace {

namespace fs = std::filesystem;
using window::StartDetails;
using window::StartEntry;
using window::StartPage;
using window::StartProcedure;
using window::StartSelection;

/// Returns "4 steps with pilot, opener, tap".
std::string summary_of(const documents::Procedure& procedure) {
    std::vector<std::string> tools;
    for (const documents::Step& step : procedure.steps)
        if (std::find(tools.begin(), tools.end(), step.instrument) == tools.end()) tools.push_back(step.instrument);
    std::string text =
        std::to_string(procedure.steps.size()) + (procedure.steps.size() == 1 ? " step with " : " steps with ");
    for (std::size_t i = 0; i < tools.size(); ++i) text += (i == 0 ? "" : ", ") + run::spaced(tools[i]);
    return text::printable(text);
}

/// Returns the first error in a line.
std::string first_error(const text::Diagnostics& diagnostics) {
    for (const text::Diagnostic& one : diagnostics)
        if (one.level == text::Diagnostic::Level::error)
            return text::excerpt(
                (one.place.line > 0 ? "line " + std::to_string(one.place.line) + ": " : "") + one.message, 200);
    return "it cannot be read";
}

StartEntry entry_of(const std::string& id, const std::string& title) {
    return {id, text::printable(title.empty() ? run::spaced(id) : title)};
}

}  // namespace

StartPages::StartPages(const WindowOptions& options, const Environment& with)
    : with_(with), language_(language_for(options.language)), pictures_(with.plugins) {
    page_.attempts_folder = options.attempts;
    for (const auto& [word, level] : documents::assist_words) page_.assist_levels.emplace_back(word);
    open_folder(options.procedures);
}

void StartPages::open_folder(const std::string& folder) {
    std::error_code ignored;
    if (!folder.empty() && !fs::is_directory(folder, ignored))
        return set_message("`" + text::printable(folder) + "` is no folder. Write the folder of your procedures.",
                           true);
    const std::string shipped = with_.here.procedures();
    // The source tree has them in its root.
    page_.folder = !folder.empty() ? folder : fs::is_directory(shipped, ignored) ? shipped : "procedures";
    forget_message();
    read_procedures();
}

void StartPages::read_procedures() {
    page_.procedures.clear();
    page_.refused.clear();
    detailed_.clear();
    for (const std::string& file : procedures_in(page_.folder)) {
        text::Diagnostics diagnostics;
        const auto documents = run::check_documents(request_of(file, {}, with_.here), with_.plugins).take(diagnostics);
        if (!documents) {
            page_.refused.push_back(text::printable(fs::path(file).filename().string()) + ": " +
                                    first_error(diagnostics));
            continue;
        }
        const documents::Procedure& read = documents->procedure;
        StartProcedure one{
            file, read.id, text::printable(read.translations.of(read.title, language_)), summary_of(read), {}};
        for (const documents::Variant& variant : read.variants)
            one.variants.push_back(entry_of(variant.id, read.translations.of(variant.title, language_)));
        page_.procedures.push_back(std::move(one));
    }
}

const StartPage& StartPages::page(StartSelection& selection) {
    if (selection.procedure >= page_.procedures.size()) {
        selection.procedure = 0;
        selection.variant.clear();
        selection.rehearsal.clear();
    }
    find_devices(selection);
    read_details(selection);
    page_.learner_refusal = refusal_of_learner(selection.learner);
    if (learner_ != selection.learner) {
        learner_ = selection.learner;
        page_.attempts = page_.learner_refusal.empty() ? read_attempts(page_.attempts_folder, selection.learner)
                                                       : std::vector<window::StartAttempt>{};
    }
    return page_;
}

void StartPages::find_devices(StartSelection& selection) {
    constexpr auto interval = std::chrono::seconds(2);
    const auto now = std::chrono::steady_clock::now();
    if (searched_ && now - *searched_ < interval) return;
    searched_ = now;
    page_.devices = {{"mouse", "the mouse", {}}};
    for (const run::ListedDevice& device : run::find_devices(with_.plugins))
        if (!device.id.empty())
            page_.devices.push_back({name_of(device), text::printable(device.name), text::printable(device.problem)});
    const auto chosen = std::find_if(page_.devices.begin(), page_.devices.end(), [&](const window::StartDevice& one) {
        return one.id == selection.device && one.is_ready();
    });
    if (chosen == page_.devices.end()) selection.device.clear();
}

void StartPages::read_details(const StartSelection& selection) {
    if (page_.procedures.empty()) {
        page_.details = {};
        return;
    }
    const std::string& file = page_.procedures[selection.procedure].file;
    if (const std::string wanted = file + '\n' + selection.variant; std::exchange(detailed_, wanted) == wanted) return;
    page_.details = {};
    DocumentOptions options;
    options.variant = selection.variant;
    text::Diagnostics diagnostics;
    const auto documents = run::check_documents(request_of(file, options, with_.here), with_.plugins).take(diagnostics);
    if (!documents) {
        page_.details.error = first_error(diagnostics);
        return;
    }
    const documents::Procedure& read = documents->procedure;
    spacing_ = read.spacing;
    page_.details.time_limit = read.time_limit;
    page_.details.assist = to_text(read.assist);
    const auto shown = [&](const std::string& words) {
        return text::printable(read.translations.of(words, language_));
    };
    for (const documents::Rehearsal& rehearsal : read.rehearsals)
        page_.details.rehearsals.push_back(entry_of(rehearsal.id, shown(rehearsal.title)));
    for (const documents::Step& step : read.steps) {
        StartDetails::Step& one = page_.details.steps.emplace_back();
        one.title = shown(step.title);
        one.tool = text::printable(run::spaced(step.instrument));
        for (const documents::Goal& goal : step.goals)
            one.goals.push_back(text::printable(run::viewed_goal(goal, read).words));
        for (const documents::Limit& limit : step.limits)
            one.limits.push_back(text::printable(run::viewed_limit(limit, read).words));
    }
}

std::shared_ptr<const window::StartPicture> StartPages::picture(const StartSelection& selection) {
    if (selection.procedure >= page_.procedures.size() || !page_.details.error.empty()) return nullptr;
    DocumentOptions options;
    options.variant = selection.variant;
    return pictures_.of(detailed_, request_of(page_.procedures[selection.procedure].file, options, with_.here),
                        spacing_);
}

void StartPages::set_message(const std::string& message, bool is_bad) {
    page_.message = message;
    page_.is_message_bad = is_bad;
}

}  // namespace kerf::app
