// SPDX-License-Identifier: Apache-2.0
#include "core/procedure/quantity.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <system_error>

#include "kerf/units.hpp"

namespace kerf {
namespace {

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t' || text.front() == '\n'))
        text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\n')) text.remove_suffix(1);
    return text;
}

/// Takes a number off the front of `text`. Empty if there is none, or none that a computer can hold.
std::optional<double> take_number(std::string_view& text) {
    text = trimmed(text);
    const std::size_t digit = !text.empty() && text[0] == '-' ? 1 : 0;
    const bool is_figure = text.size() > digit && ((text[digit] >= '0' && text[digit] <= '9') || text[digit] == '.');
    if (!is_figure) return std::nullopt;  // from_chars would take "inf" and "nan"
    double value = 0.0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure != std::errc{} || !std::isfinite(value)) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return value;
}

/// A value of the file, shortened: it may be a whole paragraph.
std::string quoted(std::string_view text) {
    std::string shown(text.substr(0, 40));
    while (!shown.empty() && text.size() > 40 && (static_cast<unsigned char>(shown.back()) & 0x80u)) shown.pop_back();
    std::replace(shown.begin(), shown.end(), '\n', ' ');
    return "`" + shown + (text.size() > 40 ? "…`" : "`");
}

std::string number_text(double value) {
    char text[40];
    const auto end =
        std::to_chars(text, text + sizeof text, value == 0.0 ? 0.0 : value, std::chars_format::general, 10).ptr;
    return std::string(text, end);
}

std::string with_unit(std::string number, std::string_view unit) {
    if (!unit.empty()) number.append(" ").append(unit);
    return number;
}

std::string what_is_needed(const QuantityNeed& need) {
    return need.unit.empty() ? "a plain number" : "a number in " + need.unit;
}

/// A value to show how one is written.
double example_of(const QuantityNeed& need) {
    const std::optional<Unit> unit = parse_unit(need.unit);
    return std::clamp(unit ? unit->factor : 1.0, need.min, need.max);
}

QuantityProblem not_a_number(std::string_view text, const std::string& name, const QuantityNeed& need) {
    QuantityProblem problem{Code::not_a_number,
                            name + " is " + quoted(text) + ", must be " + what_is_needed(need) +
                                ". Write one, as in `" + quantity_text(example_of(need), need.unit) + "`.",
                            {}};

    // "3,2 mm" is how half of the world writes it.
    std::string with_point(text.substr(0, 40));
    std::replace(with_point.begin(), with_point.end(), ',', '.');
    std::string_view rest = with_point;
    const std::size_t comma = with_point.find('.');
    if (std::count(text.begin(), text.end(), ',') == 1 && take_number(rest) &&
        (need.unit.empty() ? trimmed(rest).empty() : parse_unit(rest).has_value()))
        return decimal_comma(name, with_point.substr(0, comma), with_point.substr(comma + 1));
    return problem;
}

/// The factor of the unit behind a number; the problem if it is not a unit of the kind needed.
Parsed<double> factor_of(std::string_view unit_text, std::string_view number, std::string_view text,
                         const std::string& name, const QuantityNeed& need) {
    const std::string as_needed = with_unit(std::string(trimmed(number)), need.unit);
    if (unit_text.empty()) {
        if (need.unit.empty()) return {1.0, {}};
        return {std::nullopt, {Code::missing_unit, name + " is " + quoted(text) + ", which has no unit.", as_needed}};
    }
    const std::optional<Unit> unit = parse_unit(unit_text);
    if (!unit)
        return {std::nullopt,
                {Code::unknown_unit,
                 name + " has an unknown unit " + quoted(unit_text) + ", must be " + what_is_needed(need) + ".",
                 as_needed}};
    // "Push with ten kilograms" is what people say; ten newtons are not what they mean.
    double mass_value = 0.0;
    if (unit->dimension == dimension::mass && need.dimension == dimension::force &&
        std::from_chars(number.data(), number.data() + number.size(), mass_value).ec == std::errc{})
        return {
            std::nullopt,
            {Code::wrong_dimension, name + " is " + quoted(text) + ", a mass, must be " + what_is_needed(need) + ".",
             quantity_text(std::round(mass_value * unit->factor * 9.80665), "N")}};
    if (!(unit->dimension == need.dimension))
        return {std::nullopt,
                {Code::wrong_dimension, name + " is " + quoted(text) + ", must be " + what_is_needed(need) + ".",
                 as_needed}};
    return {unit->factor, {}};
}

bool in_range(double value, const QuantityNeed& need) {
    // 0.1 mm must not fail against a limit of 0.1e-3 m for its last bit.
    const double slack = 1e-12 * std::max(std::abs(need.min), std::abs(need.max));
    return value >= need.min - slack && value <= need.max + slack;
}

/// What somebody meant who wrote a value out of range: the sign or the decimal point slipped, or else the nearest end.
double likely_meant(double value, const QuantityNeed& need) {
    const auto fits = [&](double v) { return v >= need.min && v <= need.max; };
    if (fits(-value)) return -value;
    if (value > 2.0 * need.max && fits(value / 10.0)) return value / 10.0;
    if (value < 0.5 * need.min && value > 0.0 && fits(value * 10.0)) return value * 10.0;
    return std::clamp(value, need.min, need.max);
}

/// Whether a person reads it at a glance: one end of a range in minutes may be a second.
bool is_short(double value, const std::string& unit) {
    const std::string text = quantity_text(value, unit);
    return std::count_if(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; }) <= 7;
}

/// The range in the unit the value was written in; empty for the one of `need`, which it is too where the other has no
/// short number for an end.
QuantityProblem out_of_range(double value, std::string_view unit, const std::string& name, const QuantityNeed& need) {
    const std::string written_in(unit.empty() ? std::string_view(need.unit) : unit);
    const std::string shown_in =
        is_short(need.min, written_in) && is_short(need.max, written_in) ? written_in : need.unit;
    const std::string message = name + " is " + quantity_text(value, written_in) + ", must be " +
                                quantity_text(need.min, shown_in) + " … " + quantity_text(need.max, shown_in) + ".";
    // The end of a range in another unit may round to just outside of it.
    const double meant = likely_meant(value, need);
    const std::string write = quantity_text(meant, shown_in);
    const std::optional<double> read_again =
        parse_quantity(write, name, {need.dimension, need.unit, -HUGE_VAL, HUGE_VAL}).value;
    return {Code::out_of_range, message,
            read_again && in_range(*read_again, need) ? write : quantity_text(meant, need.unit)};
}

/// "1, 2, 3 mm" and "0,5 0 0 mm" as they would be read; empty if commas are not what is wrong.
std::string without_commas(std::string_view text, const std::string& name, const QuantityNeed& need) {
    std::string meant;
    for (std::size_t i = 0; i < std::min<std::size_t>(text.size(), 80); ++i) {
        const bool is_between = text[i] == ',' && i + 1 < text.size() && text[i + 1] == ' ';
        if (!is_between) meant += text[i] == ',' ? '.' : text[i];
    }
    const bool has_comma = text.find(',') != std::string_view::npos;
    return has_comma && parse_vector(meant, name, need).value ? meant : std::string();
}

constexpr const char* number_pattern = R"(-?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?)";

std::string power_pattern(int power) {
    if (power == 1) return "";
    const std::string figure = std::to_string(power);
    const std::string raised = power == 2 ? "|²" : power == 3 ? "|³" : "";
    return "(\\^?" + figure + raised + ")";
}

/// Units of this dimension, and all that are made of several.
std::string unit_pattern(const kerf_dimension& dimension) {
    std::string fitting, any;
    for (const UnitSymbol& symbol : unit_symbols()) {
        any += (any.empty() ? "" : "|") + std::string(symbol.name);
        for (int power = 1; power <= 4; ++power) {
            bool fits = true;
            for (int i = 0; i < 8; ++i) fits = fits && power * symbol.dimension.exponent[i] == dimension.exponent[i];
            const bool is_one = power > 1 && symbol.dimension == dimension::none;  // `%` needs no powers
            if (fits && !is_one) fitting += std::string(symbol.name) + power_pattern(power) + "|";
        }
    }
    const std::string factor = "(" + any + ")(\\^?[2-4]|²|³)?";
    return fitting + factor + "([/* ]" + factor + "){1," + std::to_string(max_unit_factors - 1) + "}";
}

}  // namespace

QuantityProblem decimal_comma(const std::string& name, const std::string& before, const std::string& behind) {
    const std::string is = name + " is `" + before + "," + behind + "`, but a number has a decimal point, not a comma.";
    const std::string with_point = before + "." + behind;
    const std::size_t digits = std::min(behind.find_first_not_of("0123456789"), behind.size());
    if (digits != 3) return {Code::not_a_number, is, with_point};
    return {Code::not_a_number, is + " Write `" + before + behind + "` for thousands, or `" + with_point + "`.", {}};
}

std::string quantity_pattern(const QuantityNeed& need) {
    const std::string number = number_pattern;
    if (!need.unit.empty()) return "^\\s*" + number + "\\s*(" + unit_pattern(need.dimension) + ")\\s*$";
    return "^\\s*" + number + "(\\s*/\\s*" + number + ")?\\s*(" + unit_pattern(need.dimension) + ")?\\s*$";
}

std::string vector_pattern(const QuantityNeed& need) {
    const std::string number = number_pattern, unit = "(" + unit_pattern(need.dimension) + ")";
    return "^\\s*" + number + "\\s+" + number + "\\s+" + number + "\\s*" + unit + (need.unit.empty() ? "?" : "") +
           "\\s*$";
}

std::string quantity_text(double value, std::string_view unit) {
    const std::optional<Unit> known = parse_unit(unit);
    return with_unit(number_text(known ? value / known->factor : value), unit);
}

Parsed<double> parse_quantity(std::string_view text, const std::string& name, const QuantityNeed& need) {
    text = trimmed(text);
    std::string_view rest = text;
    const std::optional<double> number = take_number(rest);
    if (!number) return {std::nullopt, not_a_number(text, name, need)};
    const std::string_view number_part = text.substr(0, text.size() - rest.size());
    if (rest.starts_with(',')) return {std::nullopt, not_a_number(text, name, need)};
    rest = trimmed(rest);

    double value = *number;
    if (need.unit.empty() && rest.starts_with('/')) {  // a fraction
        rest.remove_prefix(1);
        const std::optional<double> below = take_number(rest);
        if (!below || *below == 0.0) return {std::nullopt, not_a_number(text, name, need)};
        value /= *below;
        rest = trimmed(rest);
    }
    const Parsed<double> factor = factor_of(rest, number_part, text, name, need);
    if (!factor.value) return factor;
    value *= *factor.value;
    if (!std::isfinite(value)) return {std::nullopt, not_a_number(text, name, need)};
    if (!in_range(value, need)) return {std::nullopt, out_of_range(value, rest, name, need)};
    return {value, {}};
}

Parsed<Vec3> parse_vector(std::string_view text, const std::string& name, const QuantityNeed& need) {
    text = trimmed(text);
    std::string_view rest = text;
    std::array<double, 3> number{};
    for (double& component : number) {
        const std::optional<double> taken = take_number(rest);
        const bool is_apart = &component == &number.back() || trimmed(rest).size() < rest.size();
        if (!taken || !is_apart || rest.starts_with(',')) {
            const std::string meant = without_commas(text, name, need);
            const std::string example = need.unit.empty()
                                            ? ", as in `0 0 1`."
                                            : " and one unit, as in `" + with_unit("1 2 3", need.unit) + "`.";
            return {std::nullopt,
                    {Code::not_three_numbers,
                     name + " is " + quoted(text) + ", must be three numbers" + example +
                         (meant.empty() ? " Write it so." : ""),
                     meant}};
        }
        component = *taken;
    }
    const std::string_view number_part = text.substr(0, text.size() - rest.size());
    rest = trimmed(rest);
    if (std::string_view more = rest; take_number(more) && !parse_unit(rest))
        return {std::nullopt,
                {Code::not_three_numbers,
                 name + " is " + quoted(text) + ", must be three numbers, not more. Remove the rest.",
                 {}}};
    const Parsed<double> factor = factor_of(rest, number_part, text, name, need);
    if (!factor.value) return {std::nullopt, factor.problem};
    for (double& component : number) {
        component *= *factor.value;
        if (!in_range(component, need)) return {std::nullopt, out_of_range(component, rest, name, need)};
    }
    return {Vec3{number[0], number[1], number[2]}, {}};
}

}  // namespace kerf
