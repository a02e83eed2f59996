// SPDX-License-Identifier: Apache-2.0
#include "conformance/acceptance.h"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "conformance/acceptance_file.h"
#include "conformance/acceptance_picture.h"
#include "conformance/child_program.h"
#include "conformance/words.h"
#include "core/plugin/plain_text.h"
#include "text/shell.h"
#include "text/write_file.h"

namespace kerf::conformance {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

AcceptanceOutcome refused(const std::string& error, bool is_bad_input = true) {
    AcceptanceOutcome outcome;
    outcome.error = error;
    outcome.is_bad_input = is_bad_input;
    return outcome;
}

/// Fills in the wrenches of the file's rows. Returns what went wrong.
std::string found_by(const AcceptanceRequest& request, const std::string& script, AcceptanceFile& file) {
    const Json order{{"plugin", fs::absolute(request.plugin).string()}, {"script", script}, {"subject", request.law}};
    ChildProgram child({.arguments = {request.child, order.dump(-1, ' ', false, Json::error_handler_t::replace)}});
    if (!child.error().empty()) return request.child + " cannot be started: " + child.error() + ".";
    Json answer;
    for (std::string line; child.read_line(line, {});) answer = Json::parse(line, nullptr, false);
    if (!answer.is_object()) return "the kit itself ended. This is a fault of Kerf; please report it.";
    if (const std::string error = answer["error"]; !error.empty()) return error;
    file.subject = answer["subject"];
    for (std::size_t r = 0; r < file.rows.size(); ++r)
        file.rows[r].wrench = answer["wrenches"].at(r).get<std::array<double, 6>>();
    return {};
}

std::string stem_of(const AcceptanceRequest& request) { return fs::path(request.file).stem().string(); }

}  // namespace

AcceptanceOutcome accept(const AcceptanceRequest& request) {
    std::string error;
    const auto recorded = read_acceptance(request.file, error);
    if (!recorded) return refused(error);
    if (std::any_of(recorded->rows.begin(), recorded->rows.end(), [](const auto& row) { return !row.wrench; }))
        return refused(plain(request.file) + " holds a script without forces. Record them: `kerf check " +
                       text::shell_path(request.plugin) + " --record " + text::shell_path(request.file) + "`.");
    AcceptanceFile found = *recorded;
    if (error = found_by(request, request.file, found); !error.empty())
        return refused(plain(request.plugin) + ": " + error, false);
    const Comparison result = compare(*recorded, found.rows);

    AcceptanceOutcome outcome;
    outcome.is_accepted = result.worst <= 1.0;
    const bool is_force = result.worst_component < 3;
    const double unit = is_force ? 1.0 : 1e-3;
    const std::size_t r = result.worst_row, i = result.worst_component;
    constexpr const char* names[] = {"force x", "force y", "force z", "torque x", "torque y", "torque z"};
    outcome.text = found.subject + ": " + (outcome.is_accepted ? "accepted" : "NOT ACCEPTED") +
                   "; the largest difference is in the " + names[i] + " at tick " +
                   std::to_string(recorded->rows[r].tick) + ": recorded " +
                   number((*recorded->rows[r].wrench)[i] / unit) + ", found " +
                   number((*found.rows[r].wrench)[i] / unit) + (is_force ? " N" : " N mm") + ", allowed ± " +
                   number(result.allowed / unit) + "\n";
    if (request.folder.empty()) return outcome;
    std::error_code failed;
    fs::create_directories(request.folder, failed);
    const std::string stem = (fs::path(request.folder) / (stem_of(request) + "-difference")).string();
    error = text::write_file(stem + ".csv", difference_csv(*recorded, found.rows));
    if (error.empty()) error = text::write_file(stem + ".svg", difference_svg(*recorded, found.rows));
    if (!error.empty()) return refused(error, false);
    outcome.text += "  " + stem + ".csv\n  " + stem + ".svg\n";
    return outcome;
}

AcceptanceOutcome record(const AcceptanceRequest& request) {
    std::string error;
    AcceptanceFile file = standard_script();
    const bool has_script = fs::exists(request.file);
    if (has_script) {
        auto script = read_acceptance(request.file, error);
        if (!script) return refused(error);
        file = std::move(*script);
    }
    if (error = found_by(request, has_script ? request.file : "", file); !error.empty())
        return refused(plain(request.plugin) + ": " + error, false);
    if (error = text::write_file(request.file, acceptance_text(file)); !error.empty()) return refused(error, false);
    AcceptanceOutcome outcome;
    outcome.is_accepted = true;
    outcome.text = file.subject + ": " + std::to_string(file.rows.size()) + " rows recorded\n  " + request.file + "\n";
    return outcome;
}

}  // namespace kerf::conformance
