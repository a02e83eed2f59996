// SPDX-License-Identifier: Apache-2.0
#include "app/start_picture.h"

#include <chrono>
#include <optional>
#include <utility>

#include "app/standard_streams.h"
#include "documents/patch.h"
#include "run/run.h"
#include "run/scene.h"
#include "run/view/run_view.h"

namespace kerf::app {

namespace {

/// Checks the documents on a grid of twice the spacing, or on their own where a tool is too thin for that.
std::optional<run::Documents> coarse_documents(const run::DocumentRequest& request, double spacing,
                                               const PluginRegistry& plugins, text::Diagnostics& diagnostics) {
    run::DocumentRequest coarse = request;
    documents::override_setting(coarse.changes.settings, "accuracy.spacing", formatted("%.4g mm", 2e3 * spacing));
    text::Diagnostics ignored;
    if (auto documents = run::check_documents(coarse, plugins).take(ignored)) return documents;
    return run::check_documents(request, plugins).take(diagnostics);
}

std::string first_line(const text::Diagnostics& diagnostics) {
    const std::string all = to_text(diagnostics);
    return all.substr(0, all.find('\n'));
}

}  // namespace

StartPictures::Made StartPictures::make(const run::DocumentRequest& request, double spacing) {
    text::Diagnostics diagnostics;
    auto documents = coarse_documents(request, spacing, *plugins_, diagnostics);
    if (!documents) return {nullptr, first_line(diagnostics)};
    bone::ImportOptions options;
    options.progress = [this](double fraction, const std::string&) { fraction_ = fraction; };
    const auto scene = run::make_scene(std::move(*documents), options).take(diagnostics);
    if (!scene) return {nullptr, first_line(diagnostics)};
    run::RunView view(*scene, {});
    run::RunRequest run_request;
    run_request.observers = {&view};
    run::RunOutcome refusal;
    if (run::Run::create(*scene, *plugins_, run_request, refusal) == nullptr) return {nullptr, refusal.error};
    auto picture = std::make_shared<window::StartPicture>();
    static_cast<void>(view.take(picture->state));
    picture->scene = view.scene();
    picture->surface = view.surface();
    if (picture->surface == nullptr) return {nullptr, "the bone has no surface"};
    return {std::move(picture), {}};
}

std::shared_ptr<const window::StartPicture> StartPictures::of(const std::string& key,
                                                              const run::DocumentRequest& request, double spacing) {
    shown_key_ = key;
    const bool can_start = is_idle();
    if (const auto found = made_.find(key); found != made_.end()) return found->second.picture;
    if (can_start) {
        making_key_ = key;
        fraction_ = 0.0;
        making_ = std::async(std::launch::async, [this, request, spacing] { return make(request, spacing); });
    }
    return nullptr;
}

bool StartPictures::is_idle() {
    if (!making_.valid()) return true;
    if (making_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
    made_[making_key_] = making_.get();
    return true;
}

std::string StartPictures::state() const {
    if (const auto found = made_.find(shown_key_); found != made_.end()) return found->second.error;
    if (shown_key_ != making_key_) return "Drawing the bone …";
    return formatted("Drawing the bone … %.0f %%", 100.0 * fraction_.load());
}

}  // namespace kerf::app
