// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/plan/scene_model.h"

#include <algorithm>

namespace kerf::plan {

namespace {

/// The effects of one component whose parameters are `values`; those that are off already are none.
void add_features(const ComponentInfo& info, std::vector<double> ToolSetup::*values, const ToolSetup& setup,
                  std::vector<Feature>& features) {
    std::vector<std::string> seen;
    for (const FeatureInfo& first : info.features) {
        if (first.kind != KERF_FEATURE_EFFECT || std::find(seen.begin(), seen.end(), first.id) != seen.end()) continue;
        seen.push_back(first.id);
        std::vector<FeatureInfo> lines;
        for (const FeatureInfo& line : info.features)
            if (line.id == first.id) lines.push_back(line);
        const bool is_there = std::any_of(lines.begin(), lines.end(), [&](const FeatureInfo& line) {
            return (setup.*values)[line.param] != line.off;
        });
        if (!is_there) continue;
        features.push_back({first.id, first.help, [=](ToolSetup& without, Body&) {
                                for (const FeatureInfo& line : lines) (without.*values)[line.param] = line.off;
                            }});
    }
}

}  // namespace

std::vector<Feature> features_of(const ToolSetup& setup, const ComponentInfo& tool, const ComponentInfo& force,
                                 const Body& body) {
    std::vector<Feature> features;
    add_features(tool, &ToolSetup::tool_parameters, setup, features);
    add_features(force, &ToolSetup::force_parameters, setup, features);
    const bool has_densities = std::any_of(body.materials.begin(), body.materials.end(),
                                           [](const Material& m) { return !m.densities.is_empty(); });
    if (has_densities)
        features.push_back(
            {"density_of_the_scan", "A density of its own at every place of the bone.", [](ToolSetup&, Body& without) {
                 for (Material& m : without.materials) {
                     if (!m.densities.is_empty()) m.density = m.densities.mean();
                     m.densities = {};
                 }
             }});
    if (body.materials.size() > 1)
        features.push_back({"second_tissue", "Tissues of different density; without it all bone is as the first one.",
                            [](ToolSetup&, Body& without) {
                                Material only = without.materials.front();
                                only.border = {};
                                without.materials = {only};
                            }});
    return features;
}

std::optional<Pitch> pitch_of(const ComponentInfo& force) {
    for (const FeatureInfo& f : force.features)
        if (f.kind == KERF_FEATURE_RESOLUTION) {
            const ParameterInfo& p = force.parameters[f.param];
            return Pitch{f.param, f.off > p.def ? p.min : p.max, f.off, p.display_unit};
        }
    return std::nullopt;
}

}  // namespace kerf::plan
