// SPDX-License-Identifier: Apache-2.0
#include "conformance/check.h"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "conformance/child_program.h"
#include "conformance/procedures.h"
#include "core/plugin/plain_text.h"

namespace kerf::conformance {

namespace {

using Json = nlohmann::json;

/// A program in one of the folders of PATH; empty if there is none.
std::string found_program(const std::string& name) {
    const char* const path = std::getenv("PATH");
    std::istringstream folders(path != nullptr ? path : "");
    for (std::string folder; std::getline(folders, folder, ':');)
        if (const std::string file = folder + "/" + name; ::access(file.c_str(), X_OK) == 0) return file;
    return {};
}

/// Adds what callgrind counts, where it is installed. The count is the same each time for the same files, and differs
/// between compilers: it is compared with an earlier one of the same plugin, and never judged.
void count_instructions(const CheckRequest& request, PluginReport& report) {
    const std::string valgrind = found_program("valgrind");
    if (valgrind.empty()) return;
    std::vector<std::string> laws;
    for (const TestResult& result : report.results)
        if (result.id == "law.answers" && result.status == Status::passed) laws.push_back(result.subject);
    for (const std::string& law : laws) {
        const Json order{{"plugin", std::filesystem::absolute(report.path).string()}, {"count", law}};
        ChildProgram child({.arguments = {valgrind, "--tool=callgrind", "--toggle-collect=kerf_counted_resist",
                                          "--callgrind-out-file=/dev/null", request.child,
                                          order.dump(-1, ' ', false, Json::error_handler_t::replace)},
                            .with_errors = true});
        long long instructions = -1, calls = 0;
        for (std::string line; child.read_line(line, request.is_interrupted);) {
            if (const std::size_t at = line.find("Collected : "); at != std::string::npos)
                instructions = std::atoll(line.c_str() + at + 12);
            const Json said = Json::parse(line, nullptr, false);
            if (said.is_object()) calls = said.value("calls", 0);
        }
        if (instructions > 0 && calls > 0)
            report.notes.push_back("one `resist` of " + law + ": " + std::to_string(instructions / calls) +
                                   " instructions (callgrind)");
    }
}

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
    PluginReport report{path, "", {}, {}, ""};
    Json order{{"plugin", std::filesystem::absolute(path).string()},
               {"level", request.level},
               {"only", request.only},
               {"excluded", Json::array()}};
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
        if (said.contains("does_not")) report.does_not = said["does_not"];
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
    else if (request.level >= 4 && request.only.empty())
        count_instructions(request, report);
    if (report.error.empty() && request.level >= 5) check_procedures(request, report, on_result);
    return report;
}

}  // namespace kerf::conformance
