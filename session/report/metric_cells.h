// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "session/recording.h"

/// Cells and rows of the tables of metrics in report.html. All functions return safe HTML, except those of names.
namespace kerf::session {

/// Returns the id with spaces for "-", "_" and ".".   [any]
[[nodiscard]] std::string words_of(std::string_view id);
[[nodiscard]] std::string capitalised(std::string words);

/// Returns the name for people of a metric or quantity, by its id without the step.   [any]
[[nodiscard]] std::string name_of(std::string_view id);

/// Returns the id of a metric without its step.   [any]
[[nodiscard]] std::string_view short_id(const MetricRow& metric);

[[nodiscard]] std::string with_unit(const std::string& number, const std::string& unit);

/// Returns the value in the metric's unit.   [any]
/// @param bounds   in the metric's unit
[[nodiscard]] std::string value_html(const MetricRow& metric, std::span<const double> bounds = {},
                                     bool with_uncertainty = true);

/// Returns the head of a row: the name for people, the id for programs, and the meaning.   [any]
[[nodiscard]] std::string what_html(const std::string& name, std::string_view id, const std::string& help);

/// The last cell of a row.
struct RowResult {
    const char* css;
    const char* text;
    bool is_failed = false;
};

/// Returns a row of `table_html`.   [any]
/// @param what       result of what_html
/// @param measured   safe HTML, as is `bound`
[[nodiscard]] std::string row_html(const std::string& what, const std::string& measured, const std::string& bound,
                                   RowResult result);

/// Returns the row of a metric that no goal or limit is on.   [any]
[[nodiscard]] std::string metric_row_html(const MetricRow& metric);

[[nodiscard]] std::string table_html(const std::string& rows);

}  // namespace kerf::session
