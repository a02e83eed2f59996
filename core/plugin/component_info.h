// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "kerf/abi.h"

/// How a plugin describes itself, as plain values: enough to check a procedure without running plugin code.
namespace kerf {

struct ParameterInfo {
    std::string id;
    std::string help;
    kerf_dimension dimension{};
    std::string display_unit;
    double min = 0.0, max = 0.0, def = 0.0;  ///< SI
    std::string source;
    double least = 0.0;  ///< of a drive: magnitude under which the tool does not cut though it goes; 0: there is none
};

struct SignalInfo {
    std::string id;
    std::string help;
    kerf_dimension dimension{};
    std::string display_unit;
};

struct EventInfo {
    std::string id;
    std::string help;
    bool is_damage = false;  ///< the step in which it happens fails, unless the procedure allows it
};

/// One parameter that a feature sets when it is left out (kerf_feature).
struct FeatureInfo {
    std::string id, help;
    uint32_t kind = 0;      ///< KERF_FEATURE_EFFECT or KERF_FEATURE_RESOLUTION
    std::size_t param = 0;  ///< index into `parameters`
    double off = 0.0;       ///< SI
};

/// What a law needs of a tool (kerf_need).
struct NeedInfo {
    std::string id, help;
    kerf_dimension dimension{};
    uint32_t kind = 0;  ///< KERF_NEED_PARAM or KERF_NEED_DRIVE
};

struct ComponentInfo {
    std::string plugin;  ///< "kerf.drilling"
    std::string id;      ///< "twist_drill"
    uint32_t kind = 0;   ///< KERF_KIND_TOOL, KERF_KIND_FORCE or KERF_KIND_REMESHER
    std::string help;
    std::vector<ParameterInfo> parameters;
    std::vector<ParameterInfo> drives;    ///< tools only; source is empty
    std::vector<SignalInfo> signals;      ///< forces only
    std::vector<EventInfo> events;        ///< forces only
    std::vector<FeatureInfo> features;    ///< what it can do without
    std::vector<std::string> tools;       ///< forces only: those of its own plugin that it takes
    std::vector<NeedInfo> needs;          ///< forces only: what it needs of any tool; then `tools` is empty
    std::vector<std::string> strategies;  ///< tools only: remeshing strategies by full id, best first
    uint32_t feed = KERF_FEED_AXIS;       ///< tools only: KERF_FEED_…
    uint32_t scope = 0;                   ///< strategies only: KERF_REMESH_PATCH or KERF_REMESH_WHOLE
    std::string kernel;                   ///< strategies only: what its results depend on
    std::string module;                   ///< path of its shared library; empty: it is the core's own

    /// "kerf.burring.displace"
    [[nodiscard]] std::string full_id() const { return plugin + "." + id; }
    /// Whether a strategy is meant by its full id, or by the last words of it: "displace", "burring.displace".
    [[nodiscard]] bool is_meant_by(const std::string& word) const {
        const std::string full = full_id();
        return full == word || full.ends_with("." + word);
    }
};

/// Every component of every plugin that was found.
using ComponentCatalog = std::vector<ComponentInfo>;

}  // namespace kerf
