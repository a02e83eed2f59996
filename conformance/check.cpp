// SPDX-License-Identifier: Apache-2.0
#include "conformance/check.h"

#include <nlohmann/json.hpp>
#include <regex>

#include "conformance/child_program.h"
#include "conformance/procedures.h"
#include "core/plugin/plain_text.h"

namespace kerf::conformance {

namespace {

using Json = nlohmann::json;

}  // namespace

std::string refusal_of_pattern(const std::string& pattern) {
    try {
        static_cast<void>(std::regex(pattern, std::regex::ECMAScript));
        return {};
    } catch (const std::regex_error&) {
        return quoted_plain(pattern) + " is no regular expression. Write one, as in `law` or `^law\\.pure$`.";
    }
}

PluginReport check_plugin(const std::string& path, const CheckRequest& request,
                          const std::function<void(const TestResult&)>& on_result) {
    PluginReport report{path, "", {}, ""};
    Json order{{"plugin", path}, {"level", request.level}, {"only", request.only}, {"excluded", Json::array()}};
    for (const auto& [pattern, reason] : request.excluded) order["excluded"].push_back({pattern, reason});
    ChildProgram child({.arguments = {request.child, order.dump(-1, ' ', false, Json::error_handler_t::replace)}});
    if (!child.error().empty()) {
        report.error = request.child + " cannot be started: " + child.error() + ". Install Kerf again.";
        return report;
    }
    bool has_ended = false;
    for (std::string line; !has_ended && child.read_line(line, request.is_interrupted);) {
        const Json said = Json::parse(line, nullptr, false);
        if (!said.is_object()) continue;
        has_ended = said.contains("end");
        if (said.contains("plugin")) report.plugin = said["plugin"];
        if (!said.contains("id")) continue;
        report.results.push_back({said.value("id", ""), said.value("level", 0), said.value("subject", ""),
                                  said.value("sentence", ""), static_cast<Status>(said.value("status", 2)),
                                  said.value("text", ""), said.value("output", ""), said.value("seconds", 0.0)});
        if (on_result) on_result(report.results.back());
    }
    if (!has_ended)
        report.error = request.is_interrupted && request.is_interrupted()
                           ? "interrupted"
                           : "the kit itself ended before the tests did. This is a fault of Kerf; please report it.";
    else if (request.level >= 5)
        check_procedures(request, report, on_result);
    return report;
}

}  // namespace kerf::conformance
