// SPDX-License-Identifier: Apache-2.0
#include "run/exact/exact_strategies.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

namespace kerf {
namespace {

/// Cuts what another strategy for patches declines.
constexpr const char* fallback = "local";

/// Where a strategy of Kerf's own is: the stem of its module, and the package that installs it.
struct ShippedStrategy {
    std::string_view id, module, package;
};
constexpr ShippedStrategy own_strategies[] = {
    {"exact", "kerf_remesh_cgal", "kerf-remesh-cgal"},
    {"local", "kerf_remesh_cgal", "kerf-remesh-cgal"},
    {"displace", "kerf_remesh_displace", "kerf"},
};

/// Why no module has a strategy.
/// @param reasons   of each module, a line each
std::string refusal_of(const std::string& strategy, const std::string& folder, const std::vector<std::string>& modules,
                       const std::string& reasons) {
    const auto own = std::ranges::find(own_strategies, strategy, &ShippedStrategy::id);
    const bool is_missing =
        own != std::end(own_strategies) && std::none_of(modules.begin(), modules.end(), [&](const std::string& module) {
            return std::filesystem::path(module).stem() == own->module;
        });
    if (!is_missing)
        return "no module in " + folder + " has a remeshing strategy `" + strategy + "`" +
               (modules.empty() ? "; there are none." : ":" + reasons);
    const std::string module(own->module);
    return "the remeshing strategy `" + strategy + "` is not installed. Its module, " + module + ".so, is not in " +
           folder + ". Install the package `" + std::string(own->package) + "`. In a build tree, build the target `" +
           module + "`.";
}

}  // namespace

std::unique_ptr<RemeshChild> start_strategy(const RemeshFolders& folders, const std::string& strategy,
                                            std::string& error) {
    namespace fs = std::filesystem;
    std::vector<std::string> modules;
    std::error_code unreadable;
    for (auto entry = fs::directory_iterator(folders.modules, unreadable);
         !unreadable && entry != fs::directory_iterator(); entry.increment(unreadable))
        if (entry->path().extension() == ".so") modules.push_back(entry->path().string());
    std::sort(modules.begin(), modules.end());
    std::string reasons;
    for (const std::string& module : modules) {
        std::string reason;
        if (auto child = RemeshChild::start({folders.program, module, strategy}, reason)) return child;
        reasons += "\n      " + reason;
    }
    error = refusal_of(strategy, folders.modules, modules, reasons);
    return nullptr;
}

std::string ExactStrategies::start(const RemeshFolders& folders, const std::string& strategy) {
    if (running_.contains(strategy)) return {};
    std::string error;
    auto child = start_strategy(folders, strategy, error);
    if (child == nullptr) return error;
    const bool may_decline = child->scope() == KERF_REMESH_PATCH && strategy != fallback;
    running_.emplace(strategy, std::move(child));
    if (may_decline) why_no_fallback_ = start(folders, fallback);
    if (why_no_fallback_.ends_with('.')) why_no_fallback_.pop_back();
    return {};
}

std::string ExactStrategies::start(const RemeshFolders& folders, const Procedure& procedure) {
    for (const Instrument& instrument : procedure.instruments) {
        const bool is_used = std::any_of(procedure.steps.begin(), procedure.steps.end(),
                                         [&](const Step& step) { return step.instrument == instrument.id; });
        if (instrument.remeshing.empty() || !is_used) continue;
        if (std::string error = start(folders, instrument.remeshing); !error.empty()) {
            instrument_without_ = instrument.id;
            why_not_ = "instrument `" + instrument.id + "`: " + error;
            return error;
        }
    }
    return {};
}

RemeshChild* ExactStrategies::find(const std::string& strategy) const {
    const auto found = running_.find(strategy);
    return found != running_.end() ? found->second.get() : nullptr;
}

ExactTools ExactStrategies::tools(const Scene& scene) const {
    ExactTools tools = exact_tools(scene);
    for (std::size_t tool = 0; tool < scene.tools.size(); ++tool)
        tools.strategies[tool] = tools.strategies[scene.tools.size() + tool] =
            find(instrument_of(scene, tool).remeshing);
    tools.otherwise = find(fallback);
    tools.why_no_otherwise = why_no_fallback_;
    return tools;
}

ExactTools ExactStrategies::tools(const Scene& scene, const std::string& strategy) const {
    ExactTools tools = exact_tools(scene);
    tools.strategies.assign(tools.solids.size(), find(strategy));
    tools.otherwise = find(fallback);
    tools.why_no_otherwise = why_no_fallback_;
    return tools;
}

}  // namespace kerf
