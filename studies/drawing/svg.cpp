// SPDX-License-Identifier: Apache-2.0
// For training and research; not for diagnosis, planning or deciding treatment.
#include "studies/drawing/svg.h"

#include <charconv>
#include <cmath>

#include "session/report/report_data.h"

namespace kerf::drawing {

std::string text_at(double x, double y, std::string_view text, std::string_view more) {
    return "<text x=\"" + std::to_string(static_cast<int>(x)) + "\" y=\"" + std::to_string(static_cast<int>(y)) +
           "\" " + std::string(more) + ">" + session::html_escaped(text) + "</text>\n";
}

std::string px(double value) {
    char text[64];
    const auto end =
        std::to_chars(text, text + sizeof text, std::round(10.0 * value) / 10.0, std::chars_format::fixed, 1);
    return {text, end.ptr};
}

std::string csv_quoted(std::string_view field) {
    std::string text = "\"";
    for (const char c : field) text += c == '"' ? std::string("\"\"") : std::string(1, c);
    return text + "\"";
}

std::string figure(double value, int digits) {
    char text[64];
    const auto end = std::to_chars(text, text + sizeof text, std::abs(value) < 1e-12 ? 0.0 : value,
                                   std::chars_format::general, digits);
    const std::string short_form(text, end.ptr);
    // 1370 rather than 1.37e+03, as long as that is short.
    if (short_form.find("e+") == std::string::npos || !(std::abs(value) < 1e6)) return short_form;
    double rounded = 0.0;
    std::from_chars(text, end.ptr, rounded);
    const auto plain = std::to_chars(text, text + sizeof text, rounded, std::chars_format::fixed);
    return {text, plain.ptr};
}

std::string joined(const std::vector<std::string>& words, std::string_view between) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : std::string(between)) + word;
    return text;
}

}  // namespace kerf::drawing
