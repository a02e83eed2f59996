// SPDX-License-Identifier: Apache-2.0
#include "session/read_session.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "session/recorded_rows.h"
#include "session/recorder.h"
#include "session/session_file.h"
#include "session/session_tables.h"

namespace kerf::session {

namespace {

/// Returns whether a pose has a unit quaternion and a position within 100 m. False for NaN.
bool is_plausible(const Pose& pose) {
    constexpr double max_distance = 100.0;  // [m]
    const auto& [w, x, y, z] = pose.rotation;
    return length(pose.position) < max_distance && std::abs(w * w + x * x + y * y + z * z - 1.0) < 1e-6;
}

constexpr std::string_view device_key = "device.";

/// Returns the number that a text is; NaN if it is none.
double number_in(const std::string& text) {
    double value = 0.0;
    const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), value);
    return status == std::errc{} && end == text.data() + text.size() ? value : std::nan("");
}

/// Reads what the session states of the whole run. Returns false if the file cannot be read.
bool read_keys(SessionFile& file, RecordedInputs& inputs) {
    SessionQuery keys(file.handle(), "SELECT key, value FROM session");
    while (keys.next()) {
        const std::string key = keys.text(0);
        if (key == "procedure_text") inputs.procedure_text = keys.text(1);
        if (key == "condition.variant") inputs.variant = keys.text(1);
        if (key == "condition.assist") inputs.assist = keys.text(1);
        if (key == "condition.examination") inputs.is_examination = true;
        if (key == "run.rehearsal") inputs.rehearsal = keys.text(1);
        if (key == "anatomy_hash") inputs.anatomy_hash = std::strtoull(keys.text(1).c_str(), nullptr, 16);
        if (key == "hash") inputs.hash = keys.text(1);
        if (key == "condition.device") inputs.device = keys.text(1);
        if (key.starts_with(device_key))
            inputs.device_values.emplace_back(key.substr(device_key.size()), number_in(keys.text(1)));
    }
    SessionQuery uuid(file.handle(), "SELECT value FROM envelope WHERE key = 'uuid'");
    if (uuid.next()) inputs.uuid = uuid.text(0);
    return !keys.has_failed();
}

std::optional<RecordedInputs> read_inputs(const std::string& path, SessionFile& file, std::string& error) {
    RecordedInputs inputs;
    const bool has_keys = read_keys(file, inputs);
    const std::vector<Table> all = recorded_tables(file.handle());
    RecordedRows ticks(
        file.handle(), find_table(all, ticks_table),
        {"tick", "device_from_handle_x", "device_from_handle_y", "device_from_handle_z", "device_from_handle_qw",
         "device_from_handle_qx", "device_from_handle_qy", "device_from_handle_qz"});
    while (ticks.next()) {
        if (ticks.integer(0) != static_cast<std::int64_t>(inputs.device_from_handle.size())) {
            error = path + ": tick " + std::to_string(inputs.device_from_handle.size()) +
                    " is missing, so it cannot be replayed.";
            return std::nullopt;
        }
        const Pose pose{{ticks.number(1), ticks.number(2), ticks.number(3)},
                        {ticks.number(4), ticks.number(5), ticks.number(6), ticks.number(7)}};
        bool is_all_numbers = true;
        for (std::size_t column = 1; column <= 7; ++column) is_all_numbers = is_all_numbers && ticks.is_number(column);
        if (!is_all_numbers || !is_plausible(pose)) {
            error = path + ": tick " + std::to_string(ticks.integer(0)) +
                    " holds no pose, so the file is damaged and cannot be replayed.";
            return std::nullopt;
        }
        inputs.device_from_handle.push_back(pose);
    }
    SessionQuery adoptions(file.handle(), std::string("SELECT tick FROM events WHERE id IN ('") + came_apart_event +
                                              "', '" + crumbled_event + "') ORDER BY rowid");
    while (adoptions.next()) inputs.adoptions.push_back(static_cast<std::uint64_t>(adoptions.integer(0)) + 1);
    SessionQuery asked(file.handle(), std::string("SELECT tick, detail FROM events WHERE id = '") + hand_input_event +
                                          "' ORDER BY rowid");
    while (asked.next()) inputs.hand_inputs.emplace_back(static_cast<std::uint64_t>(asked.integer(0)), asked.text(1));
    SessionQuery missed(
        file.handle(), std::string("SELECT tick, detail FROM events WHERE id = '") + missed_event + "' ORDER BY rowid");
    while (missed.next()) {
        const std::string text = missed.text(1);
        std::uint32_t count = 0;
        const auto [end, status] = std::from_chars(text.data(), text.data() + text.size(), count);
        if (status != std::errc{} || end != text.data() + text.size() || count == 0) {
            error = path + ": the count of ticks missed before tick " + std::to_string(missed.integer(0)) +
                    " is none. The file was changed.";
            return std::nullopt;
        }
        inputs.missed.emplace_back(static_cast<std::uint64_t>(missed.integer(0)), count);
    }
    SessionQuery lost(file.handle(), std::string("SELECT tick, id FROM events WHERE id IN ('") + lost_event + "', '" +
                                         back_event + "') ORDER BY rowid");
    while (lost.next())
        inputs.lost.emplace_back(static_cast<std::uint64_t>(lost.integer(0)), lost.text(1) == lost_event);
    SessionQuery late(file.handle(), std::string("SELECT tick, detail FROM events WHERE id = '") + late_change_event +
                                         "' ORDER BY rowid");
    while (late.next()) inputs.late_changes.emplace_back(static_cast<std::uint64_t>(late.integer(0)), late.text(1));
    if (!ticks.fault().empty()) {
        error = path + ": " + ticks.fault() + ", so it holds no ticks that can be replayed. Take an undamaged copy.";
        return std::nullopt;
    }
    if (!has_keys || adoptions.has_failed() || asked.has_failed() || missed.has_failed() || lost.has_failed() ||
        late.has_failed() || inputs.device_from_handle.empty()) {
        error = path + ": holds no ticks that can be read.";
        return std::nullopt;
    }
    SessionQuery version(file.handle(), "PRAGMA user_version");
    inputs.is_old = version.next() && version.integer(0) < first_schema_with_checksum;
    inputs.rows = check_record(file.handle());
    return inputs;
}

}  // namespace

std::optional<RecordedInputs> read_session(const std::string& path, std::string& error) {
    std::vector<std::string> tables;
    for (const Table& table : session_tables({})) tables.push_back(table.name);
    SessionFile file;
    if (error = file.open(path, tables); !error.empty()) return std::nullopt;
    auto inputs = read_inputs(path, file, error);
    if (file.outside_reason().empty()) return inputs;
    error = file.outside_reason();
    return std::nullopt;
}

}  // namespace kerf::session
