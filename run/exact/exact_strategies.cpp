// SPDX-License-Identifier: Apache-2.0
#include "run/exact/exact_strategies.h"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

namespace kerf {
namespace {

/// Cuts what another strategy for patches declines.
constexpr const char* fallback = "local";

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
    error = "no module in " + folders.modules + " has a remeshing strategy `" + strategy + "`" +
            (modules.empty() ? "; there are none." : ":" + reasons);
    return nullptr;
}

std::string ExactStrategies::start(const RemeshFolders& folders, const std::string& strategy) {
    if (running_.contains(strategy)) return {};
    std::string error;
    auto child = start_strategy(folders, strategy, error);
    if (child == nullptr) return error;
    const bool may_decline = child->scope() == KERF_REMESH_PATCH && strategy != fallback;
    running_.emplace(strategy, std::move(child));
    return may_decline ? start(folders, fallback) : std::string();
}

std::string ExactStrategies::start(const RemeshFolders& folders, const Procedure& procedure) {
    for (const Instrument& instrument : procedure.instruments) {
        const bool is_used = std::any_of(procedure.steps.begin(), procedure.steps.end(),
                                         [&](const Step& step) { return step.instrument == instrument.id; });
        if (instrument.remeshing.empty() || !is_used) continue;
        if (const std::string error = start(folders, instrument.remeshing); !error.empty())
            return why_not_ = "instrument `" + instrument.id + "`: " + error;
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
    return tools;
}

ExactTools ExactStrategies::tools(const Scene& scene, const std::string& strategy) const {
    ExactTools tools = exact_tools(scene);
    tools.strategies.assign(tools.solids.size(), find(strategy));
    tools.otherwise = find(fallback);
    return tools;
}

}  // namespace kerf
