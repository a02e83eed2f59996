// SPDX-License-Identifier: Apache-2.0
#include "core/remesh/remesh_module.h"

#include <dlfcn.h>

#include <array>
#include <cstddef>
#include <cstring>

namespace kerf {
namespace {

/// Why the host cannot talk to a module; empty if it can.
std::string fault_of(const kerf_remesh_module& entry) {
    if (entry.magic != KERF_MAGIC) return "`" KERF_REMESH_ENTRY_SYMBOL "` is not Kerf's.";
    const auto rebuilt = [](const std::string& what) { return what + " Build it against this Kerf."; };
    if (entry.draft != KERF_REMESH_DRAFT || entry.size != sizeof(kerf_remesh_module))
        return rebuilt("it is for draft " + std::to_string(entry.draft) + " of the remeshing boundary, need " +
                       std::to_string(KERF_REMESH_DRAFT) + ".");
    constexpr std::array<std::uint32_t, 6> needed{KERF_REMESH_SIZES_INIT};
    const std::array<std::uint32_t, 6> got{entry.in_size,  entry.out_size,   entry.patch_size,
                                           entry.cut_size, entry.solid_size, entry.remesher_size};
    if (got != needed) return rebuilt("its structs have other sizes than this Kerf's.");
    if (entry.remesher_count == 0 || entry.remeshers == nullptr) return "it has no strategy.";
    for (std::uint32_t i = 0; i < entry.remesher_count; ++i) {
        const kerf_remesher& one = entry.remeshers[i];
        if (one.id == nullptr || one.help == nullptr || one.remesh == nullptr ||
            (one.scope != KERF_REMESH_PATCH && one.scope != KERF_REMESH_WHOLE))
            return "its strategy " + std::to_string(i) + " lacks an id, a help, a function or a scope.";
    }
    if (entry.plugin_id == nullptr || entry.plugin_version == nullptr || entry.licence == nullptr ||
        entry.kernel == nullptr)
        return "it lacks an id, a version, a licence or a kernel.";
    return {};
}

}  // namespace

std::unique_ptr<RemeshModule> RemeshModule::open(const std::string& path, std::string& error) {
    dlerror();
    void* handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (handle == nullptr) {
        const char* why = dlerror();
        error = path + ": cannot be loaded: " + (why != nullptr ? why : "unknown reason") + ".";
        return nullptr;
    }
    const auto* entry = static_cast<const kerf_remesh_module*>(dlsym(handle, KERF_REMESH_ENTRY_SYMBOL));
    error = entry == nullptr ? "it exports no `" KERF_REMESH_ENTRY_SYMBOL "`." : fault_of(*entry);
    if (!error.empty()) {
        error = path + ": " + error;
        dlclose(handle);
        return nullptr;
    }
    return std::unique_ptr<RemeshModule>(new RemeshModule(handle, entry));
}

RemeshModule::~RemeshModule() { dlclose(handle_); }

const kerf_remesher* RemeshModule::find(const std::string& strategy) const noexcept {
    for (std::uint32_t i = 0; i < entry_->remesher_count; ++i)
        if (strategy == entry_->remeshers[i].id) return &entry_->remeshers[i];
    return nullptr;
}

RemeshResult remesh_here(const kerf_remesher& remesher, const RemeshRequest& request, void* cache) {
    // Not set to zero: what is not written is never touched.
    const std::uint64_t from_size = request_bytes(request), to_size = result_bytes(request);
    const std::unique_ptr<unsigned char[]> from(new unsigned char[from_size]), to(new unsigned char[to_size]);
    kerf_arena in_arena{from.get(), from_size, 0}, out_arena{to.get(), to_size, 64};
    kerf_remesh_in in{};
    kerf_remesh_out out{};
    out.size = sizeof out;
    if (!pack(request, in_arena, in)) {
        RemeshResult full;
        full.message = "the request does not fit its arena";
        return full;
    }
    const kerf_status status = remesher.remesh(&in, &in_arena, &out_arena, &out, cache);
    return unpack(status, out, out_arena);
}

}  // namespace kerf
