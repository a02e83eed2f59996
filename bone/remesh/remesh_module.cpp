// SPDX-License-Identifier: Apache-2.0
#include "bone/remesh/remesh_module.h"

#include <cstddef>
#include <utility>
#include <vector>

#include "core/plugin/plugin_call.h"

namespace kerf::bone {

std::unique_ptr<RemeshModule> RemeshModule::open(const std::string& path, std::string& error) {
    PluginLoad load = load_tried_plugin(path);
    error = std::move(load.refusal);
    return load.plugin != nullptr ? std::unique_ptr<RemeshModule>(new RemeshModule(std::move(load.plugin))) : nullptr;
}

const kerf_component* RemeshModule::find(const std::string& strategy) const noexcept {
    for (std::uint32_t i = 0; i < entry().component_count; ++i)
        if (entry().components[i].kind == KERF_KIND_REMESHER && strategy == entry().components[i].id)
            return &entry().components[i];
    return nullptr;
}

RemeshResult remesh_here(const kerf_component& strategy, const RemeshRequest& request, void* cache) {
    std::vector<double> parameters;
    for (std::uint32_t i = 0; i < strategy.param_count; ++i) parameters.push_back(strategy.params[i].def);
    // Not initialised: pages that are not written take no memory.
    const std::uint64_t from_size = request_bytes(request), to_size = result_bytes(request);
    const std::unique_ptr<unsigned char[]> from(new unsigned char[from_size]), to(new unsigned char[to_size]);
    kerf_arena in_arena{from.get(), from_size, 0}, out_arena{to.get(), to_size, 64};
    kerf_remesh_in in{};
    kerf_remesh_out out{};
    out.size = sizeof out;
    if (!pack(request, parameters, in_arena, in)) {
        RemeshResult full;
        full.message = "the request does not fit its arena";
        return full;
    }
    const kerf_status status = call_remesh(strategy, in, in_arena, out_arena, out, cache);
    return unpack(status, out, out_arena);
}

}  // namespace kerf::bone
