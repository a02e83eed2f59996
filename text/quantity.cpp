// SPDX-License-Identifier: Apache-2.0
#include "text/quantity.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <system_error>
#include <utility>
#include <vector>

#include "kerf/units.hpp"
#include "text/codes.h"
#include "text/foreign_units.h"
#include "text/look_alike.h"
#include "text/printable.h"

namespace kerf::text {
namespace {

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t' || text.front() == '\n'))
        text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == '\n')) text.remove_suffix(1);
    return text;
}

/// Removes and returns the number at the start of `text`. Empty if there is none, or if it is not finite.
std::optional<double> take_number(std::string_view& text) {
    text = trimmed(text);
    const std::size_t digit = !text.empty() && text[0] == '-' ? 1 : 0;
    const bool is_figure = text.size() > digit && ((text[digit] >= '0' && text[digit] <= '9') || text[digit] == '.');
    if (!is_figure) return std::nullopt;  // from_chars would accept "inf" and "nan"
    double value = 0.0;
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (failure != std::errc{} || !std::isfinite(value)) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return value;
}

std::string lower_case(std::string_view text) {
    std::string lower(text);
    for (char& c : lower)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return lower;
}

/// Parses a unit with at least one foreign part: "in", "lbf/in", "rev/min".
std::optional<Unit> parse_foreign_unit(std::string_view text) { return parse_unit(text, foreign_unit_symbols); }

/// Returns a value of the file, shortened because it may be long, and without control characters.
std::string quoted(std::string_view text) { return "`" + excerpt(text, 40) + "`"; }

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

/// Returns "a length"; empty for a dimension without a short name.
std::string name_of(const kerf_dimension& d) {
    const std::array<std::pair<kerf_dimension, const char*>, 11> names{{{dimension::none, "a plain number"},
                                                                        {dimension::length, "a length"},
                                                                        {dimension::angle, "an angle"},
                                                                        {dimension::time, "a time"},
                                                                        {dimension::mass, "a mass"},
                                                                        {dimension::speed, "a speed"},
                                                                        {dimension::frequency, "a frequency"},
                                                                        {dimension::force, "a force"},
                                                                        {dimension::torque, "a torque"},
                                                                        {dimension::pressure, "a pressure"},
                                                                        {dimension::volume, "a volume"}}};
    for (const auto& [known, name] : names)
        if (known == d) return name;
    return d == dimension::density ? "a density" : "";
}

std::string what_is_needed(const QuantityNeed& need) {
    if (need.unit.empty()) return "a plain number";
    const std::string name = name_of(need.dimension);
    return (name.empty() || need.dimension == dimension::none ? "a number" : name) + " in " + need.unit;
}

/// Returns a valid value for an example in a message.
double example_of(const QuantityNeed& need) {
    const std::optional<Unit> unit = parse_unit(need.unit);
    return std::clamp(unit ? unit->factor : 1.0, need.min, need.max);
}

bool in_range(double value, const QuantityNeed& need) {
    // 0.1 mm must not fail against a limit of 0.1e-3 m because of the last bit.
    const double slack = 1e-12 * std::max(std::abs(need.min), std::abs(need.max));
    return value >= need.min - slack && value <= need.max + slack;
}

// ---- reading

/// Returns the SI factor of a unit, if it has the needed dimension. An empty text is the unit of a plain number.
std::optional<double> factor_of(std::string_view unit_text, const QuantityNeed& need) {
    if (unit_text.empty()) return need.unit.empty() ? std::optional(1.0) : std::nullopt;
    const std::optional<Unit> unit = parse_unit(unit_text);
    return unit && unit->dimension == need.dimension ? std::optional(unit->factor) : std::nullopt;
}

/// Removes and returns the number, or the fraction of two numbers, at the start of `text`.
std::optional<double> take_fraction(std::string_view& text) {
    std::optional<double> value = take_number(text);
    if (!value || !trimmed(text).starts_with('/')) return value;
    std::string_view rest = trimmed(text).substr(1);
    const std::optional<double> below = take_number(rest);
    if (!below) return value;  // "1/min" is a number and its unit
    text = rest;
    return *below != 0.0 ? std::optional(*value / *below) : std::nullopt;
}

/// Returns a value in SI, in range or not. Empty if the text is not one value with its unit.
std::optional<double> value_of(std::string_view text, const QuantityNeed& need) {
    std::string_view rest = trimmed(text);
    const std::optional<double> number = need.unit.empty() ? take_fraction(rest) : take_number(rest);
    const std::optional<double> factor = number ? factor_of(trimmed(rest), need) : std::nullopt;
    if (!factor || !std::isfinite(*number * *factor)) return std::nullopt;
    return *number * *factor;
}

bool is_readable(std::string_view text, const QuantityNeed& need) {
    const std::optional<double> value = value_of(text, need);
    return value && in_range(*value, need);
}

/// Removes and returns three numbers, separated by blanks, at the start of `text`.
std::optional<std::array<double, 3>> take_three(std::string_view& text) {
    std::array<double, 3> number{};
    for (double& component : number) {
        const std::optional<double> taken = take_number(text);
        const bool is_apart = &component == &number.back() || trimmed(text).size() < text.size();
        if (!taken || !is_apart || text.starts_with(',')) return std::nullopt;
        component = *taken;
    }
    return number;
}

std::optional<Vec3> vector_of(std::string_view text, const QuantityNeed& need) {
    std::string_view rest = trimmed(text);
    const auto number = take_three(rest);
    const std::optional<double> factor = number ? factor_of(trimmed(rest), need) : std::nullopt;
    if (!factor) return std::nullopt;
    const Vec3 value{(*number)[0] * *factor, (*number)[1] * *factor, (*number)[2] * *factor};
    return std::isfinite(value.x) && std::isfinite(value.y) && std::isfinite(value.z) ? std::optional(value)
                                                                                      : std::nullopt;
}

bool is_readable_vector(std::string_view text, const QuantityNeed& need) {
    const std::optional<Vec3> v = vector_of(text, need);
    return v && in_range(v->x, need) && in_range(v->y, need) && in_range(v->z, need);
}

// ---- problems

/// A text of one value or three that could not be read, with its requirements.
struct UnreadableText {
    std::string_view text;
    const std::string& name;
    const QuantityNeed& need;
    bool is_vector = false;

    [[nodiscard]] bool reads(std::string_view other) const {
        return is_vector ? is_readable_vector(other, need) : is_readable(other, need);
    }
    [[nodiscard]] std::string got() const { return "got " + quoted(text) + ", expected " + expected(); }
    [[nodiscard]] std::string expected() const {
        if (!is_vector) return what_is_needed(need);
        return need.unit.empty() ? "three numbers, as in `0 0 1`"
                                 : "three numbers and one unit, as in `" + with_unit("1 2 3", need.unit) + "`";
    }
    [[nodiscard]] std::string advice() const {
        if (is_vector) return " Write x, y and z.";
        return need.unit.empty() ? " Write a plain number."
                                 : " Write one, as in `" + quantity_text(example_of(need), need.unit) + "`.";
    }
};

/// Returns the problem with `write` as its correction, if that is readable; else with `advice`.
QuantityProblem problem_of(Code code, const UnreadableText& wrong, std::string message, std::string write,
                           const std::string& advice) {
    if (!wrong.reads(write)) write.clear();
    if (write.empty()) message += advice;
    return {code, std::move(message), std::move(write)};
}

/// Returns "1 000 rpm", "12'345.6", "1,000,000" and "1.234,5 mm" without the separators of thousands; empty for others.
std::string without_thousands(std::string_view text) {
    const auto is_digit = [&](std::size_t i) { return i < text.size() && text[i] >= '0' && text[i] <= '9'; };
    std::size_t at = text.starts_with('-') ? 1 : 0;
    std::string joined(text.substr(0, at));
    const std::size_t begin = at;
    while (is_digit(at)) joined += text[at++];
    if (at == begin || at - begin > 3 || at >= text.size()) return {};
    const char sign = text[at];
    if (std::string_view(" '_,.").find(sign) == std::string_view::npos) return {};
    std::size_t groups = 0;
    while (at < text.size() && text[at] == sign && is_digit(at + 1) && is_digit(at + 2) && is_digit(at + 3) &&
           !is_digit(at + 4)) {
        joined += text.substr(at + 1, 3);
        at += 4;
        ++groups;
    }
    const char point = at < text.size() ? text[at] : '\0';
    const bool has_fraction = (point == '.' || point == ',') && point != sign && is_digit(at + 1);
    if (groups == 0 || (sign == ',' && groups == 1 && !has_fraction) || (sign == '.' && !has_fraction && groups == 1))
        return {};
    if (has_fraction) {
        joined += '.';
        ++at;
    }
    return joined.append(text.substr(at));
}

QuantityProblem not_a_number(const UnreadableText& wrong) {
    // "3,2 mm": the decimal comma is common in many countries.
    std::string with_point(wrong.text.substr(0, 40));
    std::replace(with_point.begin(), with_point.end(), ',', '.');
    std::string_view rest = with_point;
    const std::size_t comma = with_point.find('.');
    if (!wrong.is_vector && std::count(wrong.text.begin(), wrong.text.end(), ',') == 1 && take_number(rest) &&
        (wrong.need.unit.empty() ? trimmed(rest).empty() : parse_unit(rest).has_value()))
        return decimal_comma(wrong.name, with_point.substr(0, comma), with_point.substr(comma + 1));
    const std::string without_plus(wrong.text.starts_with('+') ? wrong.text.substr(1) : "");
    return problem_of(Code::not_a_number, wrong, wrong.name + " is not a number: " + wrong.got() + ".", without_plus,
                      wrong.advice());
}

/// Returns the problem of a unit, `unit_text`, that does not have the needed dimension.
QuantityProblem unfit_unit(std::string_view unit_text, const std::vector<double>& numbers,
                           const UnreadableText& wrong) {
    const QuantityNeed& need = wrong.need;
    if (unit_text.empty()) {
        // For a percentage, a plain 0.2 may mean 20 % or 0.2 %.
        const bool may_be_fraction = need.unit == "%" && std::abs(numbers.front()) <= 1.0;
        return problem_of(Code::missing_unit, wrong, wrong.name + " has no unit: " + wrong.got() + ".",
                          may_be_fraction ? "" : with_unit(std::string(wrong.text), need.unit),
                          " Write the unit behind the number.");
    }
    std::optional<Unit> unit = parse_unit(unit_text);
    const bool is_foreign = !unit;
    if (is_foreign) unit = parse_foreign_unit(unit_text);
    if (!unit) {
        const bool is_case = parse_unit(lower_case(unit_text)).has_value();
        return {Code::unknown_unit,
                wrong.name + " has an unknown unit " + quoted(unit_text) + ": " + wrong.got() + "." +
                    (is_case ? " Capital letters count in units." : "") +
                    (need.unit.empty() ? " Write a plain number." : " Write the value in " + need.unit + "."),
                {}};
    }
    if (!(unit->dimension == need.dimension)) {
        const bool may_be_energy = unit->dimension == dimension::torque;  // the unit of both
        const std::string kind = may_be_energy ? "an energy or a torque" : name_of(unit->dimension);
        return {Code::wrong_dimension,
                wrong.name + (kind.empty() ? " is of another kind: " : " is " + kind + ": ") + wrong.got() +
                    (need.unit.empty() ? ". Write a plain number." : ". Write the value in " + need.unit + "."),
                {}};
    }
    std::string write;
    const std::optional<Unit> own = parse_unit(need.unit);
    for (const double number : numbers)
        write += (write.empty() ? "" : " ") + number_text(number * unit->factor / (own ? own->factor : 1.0));
    return problem_of(
        Code::unknown_unit, wrong,
        wrong.name + " is in " + quoted(unit_text) + ", a unit that Kerf does not read: " + wrong.got() + ".",
        with_unit(write, need.unit),
        wrong.is_vector ? wrong.advice()
                        : " Write a value of " + quantity_text(need.min, need.unit) + " … " +
                              quantity_text(need.max, need.unit) + ".");
}

/// The probably intended value of a value out of range, and the kind of mistake.
struct LikelyMistake {
    double value = 0.0;
    std::string unit;
    const char* what = nullptr;
};

/// Returns a number as the fraction that was likely meant, "1/200" of 200; empty if that does not fit. Only a plain
/// number whose range lies mostly below 1 is written as a fraction.
std::string meant_fraction(double value, const QuantityNeed& need) {
    const bool is_fraction = need.unit.empty() && need.min > 0.0 && need.min * need.max < 1.0;
    if (!is_fraction || value <= std::max(1.0, need.max) || 1.0 / value < need.min) return {};
    return "1/" + number_text(value);
}

std::optional<LikelyMistake> likely_slip(double value, const std::string& unit, const QuantityNeed& need) {
    const auto fits = [&](double v) { return v >= need.min && v <= need.max; };
    if (fits(-value)) return LikelyMistake{-value, unit, "the sign"};
    const std::optional<Unit> written = parse_unit(unit), own = parse_unit(need.unit);
    if (written && own && unit != need.unit && written->factor != own->factor)
        if (const double other = value / written->factor * own->factor; fits(other))
            return LikelyMistake{other, need.unit, "the unit"};
    // A value just beyond a limit is no misplaced decimal point.
    const double farthest = std::max(std::abs(need.min), std::abs(need.max)), size = std::abs(value);
    const bool is_large = size > 1.5 * farthest, is_small = value > 0.0 && value < need.min / 1.5;
    for (double shift = 10.0; shift < 1001.0; shift *= 10.0) {
        if (is_large && fits(value / shift)) return LikelyMistake{value / shift, unit, "the decimal point"};
        if (is_small && fits(value * shift)) return LikelyMistake{value * shift, unit, "the decimal point"};
    }
    return std::nullopt;
}

/// Returns whether a value is short enough to read at a glance. A limit of one second is not, in minutes.
bool is_short(double value, const std::string& unit) {
    const std::string text = quantity_text(value, unit);
    return std::count_if(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; }) <= 7;
}

/// Returns the problem of a value out of range. The range is in the unit of the value, or in the unit of `need` if
/// `unit` is empty or a limit has too many digits in it.
QuantityProblem out_of_range(double value, std::string_view unit, const std::string& name, const QuantityNeed& need) {
    const std::string written_in(unit.empty() ? std::string_view(need.unit) : unit);
    const std::string shown_in =
        is_short(need.min, written_in) && is_short(need.max, written_in) ? written_in : need.unit;
    std::string message = name + " is out of range: got " + quantity_text(value, written_in) + ", expected " +
                          quantity_text(need.min, shown_in) + " … " + quantity_text(need.max, shown_in) + ".";
    if (const std::string fraction = meant_fraction(value, need); !fraction.empty() && is_readable(fraction, need))
        return {Code::out_of_range, message + " Is it the divisor of a fraction?", fraction};
    const std::optional<LikelyMistake> slip = likely_slip(value, written_in, need);
    // The value in another unit may round to just outside the range.
    const std::string write = slip ? quantity_text(slip->value, slip->unit) : "";
    if (!slip || !is_readable(write, need)) return {Code::out_of_range, message + " Write a value in this range.", {}};
    return {Code::out_of_range, message + " Did " + slip->what + " slip?", write};
}

/// Returns a text with commas between its numbers in the readable form; empty if commas are not the problem.
std::string without_commas(std::string_view text, const QuantityNeed& need) {
    std::string meant;
    for (std::size_t i = 0; i < std::min<std::size_t>(text.size(), 80); ++i) {
        const bool is_between = text[i] == ',' && i + 1 < text.size() && text[i + 1] == ' ';
        if (!is_between) meant += text[i] == ',' ? '.' : text[i];
    }
    const bool has_comma = text.find(',') != std::string_view::npos;
    return has_comma && vector_of(meant, need) ? meant : std::string();
}

QuantityProblem not_three_numbers(const UnreadableText& wrong) {
    return problem_of(Code::not_three_numbers, wrong, wrong.name + " is not three numbers: " + wrong.got() + ".",
                      without_commas(wrong.text, wrong.need), " Write x, y and z.");
}

/// Returns the seconds of `2:30` and `1:02:30`, the time as a clock shows it; empty for other texts.
std::optional<double> clock_time(std::string_view text) {
    double seconds = 0.0;
    int parts = 0;
    for (std::size_t begin = 0; begin <= text.size(); ++parts) {
        const std::size_t end = std::min(text.find(':', begin), text.size());
        const std::string_view part = text.substr(begin, end - begin);
        const bool is_part = !part.empty() && part.size() <= 4 && (parts == 0 || part.size() == 2) &&
                             part.find_first_not_of("0123456789") == std::string_view::npos;
        if (!is_part) return std::nullopt;
        double value = 0.0;
        for (const char c : part) value = 10.0 * value + (c - '0');
        seconds = 60.0 * seconds + value;
        begin = end + 1;
    }
    return parts == 2 || parts == 3 ? std::optional(seconds) : std::nullopt;
}

/// Returns the problem of a single value that cannot be read.
QuantityProblem problem_of_value(const UnreadableText& wrong) {
    std::string_view rest = wrong.text;
    const std::optional<double> number = take_fraction(rest);
    if (!number) return not_a_number(wrong);
    if (const auto seconds = wrong.need.dimension == dimension::time ? clock_time(wrong.text) : std::nullopt)
        return problem_of(Code::not_a_number, wrong, wrong.name + " is written like a clock: " + wrong.got() + ".",
                          with_unit(number_text(*seconds), "s"), wrong.advice());
    const bool is_fraction = wrong.text.substr(0, wrong.text.size() - rest.size()).find('/') != std::string_view::npos;
    if (const std::string joined = without_thousands(wrong.text); !joined.empty())
        return problem_of(Code::not_a_number, wrong,
                          wrong.name + " has signs between its thousands: " + wrong.got() + " with digits alone.",
                          wrong.reads(joined) ? joined : with_unit(joined, wrong.need.unit), wrong.advice());
    if (rest.starts_with(',')) return not_a_number(wrong);
    rest = trimmed(rest);
    const std::size_t sign = rest.starts_with('-') ? 1 : 0;
    const bool is_more =
        rest.size() > sign && ((rest[sign] >= '0' && rest[sign] <= '9') || rest[sign] == '.') && !parse_unit(rest);
    if (is_more)
        return {
            Code::not_a_number, wrong.name + " is more than one number: " + wrong.got() + ". Write one number.", {}};
    if (const std::optional<double> factor = factor_of(rest, wrong.need)) {
        if (!std::isfinite(*number * *factor)) return not_a_number(wrong);
        if (is_fraction && !wrong.need.unit.empty())
            return problem_of(Code::not_a_number, wrong,
                              wrong.name + " is a fraction: " + wrong.got() + " with a decimal point.",
                              with_unit(number_text(*number), rest), wrong.advice());
        return out_of_range(*number * *factor, rest, wrong.name, wrong.need);
    }
    return unfit_unit(rest, {*number}, wrong);
}

/// Returns the problem of three numbers that cannot be read.
QuantityProblem problem_of_vector(const UnreadableText& wrong) {
    std::string_view rest = wrong.text;
    const auto numbers = take_three(rest);
    if (!numbers) return not_three_numbers(wrong);
    rest = trimmed(rest);
    if (std::string_view more = rest; take_number(more) && !parse_unit(rest))
        return {Code::not_three_numbers,
                wrong.name + " is more than three numbers: " + wrong.got() + ". Remove the rest.",
                {}};
    const std::optional<double> factor = factor_of(rest, wrong.need);
    if (!factor) return unfit_unit(rest, {numbers->begin(), numbers->end()}, wrong);
    for (const double component : *numbers)
        if (!in_range(component * *factor, wrong.need))
            return out_of_range(component * *factor, rest, wrong.name, wrong.need);
    return not_three_numbers(wrong);
}

/// Returns the problem of a text, and names a look-alike character in it if there is one. That character may be the
/// only problem.
QuantityProblem explain(const UnreadableText& wrong) {
    const auto problem = [&](const UnreadableText& of) {
        return of.is_vector ? problem_of_vector(of) : problem_of_value(of);
    };
    const std::optional<LookAlike> look_alike = find_look_alike(wrong.text);
    if (!look_alike) return problem(wrong);
    const std::string straight = straightened(wrong.text);
    const UnreadableText straight_wrong{trimmed(straight), wrong.name, wrong.need, wrong.is_vector};
    const bool is_all = wrong.reads(straight);
    QuantityProblem found = is_all ? QuantityProblem{Code::not_a_number, {}, {}} : problem(straight_wrong);
    const std::string message = wrong.name + " cannot be read: " + wrong.got() + "; " + about(*look_alike) + ".";
    if (is_all) return {Code::not_a_number, message, std::string(trimmed(straight))};
    if (!found.write.empty()) return {found.code, message, found.write};
    return {found.code, message + wrong.advice(), {}};
}

constexpr const char* number_pattern = R"(-?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][+-]?[0-9]+)?)";

std::string power_pattern(int power) {
    if (power == 1) return "";
    const std::string figure = std::to_string(power);
    const std::string raised = power == 2 ? "|²" : power == 3 ? "|³" : "";
    return "(\\^?" + figure + raised + ")";
}

/// Returns a pattern of the units of this dimension, and of all composed units.
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
    const std::string message =
        name + " has a decimal comma: got " + quoted(before + "," + behind) + ", expected a decimal point.";
    const std::string with_point = before + "." + behind;
    const std::size_t digits = std::min(behind.find_first_not_of("0123456789"), behind.size());
    const std::string whole = before.starts_with('-') ? before.substr(1) : before;
    const bool may_be_thousands = digits == 3 && !whole.empty() && whole.size() <= 3 && whole[0] != '0';
    if (!may_be_thousands) return {Code::not_a_number, message, with_point};
    return {
        Code::not_a_number, message + " Write `" + before + behind + "` for thousands, or `" + with_point + "`.", {}};
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
    const std::optional<double> value = value_of(text, need);
    if (value && in_range(*value, need)) return {value, {}};
    return {std::nullopt, explain({text, name, need, false})};
}

Parsed<Vec3> parse_vector(std::string_view text, const std::string& name, const QuantityNeed& need) {
    text = trimmed(text);
    if (is_readable_vector(text, need)) return {vector_of(text, need), {}};
    return {std::nullopt, explain({text, name, need, true})};
}

}  // namespace kerf::text
