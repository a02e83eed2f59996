// SPDX-License-Identifier: Apache-2.0
#include "core/plugin/plugin_host.h"

#include <cstdio>
#include <cstring>
#include <string_view>
#include <type_traits>
#include <utility>

#include "core/plugin/own_streams.h"
#include "core/plugin/plain_text.h"

namespace kerf {

PluginHost::PluginHost(std::string plugin_id)
    : table_{sizeof(kerf_host), KERF_ABI_VERSION, "kerf", KERF_CORE_VERSION, &find}, plugin_id_(std::move(plugin_id)) {
    static_assert(std::is_standard_layout_v<PluginHost>);
}

std::string PluginHost::open(const kerf_entry& entry) {
    if (entry.open == nullptr) return {};
    const kerf_status status = entry.open(&table_);
    if (status == KERF_OK) return {};
    return "its `open` returned " + std::to_string(status) +
           ", expected KERF_OK (0). Mend it, or remove it from its folder.";
}

const void* PluginHost::find(const kerf_host* /*host*/, const char* id, std::uint32_t version) {
    static constexpr kerf_log log{sizeof(kerf_log), 0, &write};
    if (id == nullptr) return nullptr;
    return std::strcmp(id, KERF_LOG_ID) == 0 && version == KERF_LOG_VERSION ? &log : nullptr;
}

void PluginHost::write(const kerf_host* host, std::uint32_t level, const char* text) {
    if (host == nullptr || text == nullptr) return;
    PluginHost& self = *reinterpret_cast<PluginHost*>(const_cast<kerf_host*>(host));
    if (self.lines_ > max_lines) return;
    const bool is_last = ++self.lines_ > max_lines;
    const std::string line = is_last ? "has printed " + std::to_string(max_lines) + " lines, and prints no more"
                                     : plain(std::string_view(text, strnlen(text, max_line)));
    std::fprintf(own_errors(), "plugin %s: %s%s\n", self.plugin_id_.c_str(),
                 level == KERF_LOG_WARNING && !is_last ? "warning: " : "", line.c_str());
}

}  // namespace kerf
