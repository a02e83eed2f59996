// SPDX-License-Identifier: Apache-2.0
#include "run/exact/exact_strategies.h"

#include <algorithm>
#include <cstddef>
#include <fstream>
#include <iterator>
#include <string_view>
#include <utility>

#include "kerf/units.hpp"
#include "session/content_hash.h"

namespace kerf::run {
namespace {

constexpr auto not_started = static_cast<std::size_t>(-1);

/// Returns "kerf.remesh_cgal" for "kerf.remesh_cgal.local".
std::string plugin_of(const std::string& full_id) { return full_id.substr(0, full_id.rfind('.')); }

/// Returns how to install a plugin. Kerf's own have packages and targets with their names.
std::string how_to_install(const std::string& plugin) {
    std::string package = plugin, target = plugin;
    std::replace_if(
        package.begin(), package.end(), [](char c) { return c == '.' || c == '_'; }, '-');
    std::replace(target.begin(), target.end(), '.', '_');
    if (!plugin.starts_with("kerf."))
        return "Install the plugin `" + plugin + "`, or name its folder in KERF_PLUGIN_PATH.";
    return "Install the package `" + package + "`. In a build tree, build the target `" + target + "`.";
}

std::string why_missing(const ComponentCatalog& catalog, const std::string& full_id) {
    const std::string plugin = plugin_of(full_id);
    if (std::any_of(catalog.begin(), catalog.end(), [&](const ComponentInfo& c) { return c.plugin == plugin; }))
        return "the plugin `" + plugin + "` has no remeshing strategy `" + full_id.substr(plugin.size() + 1) +
               "`; `kerf list` shows what there is.";
    return "the remeshing strategy `" + full_id + "` is not installed: no folder of plugins has `" + plugin + "`. " +
           how_to_install(plugin);
}

bool are_equal(const std::vector<documents::ParameterSetting>& a, const std::vector<documents::ParameterSetting>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](const documents::ParameterSetting& x, const documents::ParameterSetting& y) {
                          return x.id == y.id && x.value == y.value;
                      });
}

std::uint64_t hash_of_file(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return session::hash_of_text(std::string(std::istreambuf_iterator<char>(file), {}));
}

const ComponentInfo* tool_of(const documents::Instrument& instrument, const ComponentCatalog& catalog) {
    const auto found = std::find_if(catalog.begin(), catalog.end(), [&](const ComponentInfo& c) {
        return c.kind == KERF_KIND_TOOL && c.plugin == instrument.plugin && c.id == instrument.tool;
    });
    return found != catalog.end() ? &*found : nullptr;
}

bool is_used(const documents::Instrument& instrument, const documents::Procedure& procedure) {
    return std::any_of(procedure.steps.begin(), procedure.steps.end(),
                       [&](const documents::Step& step) { return step.instrument == instrument.id; });
}

}  // namespace

const ComponentInfo* find_strategy(const ComponentCatalog& catalog, const std::string& full_id) {
    const auto found = std::find_if(catalog.begin(), catalog.end(), [&](const ComponentInfo& c) {
        return c.kind == KERF_KIND_REMESHER && c.full_id() == full_id;
    });
    return found != catalog.end() ? &*found : nullptr;
}

std::unique_ptr<bone::RemeshChild> start_strategy(const StrategyHost& host, const std::string& full_id,
                                                  const std::vector<documents::ParameterSetting>& set,
                                                  std::string& error) {
    const ComponentInfo* strategy = find_strategy(*host.catalog, full_id);
    if (strategy == nullptr) {
        error = why_missing(*host.catalog, full_id);
        return nullptr;
    }
    bone::RemeshProgram program{host.program, strategy->module, strategy->id};
    for (const ParameterInfo& parameter : strategy->parameters) {
        const auto own = std::find_if(set.begin(), set.end(),
                                      [&](const documents::ParameterSetting& one) { return one.id == parameter.id; });
        program.parameters.push_back(own != set.end() ? own->value : parameter.def);
        if (parameter.id == "tolerance" && parameter.dimension == dimension::length)
            program.tolerance = program.parameters.back();
    }
    auto child = bone::RemeshChild::start(program, error);
    if (child == nullptr) error = "the remeshing strategy `" + full_id + "` cannot be started: " + error;
    return child;
}

std::size_t ExactStrategies::start_one(const std::string& id, const std::vector<documents::ParameterSetting>& set,
                                       std::string& error) {
    for (std::size_t n = 0; n < running_.size(); ++n)
        if (running_[n].id == id && are_equal(running_[n].set, set)) return n;
    auto child = start_strategy(host_, id, set, error);
    if (child == nullptr) return not_started;
    const ComponentInfo& info = *find_strategy(*host_.catalog, id);
    running_.push_back({id, set, info.parameters, hash_of_file(info.module), std::move(child)});
    return running_.size() - 1;
}

std::string ExactStrategies::start_chain(const documents::Instrument& instrument, const std::string& wanted,
                                         const std::vector<documents::ParameterSetting>& set) {
    const ComponentInfo* tool = tool_of(instrument, *host_.catalog);
    std::vector<std::string> ids{wanted};
    if (tool != nullptr)
        std::copy_if(tool->strategies.begin(), tool->strategies.end(), std::back_inserter(ids),
                     [&](const std::string& id) { return id != wanted; });
    Chain chain{instrument.id, {}, {}};
    std::string first_error;
    for (const std::string& id : ids) {
        std::string error;
        const std::size_t one = start_one(id, id == wanted ? set : std::vector<documents::ParameterSetting>{}, error);
        if (one != not_started) {
            chain.strategies.push_back(one);
            continue;
        }
        if (first_error.empty()) first_error = error;
        if (chain.why_no_more.empty() && !chain.strategies.empty()) chain.why_no_more = error;
    }
    if (chain.strategies.empty()) return first_error;
    if (const std::string& first = running_[chain.strategies.front()].id; first != wanted) {
        if (first_error.ends_with('.')) first_error.pop_back();
        notes_.push_back("Instrument `" + instrument.id + "`: " + first_error + ". `" + first + "` replaces it.");
    }
    if (chain.why_no_more.ends_with('.')) chain.why_no_more.pop_back();
    chains_.push_back(std::move(chain));
    return {};
}

std::string ExactStrategies::start(const documents::Procedure& procedure) {
    for (const documents::Instrument& instrument : procedure.instruments) {
        if (instrument.remeshing.empty() || !is_used(instrument, procedure)) continue;
        if (std::string error = start_chain(instrument, instrument.remeshing, instrument.remeshing_parameters);
            !error.empty()) {
            instrument_without_ = instrument.id;
            why_not_ = "instrument `" + instrument.id + "`: " + error;
            return error;
        }
    }
    return {};
}

std::string ExactStrategies::start(const documents::Procedure& procedure, const std::string& wanted) {
    for (const documents::Instrument& instrument : procedure.instruments) {
        if (!is_used(instrument, procedure)) continue;
        const bool is_its_own = wanted.empty() || wanted == instrument.remeshing;
        const ComponentInfo* tool = tool_of(instrument, *host_.catalog);
        std::string id = is_its_own ? instrument.remeshing : wanted;
        if (id.empty() && tool != nullptr && !tool->strategies.empty()) id = tool->strategies.front();
        if (id.empty()) continue;  // a tool that removes no bone, or whose plugin names no strategy
        if (std::string error =
                start_chain(instrument, id,
                            is_its_own ? instrument.remeshing_parameters : std::vector<documents::ParameterSetting>{});
            !error.empty()) {
            instrument_without_ = instrument.id;
            why_not_ = "instrument `" + instrument.id + "`: " + error;
            return error;
        }
    }
    if (running_.empty())
        return why_not_ = "no tool of the procedure names a remeshing strategy that suits it. Choose one with "
                          "`--strategy`; `kerf list` shows all.";
    return {};
}

const documents::Anatomy* surface_anatomy(const Scene& scene) noexcept {
    return scene.anatomy.mesh && !scene.fragment ? &scene.anatomy : nullptr;
}

bone::ExactTools exact_tools(const Scene& scene) {
    bone::ExactTools tools;
    for (const Tool& tool : scene.tools) tools.solids.push_back(&tool.outline.cutting);
    for (const Tool& tool : scene.tools) tools.solids.push_back(&tool.outline.crest);
    tools.strategies.resize(tools.solids.size());
    tools.why_no_more.resize(tools.solids.size());
    tools.meshed = &scene.body;
    tools.anatomy = surface_anatomy(scene);
    tools.volume_accuracy = scene.procedure.accuracy.volume;
    return tools;
}

bone::ExactTools ExactStrategies::tools(const Scene& scene) const {
    bone::ExactTools tools = exact_tools(scene);
    for (std::size_t tool = 0; tool < scene.tools.size(); ++tool) {
        const std::string& instrument = instrument_of(scene, tool).id;
        const auto chain = std::find_if(chains_.begin(), chains_.end(),
                                        [&](const Chain& one) { return one.instrument == instrument; });
        if (chain == chains_.end()) continue;
        for (const std::size_t solid : {tool, scene.tools.size() + tool}) {
            for (const std::size_t one : chain->strategies)
                tools.strategies[solid].push_back({running_[one].id, running_[one].child.get()});
            tools.why_no_more[solid] = chain->why_no_more;
        }
    }
    tools.notes = notes_;
    return tools;
}

}  // namespace kerf::run
