// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "kerf/abi.h"

/// The description of a plugin as plain values: enough to check a procedure without a call into plugin code.
namespace kerf {

struct ParameterInfo {
    std::string id;
    std::string help;
    kerf_dimension dimension{};
    std::string display_unit;
    double min = 0.0, max = 0.0, def = 0.0;  ///< SI
    std::string source;
    double least = 0.0;  ///< of a drive: magnitude below which the tool runs but does not cut; 0: no such limit
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
    bool is_damage = false;  ///< a step in which the event happens fails, unless the procedure allows the event
};

/// One parameter of a feature, and the value that switches the feature off (kerf_feature).
struct FeatureInfo {
    std::string id, help;
    uint32_t kind = 0;      ///< KERF_FEATURE_EFFECT or KERF_FEATURE_RESOLUTION
    std::size_t param = 0;  ///< index into `parameters`
    double off = 0.0;       ///< SI
};

/// A requirement of a law on its tool (kerf_need).
struct NeedInfo {
    std::string id, help;
    kerf_dimension dimension{};
    uint32_t kind = 0;  ///< KERF_NEED_PARAM or KERF_NEED_DRIVE
};

struct ComponentInfo {
    std::string plugin;  ///< "kerf.drilling"
    std::string id;      ///< "twist_drill"
    uint32_t kind = 0;   ///< KERF_KIND_TOOL, KERF_KIND_FORCE, KERF_KIND_REMESHER or KERF_KIND_DEVICE
    std::string help;
    std::vector<ParameterInfo> parameters;
    std::vector<ParameterInfo> drives;    ///< tools only; source is empty
    std::vector<SignalInfo> signals;      ///< forces only
    std::vector<EventInfo> events;        ///< forces only
    std::vector<FeatureInfo> features;    ///< optional parts
    std::vector<std::string> tools;       ///< forces only: ids of the tools of the same plugin that the law takes
    std::vector<NeedInfo> needs;          ///< forces only: requirements on any tool; then `tools` is empty
    std::vector<std::string> strategies;  ///< tools only: remeshing strategies by full id, best first
    uint32_t feed = KERF_FEED_AXIS;       ///< tools only: KERF_FEED_…
    std::vector<std::string> does_not;    ///< forces only: what it leaves out: "resist sideways"
    uint32_t scope = 0;                   ///< strategies only: KERF_REMESH_PATCH or KERF_REMESH_WHOLE
    std::string kernel;                   ///< strategies only: library, version and flags on which its results depend
    std::string module;                   ///< path of its shared library; empty for the core's own components

    /// Returns the id with the plugin's id: "kerf.burring.displace".
    [[nodiscard]] std::string full_id() const { return plugin + "." + id; }
    /// Returns whether `word` is the full id or its last words, whole words only: "displace", "burring.displace".
    [[nodiscard]] bool matches_id(const std::string& word) const {
        const std::string full = full_id();
        return full == word || full.ends_with("." + word);
    }
};

/// All components of all plugins found.
using ComponentCatalog = std::vector<ComponentInfo>;

}  // namespace kerf
