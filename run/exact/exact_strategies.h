// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "bone/exact/exact_tools.h"
#include "bone/remesh/remesh_child.h"
#include "core/plugin/component_info.h"
#include "documents/procedure.h"
#include "run/scene.h"

namespace kerf {

/// What calls strategies, and which there are.
struct StrategyHost {
    std::string program;                ///< kerf-remesh
    const ComponentCatalog* catalog{};  ///< of all plugins; outlives what is started
};

/// Returns the strategy of a full id; null: it is not installed.   [any]
[[nodiscard]] const ComponentInfo* find_strategy(const ComponentCatalog& catalog, const std::string& full_id);

/// Starts a strategy. Null: the reason is in `error`, for people.   [main]
/// @param set   parameters that differ from their defaults
[[nodiscard]] std::unique_ptr<RemeshChild> start_strategy(const StrategyHost& host, const std::string& full_id,
                                                          const std::vector<ParameterSetting>& set, std::string& error);

/// Returns the anatomy whose `mesh:` is the surface of the scene's bone; null: there is none, or the bone is broken.
/// [any]
[[nodiscard]] const Anatomy* surface_anatomy(const Scene& scene) noexcept;

/// Returns the cutting solids of a scene, as records number them, without strategies. The scene must outlive them.
/// [any]
[[nodiscard]] ExactTools exact_tools(const Scene& scene);

/// The strategies that the instruments of a procedure leave exact surfaces with, each in a process of its own. Where
/// the one that an instrument wants is not installed, or declines a cut, the next of those that suit its tool replaces
/// it.
class ExactStrategies {
public:
    explicit ExactStrategies(StrategyHost host) : host_(std::move(host)) {}

    /// Starts those that the procedure names; none if no instrument names one. Returns why an instrument has none, for
    /// people, or an empty text. Call it before any thread runs.   [main]
    /// A run continues without them: `why_not` is then in its results.
    [[nodiscard]] std::string start(const Procedure& procedure);
    /// The same for a surface that is made in any case: by `wanted`, or else by what each instrument names, or else by
    /// what suits its tool best.
    /// @param wanted   full id; may be empty
    [[nodiscard]] std::string start(const Procedure& procedure, const std::string& wanted);

    [[nodiscard]] bool are_any() const noexcept { return why_not_.empty() && !running_.empty(); }
    /// Why the strategies of a procedure did not start; empty: they did, or there are none.
    [[nodiscard]] const std::string& why_not() const noexcept { return why_not_; }
    /// The instrument whose strategy did not start; empty: none.
    [[nodiscard]] const std::string& instrument_without() const noexcept { return instrument_without_; }
    /// Which strategies are not installed and what replaces them; for people.
    [[nodiscard]] const std::vector<std::string>& notes() const noexcept { return notes_; }
    /// Returns the cutting solids of a scene with the strategies of each.   [main]
    [[nodiscard]] ExactTools tools(const Scene& scene) const;

    struct Running {
        std::string id;  ///< full
        std::vector<ParameterSetting> set;
        std::vector<ParameterInfo> parameters;  ///< declared; their values are in `child->program().parameters`
        std::uint64_t module_hash = 0;          ///< FNV-1a of the library
        std::unique_ptr<RemeshChild> child;
    };
    [[nodiscard]] const std::vector<Running>& running() const noexcept { return running_; }

private:
    /// What an instrument has: indices into `running_`, best first.
    struct Chain {
        std::string instrument;
        std::vector<std::size_t> strategies;
        std::string why_no_more;
    };
    [[nodiscard]] std::string start_chain(const Instrument& instrument, const std::string& wanted,
                                          const std::vector<ParameterSetting>& set);
    [[nodiscard]] std::size_t start_one(const std::string& id, const std::vector<ParameterSetting>& set,
                                        std::string& error);

    StrategyHost host_;
    std::vector<Running> running_;
    std::vector<Chain> chains_;
    std::string why_not_, instrument_without_;
    std::vector<std::string> notes_;
};

}  // namespace kerf
