// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bone/remesh/remesh_module.h"

/// The remeshing strategies of this build, called in this process.
namespace kerf::bench {

class StrategyModules {
public:
    /// Opens modules of lib/kerf. Returns an error for a person, empty if there is none.
    [[nodiscard]] std::string open(const std::vector<std::string>& names) {
        std::string error;
        for (const std::string& name : names) {
            modules_.push_back(bone::RemeshModule::open(KERF_BUILD_DIR "/lib/kerf/" + name + ".so", error));
            if (modules_.back() == nullptr) return error;
        }
        return {};
    }
    /// Null: none of the modules has it.
    [[nodiscard]] const kerf_component* find(const std::string& strategy) const {
        for (const auto& module : modules_)
            if (const kerf_component* found = module->find(strategy)) return found;
        return nullptr;
    }
    /// Pre: one of the modules has the strategy.
    [[nodiscard]] bone::RemeshResult ask(const std::string& strategy, const bone::RemeshRequest& request) const {
        return bone::remesh_here(*find(strategy), request);
    }

private:
    std::vector<std::unique_ptr<bone::RemeshModule>> modules_;
};

}  // namespace kerf::bench
