// SPDX-License-Identifier: Apache-2.0
#include "documents/made/anatomy_text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include "kerf/assert.hpp"

namespace kerf::documents {
namespace {

constexpr std::size_t line_length = 120;

std::string spaces(int count) { return std::string(static_cast<std::size_t>(count), ' '); }

std::string sections_text(const WrittenLoft& loft, int indent) {
    std::string text = spaces(indent) + "up: " + vector_text(loft.up) + "\n";
    if (loft.rim > 0.0) text += spaces(indent) + "rim: " + rounded_text(loft.rim) + " mm\n";
    text += spaces(indent) + "sections:\n";
    for (const WrittenSection& section : loft.sections) {
        text += spaces(indent + 2) + "- {at: " + vector_text(section.at) +
                " mm, width: " + rounded_text(section.width) + " mm, height: " + rounded_text(section.height) + " mm";
        if (section.exponent != 2.0) text += ", exponent: " + rounded_text(section.exponent);
        if (section.taper != 0.0) text += ", taper: " + rounded_text(section.taper);
        if (section.turn != 0.0) text += ", turn: " + rounded_text(section.turn) + " deg";
        text += "}\n";
    }
    return text;
}

/// Whether YAML would read a plain text as something else than a text.
bool needs_quotes(const std::string& text) {
    return text.find(": ") != std::string::npos || text.find(" #") != std::string::npos;
}

}  // namespace

std::string with_decimals(double value, std::size_t digits) {
    KERF_ASSERT(std::abs(value) < 1e12, "write finite numbers only");
    double scale = 1.0;
    for (std::size_t i = 0; i < digits; ++i) scale *= 10.0;
    const long long scaled = std::llround(value * scale), whole = static_cast<long long>(scale);
    std::string part = digits == 0 ? "" : std::to_string(std::llabs(scaled) % whole);
    part.insert(0, digits - part.size(), '0');
    while (!part.empty() && part.back() == '0') part.pop_back();
    return (scaled < 0 ? "-" : "") + std::to_string(std::llabs(scaled) / whole) + (part.empty() ? "" : "." + part);
}

std::string rounded_text(double value) { return with_decimals(value, 2); }

std::string vector_text(Vec3 v) { return rounded_text(v.x) + " " + rounded_text(v.y) + " " + rounded_text(v.z); }

std::string direction_text(Vec3 v) {
    return with_decimals(v.x, 4) + " " + with_decimals(v.y, 4) + " " + with_decimals(v.z, 4);
}

std::string wrapped(const std::string& text, const std::string& margin) {
    std::string lines, line = margin;
    std::size_t at = 0;
    bool is_first = true;
    while (at < text.size()) {
        const std::size_t end = std::min(text.find(' ', at), text.size());
        const std::string word = text.substr(at, end - at);
        if (!is_first && line.size() + 1 + word.size() > line_length) {
            lines += line + "\n";
            line = margin;
            is_first = true;
        }
        line += (is_first ? "" : " ") + word;
        is_first = false;
        at = end + 1;
    }
    return lines + line + "\n";
}

std::string folded(const std::string& key, const std::string& text, int indent) {
    const std::string head = spaces(indent) + key + ": ";
    if (head.size() + text.size() + 2 <= line_length)
        return head + (needs_quotes(text) ? "\"" + text + "\"" : text) + "\n";
    return head + ">-\n" + wrapped(text, spaces(indent + 2));
}

namespace {

/// How a part joins the parts before it, and its source.
std::string joint_text(const WrittenJoint& joint) {
    std::string text;
    if (joint.subtract) text += "      subtract: true\n";
    if (joint.blend > 0.0) text += "      blend: " + rounded_text(joint.blend) + " mm\n";
    if (joint.mirror) text += "      mirror: true\n";
    if (!joint.source.empty()) text += folded("source", joint.source, 6);
    return text;
}

std::string between(const char* kind, Vec3 from, Vec3 to) {
    return std::string(kind) + ": {from: " + vector_text(from) + " mm, to: " + vector_text(to) + " mm, ";
}

}  // namespace

std::string loft_part(const std::string& id, const WrittenLoft& loft, const WrittenJoint& joint) {
    return "    - id: " + id + "\n      loft:\n" + sections_text(loft, 8) + joint_text(joint);
}

std::string tube_text(Vec3 from, Vec3 to, double radius) {
    return between("tube", from, to) + "radius: " + rounded_text(radius) + " mm}";
}

std::string elliptic_tube_text(Vec3 from, Vec3 to, double width, double height, const std::string& up) {
    return between("elliptic_tube", from, to) + "width: " + rounded_text(width) +
           " mm, height: " + rounded_text(height) + " mm, up: " + up + "}";
}

std::string sphere_text(Vec3 centre, double radius) {
    return "sphere: {centre: " + vector_text(centre) + " mm, radius: " + rounded_text(radius) + " mm}";
}

std::string solid_part(const char* id, const std::string& solid, const WrittenJoint& joint) {
    return std::string("    - id: ") + id + "\n      " + solid + "\n" + joint_text(joint);
}

std::string axis_text(const char* id, Vec3 from, Vec3 to, double tolerance) {
    return std::string("    ") + id + ": {from: " + vector_text(from) + " mm, to: " + vector_text(to) +
           " mm, tolerance: " + rounded_text(tolerance) + " mm}\n";
}

std::string loft_item(const WrittenLoft& loft, int indent) {
    return spaces(indent) + "- loft:\n" + sections_text(loft, indent + 4);
}

}  // namespace kerf::documents
