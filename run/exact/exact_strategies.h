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

namespace kerf::run {

/// The program that calls strategies, and the catalogue of strategies.
struct StrategyHost {
    std::string program;                ///< kerf-remesh
    const ComponentCatalog* catalog{};  ///< of all plugins; must outlive the started strategies
};

/// Returns the strategy with a full id; null if it is not installed.   [any]
[[nodiscard]] const ComponentInfo* find_strategy(const ComponentCatalog& catalog, const std::string& full_id);

/// Starts a strategy. Returns null with the reason, for people, in `error`.   [main]
/// @param set   parameters that differ from their defaults
[[nodiscard]] std::unique_ptr<bone::RemeshChild> start_strategy(const StrategyHost& host, const std::string& full_id,
                                                                const std::vector<documents::ParameterSetting>& set,
                                                                std::string& error);

/// Returns the anatomy whose `mesh:` is the surface of the scene's bone; null if there is none, or the bone is
/// fractured. [any]
[[nodiscard]] const documents::Anatomy* surface_anatomy(const Scene& scene) noexcept;

/// Returns the cutting solids of a scene, in the order of the records' indices, without strategies. Pre: the scene
/// outlives the result. [any]
[[nodiscard]] bone::ExactTools exact_tools(const Scene& scene);

/// The strategies that make the exact surfaces of a procedure's instruments, each in its own process. If an
/// instrument's strategy is not installed, or declines a cut, the next suitable strategy of its tool replaces it.
class ExactStrategies {
public:
    explicit ExactStrategies(StrategyHost host) : host_(std::move(host)) {}

    /// Starts the strategies that the procedure names. Returns why an instrument has none, for people, or an empty
    /// text. Call it before any thread runs. A run continues without strategies: its results then contain `why_not`.
    /// [main]
    [[nodiscard]] std::string start(const documents::Procedure& procedure);
    /// Starts strategies for a surface that is always made: by `wanted`, else by the strategy of each instrument, else
    /// by the most suitable strategy of its tool. Returns as above.   [main]
    [[nodiscard]] std::string start(const documents::Procedure& procedure, const std::string& wanted);

    [[nodiscard]] bool are_any() const noexcept { return why_not_.empty() && !running_.empty(); }
    /// Returns why the strategies of a procedure did not start; empty if they did, or if there are none.
    [[nodiscard]] const std::string& why_not() const noexcept { return why_not_; }
    /// Returns the instrument whose strategy did not start; empty: none.
    [[nodiscard]] const std::string& instrument_without() const noexcept { return instrument_without_; }
    /// Returns notes on strategies that are not installed and their replacements; for people.
    [[nodiscard]] const std::vector<std::string>& notes() const noexcept { return notes_; }
    /// Returns the cutting solids of a scene with their strategies.   [main]
    [[nodiscard]] bone::ExactTools tools(const Scene& scene) const;

    struct Running {
        std::string id;  ///< full id
        std::vector<documents::ParameterSetting> set;
        std::vector<ParameterInfo> parameters;  ///< as declared; their values are in `child->program().parameters`
        std::uint64_t module_hash = 0;          ///< FNV-1a of the library
        std::unique_ptr<bone::RemeshChild> child;
    };
    [[nodiscard]] const std::vector<Running>& running() const noexcept { return running_; }

private:
    /// Strategies of an instrument: indices into `running_`, the most suitable first.
    struct Chain {
        std::string instrument;
        std::vector<std::size_t> strategies;
        std::string why_no_more;
    };
    [[nodiscard]] std::string start_chain(const documents::Instrument& instrument, const std::string& wanted,
                                          const std::vector<documents::ParameterSetting>& set);
    [[nodiscard]] std::size_t start_one(const std::string& id, const std::vector<documents::ParameterSetting>& set,
                                        std::string& error);

    StrategyHost host_;
    std::vector<Running> running_;
    std::vector<Chain> chains_;
    std::string why_not_, instrument_without_;
    std::vector<std::string> notes_;
};

}  // namespace kerf::run
