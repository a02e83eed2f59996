// SPDX-License-Identifier: Apache-2.0
#include "run/exact/exact_strategies.h"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

namespace kerf {

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

std::string ExactStrategies::start(const RemeshFolders& folders, const Procedure& procedure) {
    for (const Instrument& instrument : procedure.instruments) {
        if (instrument.remeshing.empty() || running_.count(instrument.remeshing) > 0) continue;
        std::string error;
        auto child = start_strategy(folders, instrument.remeshing, error);
        if (child == nullptr) return "instrument `" + instrument.id + "`: " + error;
        running_.emplace(instrument.remeshing, std::move(child));
    }
    return {};
}

ExactTools ExactStrategies::tools(const Scene& scene) const {
    ExactTools tools = exact_tools(scene);
    for (std::size_t tool = 0; tool < scene.tools.size(); ++tool) {
        const auto strategy = running_.find(instrument_of(scene, tool).remeshing);
        if (strategy == running_.end()) continue;
        tools.strategies[tool] = strategy->second.get();
        tools.strategies[scene.tools.size() + tool] = strategy->second.get();
    }
    return tools;
}

}  // namespace kerf
