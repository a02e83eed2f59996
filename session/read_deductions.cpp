// SPDX-License-Identifier: Apache-2.0
#include "session/read_deductions.h"

#include <cstddef>
#include <nlohmann/json.hpp>

namespace kerf::session {

std::vector<DeductionRow> read_deductions(const std::string& summary) {
    using Json = nlohmann::json;
    constexpr std::size_t max_rows = 10000;
    std::vector<DeductionRow> rows;
    const Json document = Json::parse(summary, nullptr, false);
    if (!document.is_object()) return rows;
    const auto list = document.find("deductions");
    if (list == document.end() || !list->is_array()) return rows;
    for (const Json& one : *list) {
        if (!one.is_object() || rows.size() == max_rows) continue;
        const auto text = [&](const char* key) {
            const auto found = one.find(key);
            return found != one.end() && found->is_string() ? found->get<std::string>() : std::string();
        };
        const auto number = [&](const char* key) -> std::optional<double> {
            const auto found = one.find(key);
            if (found == one.end() || !found->is_number()) return {};
            return found->get<double>();
        };
        const auto loss = number("loss");
        if (!loss) continue;
        rows.push_back({.step = text("step"),
                        .kind = text("kind"),
                        .name = text("name"),
                        .detail = text("detail"),
                        .at = number("at_s"),
                        .loss = *loss});
    }
    return rows;
}

}  // namespace kerf::session
