// SPDX-License-Identifier: Apache-2.0
#include "conformance/acceptance_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/plugin/plain_text.h"
#include "kerf/units.hpp"

namespace kerf::conformance {

namespace {

constexpr const char* notice = "# For training and research; not for diagnosis, planning or deciding treatment";
constexpr const char* magic = "# kerf acceptance 1";
constexpr const char* columns = "tick,x_mm,y_mm,z_mm,rx_deg,ry_deg,rz_deg,drive,fx_N,fy_N,fz_N,tx_Nmm,ty_Nmm,tz_Nmm";
constexpr std::size_t pose_columns = 8, all_columns = 14, max_rows = 100000;
constexpr double mm = 1e-3, degree = pi / 180.0;
const Quat down = quat_between({0, 0, 1}, {0, 0, -1});

std::string figure(double value) {
    char text[40];
    const auto end = std::to_chars(text, text + sizeof text, value == 0.0 ? 0.0 : value, std::chars_format::general, 7);
    return {text, end.ptr};
}

bool parse(std::string_view text, double& value) {
    while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\r')) text.remove_suffix(1);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
}

std::vector<std::string_view> cells_of(std::string_view line) {
    std::vector<std::string_view> cells;
    for (std::size_t at = 0; at <= line.size();) {
        const std::size_t end = std::min(line.find(',', at), line.size());
        cells.push_back(line.substr(at, end - at));
        at = end + 1;
    }
    return cells;
}

/// A row's faults, without file and line; empty if there are none.
std::string read_row(std::string_view line, AcceptanceRow& row) {
    const auto cells = cells_of(line);
    if (cells.size() != pose_columns && cells.size() != all_columns)
        return "has " + std::to_string(cells.size()) + " columns, expected " + std::to_string(pose_columns) +
               " (a script) or " + std::to_string(all_columns) + " (with forces): " + columns;
    std::array<double, all_columns> value{};
    const bool has_forces =
        cells.size() == all_columns && cells[pose_columns].find_first_not_of(" \r") != std::string_view::npos;
    for (std::size_t i = 0; i < (has_forces ? all_columns : pose_columns); ++i)
        if (!parse(cells[i], value[i]))
            return "column " + std::to_string(i + 1) + " is " + quoted_plain(cells[i]) + ", expected a number";
    if (!(value[0] >= 0.0 && value[0] <= 1e7) || value[0] != std::floor(value[0]))
        return "tick is " + quoted_plain(cells[0]) + ", expected a whole number from 0 to 10000000";
    for (std::size_t i = 1; i < 4; ++i)
        if (std::abs(value[i]) > 100.0) return "a position is beyond 100 mm";
    row.tick = static_cast<std::uint64_t>(value[0]);
    row.block_from_tool = {{mm * value[1], mm * value[2], mm * value[3]},
                           quat_from_rotation_vector({degree * value[4], degree * value[5], degree * value[6]}) * down};
    row.drive = value[7];
    if (has_forces) row.wrench = {value[8], value[9], value[10], mm * value[11], mm * value[12], mm * value[13]};
    return {};
}

/// A heading such as "# law: burr with burring".
std::string after(const std::string& line, const std::string& key) {
    return line.starts_with(key) ? line.substr(key.size()) : std::string();
}

}  // namespace

std::optional<AcceptanceFile> read_acceptance(const std::string& path, std::string& error) {
    std::ifstream in(path);
    if (!in) {
        error = quoted_plain(path) + " cannot be read. Check its name, or record it with `--record`.";
        return std::nullopt;
    }
    return parse_acceptance(in, path, error);
}

std::optional<AcceptanceFile> parse_acceptance(std::istream& in, const std::string& name, std::string& error) {
    AcceptanceFile file;
    std::string line;
    bool has_magic = false;
    const auto wrong = [&](int number, const std::string& what) {
        error = plain(name) + ":" + std::to_string(number) + ": " + what + ".";
        return std::nullopt;
    };
    for (int number = 1; std::getline(in, line); ++number) {
        while (!line.empty() && line.back() == '\r') line.pop_back();
        if (line.size() > 4096) return wrong(number, "the line is longer than 4096 characters");
        if (line == magic) has_magic = true;
        if (const std::string law = after(line, "# law: "); !law.empty()) file.subject = law;
        if (const std::string text = after(line, "# tolerance: "); !text.empty()) {
            std::istringstream words(text);
            std::string share, percent, force, unit;
            words >> share >> percent >> force >> unit;
            double first = 0.0, second = 0.0;
            if (!parse(share, first) || percent != "%" || !parse(force, second) || unit != "N" || first < 0.0 ||
                second < 0.0)
                return wrong(number, "the tolerance is " + quoted_plain(text) + "; write `# tolerance: 2 % 0.05 N`");
            file.tolerance = 0.01 * first;
            file.floor = second;
        }
        if (line.empty() || line.front() == '#' || line.starts_with("tick,")) continue;
        AcceptanceRow row;
        if (const std::string fault = read_row(line, row); !fault.empty()) return wrong(number, fault);
        if (!file.rows.empty() && row.tick <= file.rows.back().tick)
            return wrong(number, "tick " + std::to_string(row.tick) + " comes after tick " +
                                     std::to_string(file.rows.back().tick) + "; list the rows in time order");
        if (file.rows.size() >= max_rows) return wrong(number, "there are more than 100000 rows");
        file.rows.push_back(row);
    }
    if (!has_magic) return wrong(1, std::string("it is no acceptance file. Write the line `") + magic + "`");
    if (file.rows.size() < 2) return wrong(1, "it has fewer than two rows");
    return file;
}

std::string acceptance_text(const AcceptanceFile& file) {
    std::string text =
        std::string(notice) + "\n" + magic + "\n# law: " + file.subject +
        "\n# tolerance: " + figure(100.0 * file.tolerance) + " % " + figure(file.floor) +
        " N\n# Straight lines from row to row; forces of the bone on the tool, about its tip, block frame.\n" +
        columns + "\n";
    for (const AcceptanceRow& row : file.rows) {
        const Vec3 p = row.block_from_tool.position,
                   turn = small_rotation_vector(row.block_from_tool.rotation * conjugate(down));
        const double values[] = {p.x / mm,        p.y / mm,        p.z / mm, turn.x / degree,
                                 turn.y / degree, turn.z / degree, row.drive};
        text += std::to_string(row.tick);
        for (const double value : values) text += "," + figure(std::abs(value) < 1e-9 ? 0.0 : value);
        for (std::size_t i = 0; i < 6; ++i)
            text += "," + (row.wrench ? figure(std::abs((*row.wrench)[i]) < 1e-9 ? 0.0
                                               : i < 3                           ? (*row.wrench)[i]
                                                                                 : (*row.wrench)[i] / mm)
                                      : std::string());
        text += "\n";
    }
    return text;
}

namespace {

AcceptanceFile exact_script() {
    AcceptanceFile file;
    std::uint64_t tick = 0;
    const auto go = [&](double depth, double aside, double tilt, double drive, int ticks) {
        constexpr int apart = 25;  // [ticks] between rows
        const Pose from = file.rows.empty() ? identity_pose() : file.rows.back().block_from_tool;
        const Vec3 along{std::sin(tilt), 0, -std::cos(tilt)};
        const Pose to{Vec3{aside, 0, 0} + depth * along, quat_between({0, 0, 1}, along)};
        const int count = std::max(1, ticks / apart);
        for (int i = 1; i <= count; ++i) {
            const double share = static_cast<double>(i) / count;
            tick += static_cast<std::uint64_t>(ticks / count);
            const Quat turn = conjugate(from.rotation) * to.rotation;
            const Pose pose =
                file.rows.empty()
                    ? to
                    : Pose{from.position + share * (to.position - from.position),
                           from.rotation * quat_from_rotation_vector(share * small_rotation_vector(turn))};
            file.rows.push_back({tick, pose, drive});
        }
    };
    constexpr double above = -0.5e-3, deep = 3e-3, askew = 20.0 * degree;
    file.rows.push_back({0, {{0, 0, -above}, down}, 1.0});
    tick = 575;
    go(above, 0.0, 0.0, 1.0, 25);     // a motor comes to its speed
    go(deep, 0.0, 0.0, 1.0, 1750);    // in at 2 mm/s
    go(deep, 0.5e-3, 0.0, 1.0, 250);  // sideways
    go(deep, 0.0, 0.0, 1.0, 250);
    go(above, 0.0, 0.0, 1.0, 175);  // out
    go(above, 4e-3, askew, 1.0, 100);
    go(1.5e-3, 4e-3, askew, 1.0, 1000);  // in askew
    go(above, 4e-3, askew, 0.0, 100);    // switched off
    go(above, -4e-3, 0.0, 0.0, 500);
    go(0.1e-3, -4e-3, 0.0, 0.0, 300);  // pressed on at rest
    go(above, -4e-3, 0.0, 0.0, 100);
    return file;
}

/// What may differ in a row [N], [N·m].
std::pair<double, double> allowed(const AcceptanceFile& recorded, const std::array<double, 6>& w) {
    constexpr double arm = 5e-3;  // [m] at which the force that is always allowed makes a torque
    const double force = length(Vec3{w[0], w[1], w[2]}), torque = length(Vec3{w[3], w[4], w[5]});
    return {recorded.floor + recorded.tolerance * force, arm * recorded.floor + recorded.tolerance * torque};
}

}  // namespace

AcceptanceFile standard_script() {
    std::istringstream text(acceptance_text(exact_script()));
    std::string error;
    return parse_acceptance(text, "", error).value_or(AcceptanceFile{});
}

Comparison compare(const AcceptanceFile& recorded, const std::vector<AcceptanceRow>& found) {
    Comparison result;
    for (std::size_t r = 0; r < std::min(recorded.rows.size(), found.size()); ++r) {
        const auto [force, torque] = allowed(recorded, *recorded.rows[r].wrench);
        for (std::size_t i = 0; i < 6; ++i) {
            const double may = i < 3 ? force : torque,
                         differs = std::abs((*found[r].wrench)[i] - (*recorded.rows[r].wrench)[i]) / may;
            if (differs <= result.worst && result.allowed > 0.0) continue;
            result = {.worst_row = r, .worst_component = i, .worst = differs, .allowed = may};
        }
    }
    return result;
}

std::string difference_csv(const AcceptanceFile& recorded, const std::vector<AcceptanceRow>& found) {
    std::string text = std::string(notice) + "\ntick,component,recorded,found,difference\n";
    constexpr const char* names[] = {"fx_N", "fy_N", "fz_N", "tx_Nmm", "ty_Nmm", "tz_Nmm"};
    for (std::size_t r = 0; r < std::min(recorded.rows.size(), found.size()); ++r)
        for (std::size_t i = 0; i < 6; ++i) {
            const double unit = i < 3 ? 1.0 : mm, was = (*recorded.rows[r].wrench)[i] / unit,
                         is = (*found[r].wrench)[i] / unit;
            text += std::to_string(recorded.rows[r].tick) + "," + names[i] + "," + figure(was) + "," + figure(is) +
                    "," + figure(is - was) + "\n";
        }
    return text;
}

}  // namespace kerf::conformance
