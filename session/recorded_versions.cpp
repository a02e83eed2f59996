// SPDX-License-Identifier: Apache-2.0
#include "session/recorded_versions.h"

#include <string_view>
#include <vector>

#include "session/session_file.h"
#include "session/session_tables.h"

namespace kerf::session {

std::map<std::string, std::string> recorded_versions(const std::string& path) {
    constexpr std::string_view start = "version.";
    std::vector<std::string> tables;
    for (const Table& table : session_tables({})) tables.push_back(table.name);
    std::map<std::string, std::string> versions;
    SessionFile file;
    if (!file.open(path, tables).empty()) return versions;
    SessionQuery keys(file.handle(), "SELECT key, value FROM session ORDER BY rowid LIMIT 10000");
    while (keys.next())
        if (const std::string key = keys.text(0); key.starts_with(start))
            versions[key.substr(start.size())] = keys.text(1);
    return versions;
}

}  // namespace kerf::session
