// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <memory>
#include <string>

#include "core/procedure/procedure.h"
#include "core/remesh/remesh_child.h"
#include "run/exact/exact_surface.h"

namespace kerf {

/// Where remeshing modules are, and the program that opens them.
struct RemeshFolders {
    std::string program;  ///< kerf-remesh
    std::string modules;  ///< lib/kerf-remesh
};

/// Starts a strategy in the first module, by file name, that has it. Null: the reason is in `error`, for people.
/// [main]
[[nodiscard]] std::unique_ptr<RemeshChild> start_strategy(const RemeshFolders& folders, const std::string& strategy,
                                                          std::string& error);

/// The strategies that the instruments of a procedure leave exact surfaces with, each in a process of its own.
class ExactStrategies {
public:
    /// Starts them; none if no instrument names one. Returns why one cannot be started, for people, or an empty text.
    /// Call it before any thread runs.   [main]
    /// A run goes on without them: `why_not` then stands in its results.
    [[nodiscard]] std::string start(const RemeshFolders& folders, const Procedure& procedure);
    /// Starts one, unless it runs, and the one that gets what it declines; without the latter it declines for good.
    /// [main]
    [[nodiscard]] std::string start(const RemeshFolders& folders, const std::string& strategy);

    [[nodiscard]] bool are_any() const noexcept { return why_not_.empty() && !running_.empty(); }
    /// Why the strategies of a procedure did not start; empty: they did, or there are none.
    [[nodiscard]] const std::string& why_not() const noexcept { return why_not_; }
    /// The instrument whose strategy did not start; empty: none.
    [[nodiscard]] const std::string& instrument_without() const noexcept { return instrument_without_; }
    /// Returns the cutting solids of a scene with the strategy of each.   [main]
    [[nodiscard]] ExactTools tools(const Scene& scene) const;
    /// The same with one strategy for all of them. Pre: it runs.   [main]
    [[nodiscard]] ExactTools tools(const Scene& scene, const std::string& strategy) const;
    /// The strategies by id, in the order of their ids.
    [[nodiscard]] const std::map<std::string, std::unique_ptr<RemeshChild>>& running() const noexcept {
        return running_;
    }

private:
    [[nodiscard]] RemeshChild* find(const std::string& strategy) const;

    std::map<std::string, std::unique_ptr<RemeshChild>> running_;
    std::string why_not_, instrument_without_, why_no_fallback_;
};

}  // namespace kerf
