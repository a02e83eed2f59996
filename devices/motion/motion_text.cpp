// SPDX-License-Identifier: Apache-2.0
#include "devices/motion/motion_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <system_error>

namespace kerf::motion {

namespace {

constexpr std::array names{"time [s]",   "x [m]",      "y [m]",      "z [m]",  "rotation w",
                           "rotation x", "rotation y", "rotation z", "buttons"};
constexpr std::size_t columns = names.size();
constexpr double max_time = 86400.0, max_position = 2.0;  // [s], [m]
constexpr double max_buttons = 4294967295.0;              // bits of 32 buttons
constexpr double max_length_error = 1e-3;                 // [–] of a quaternion
constexpr double max_rounding = 1e-12;  // [–] of the square of a length; below it nothing is normalised

/// Returns a text of a file between back quotes, cut to 20 characters, without what a terminal would obey.
std::string quoted(std::string_view text) {
    constexpr std::size_t max = 20;
    std::string shown = "`";
    for (const char c : text.substr(0, max)) shown += c >= ' ' && c <= '~' ? c : '?';
    return shown + (text.size() > max ? "…`" : "`");
}

std::string number(double value) {
    std::array<char, 32> digits{};
    return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blank = " \t\r";
    const std::size_t begin = text.find_first_not_of(blank);
    return begin == std::string_view::npos ? std::string_view()
                                           : text.substr(begin, text.find_last_not_of(blank) - begin + 1);
}

/// Reads one column. Returns why it cannot be read; empty on success.
std::string read_column(std::string_view text, std::size_t column, double& value) {
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool is_number = status == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
    const std::string name = std::string("`") + names[column] + "`";
    if (!is_number) return name + " is " + quoted(text) + ", need a number, as in 0.0125.";
    const auto outside = [&](double min, double max) {
        return value >= min && value <= max
                   ? std::string()
                   : name + " is " + number(value) + ", need " + number(min) + " to " + number(max) + ".";
    };
    if (column == 0) return outside(0.0, max_time);
    if (column <= 3) return outside(-max_position, max_position);
    if (column <= 7) return outside(-1.0 - max_length_error, 1.0 + max_length_error);
    if (value != std::floor(value)) return name + " is " + number(value) + ", need a whole number, the sum of 2^i.";
    return outside(0.0, max_buttons);
}

/// Reads the numbers of a line. Returns why it cannot; empty on success.
std::string read_columns(std::string_view line, std::array<double, columns>& values) {
    const auto count = static_cast<std::size_t>(std::count(line.begin(), line.end(), ',')) + 1;
    if (count != columns)
        return "there are " + std::to_string(count) + " columns, need " + std::to_string(columns) +
               ": time, position x, y, z, rotation w, x, y, z, buttons.";
    for (std::size_t column = 0; column < columns; ++column) {
        const std::size_t comma = std::min(line.find(','), line.size());
        if (std::string fault = read_column(trimmed(line.substr(0, comma)), column, values[column]); !fault.empty())
            return fault;
        line.remove_prefix(std::min(comma + 1, line.size()));
    }
    return {};
}

/// Reads the row of a line. Returns why it cannot; empty on success.
std::string read_row(std::string_view line, MotionRow& row) {
    std::array<double, columns> v{};
    if (std::string fault = read_columns(line, v); !fault.empty()) return fault;
    Quat rotation{v[4], v[5], v[6], v[7]};
    const double square = v[4] * v[4] + v[5] * v[5] + v[6] * v[6] + v[7] * v[7];
    if (!(std::abs(std::sqrt(square) - 1.0) <= max_length_error))
        return "the quaternion of the rotation has the length " + number(std::sqrt(square)) +
               ", need 1 within 0.001. Divide it by its length.";
    if (std::abs(square - 1.0) > max_rounding) rotation = normalized(rotation);
    row = {v[0], {{v[1], v[2], v[3]}, rotation}, static_cast<std::uint32_t>(v[8])};
    return {};
}

/// Reads a row that comes after others. Returns why it cannot; empty on success.
std::string add_row(std::string_view line, std::vector<MotionRow>& rows) {
    if (rows.size() == max_rows)
        return "there are more than " + std::to_string(max_rows) + " rows, an hour at 1 kHz. Remove the others.";
    MotionRow row;
    if (std::string fault = read_row(line, row); !fault.empty()) return fault;
    if (!rows.empty() && row.time <= rows.back().time)
        return "`time [s]` is " + number(row.time) + ", need more than " + number(rows.back().time) +
               ", the time of the row before. Sort the rows.";
    rows.push_back(row);
    return {};
}

}  // namespace

std::optional<std::vector<MotionRow>> parse_motion(std::string_view text, std::string& error) {
    std::vector<MotionRow> rows;
    for (std::size_t number_of_line = 1; !text.empty(); ++number_of_line) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = trimmed(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
        if (line.empty() || line.front() == '#') continue;
        const std::string fault = line.size() > max_line ? "it has " + std::to_string(line.size()) +
                                                               " bytes, need at most " + std::to_string(max_line) + "."
                                                         : add_row(line, rows);
        if (fault.empty()) continue;
        error = "line " + std::to_string(number_of_line) + ": " + fault;
        return std::nullopt;
    }
    if (!rows.empty()) return rows;
    error = "it has no row, need one or more: time, position x, y, z, rotation w, x, y, z, buttons.";
    return std::nullopt;
}

std::string text_of(std::span<const MotionRow> rows, std::string_view notice) {
    std::string text = "# " + std::string(notice) + " Columns: ";
    for (std::size_t i = 0; i < columns; ++i) text += std::string(i > 0 ? ", " : "") + names[i];
    for (const MotionRow& row : rows) {
        const Vec3& p = row.device_from_handle.position;
        const Quat& q = row.device_from_handle.rotation;
        text += "\n" + number(row.time);
        for (const double value : {p.x, p.y, p.z, q.w, q.x, q.y, q.z}) text += "," + number(value);
        text += "," + std::to_string(row.buttons);
    }
    return text + "\n";
}

}  // namespace kerf::motion
