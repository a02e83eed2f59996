// SPDX-License-Identifier: Apache-2.0
#include "documents/made/make_bone.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "documents/made/anatomy_text.h"
#include "documents/made/normal.h"
#include "documents/read_anatomy.h"
#include "kerf/units.hpp"

namespace kerf::documents {
namespace {

using Sex = MakeRequest::Sex;

/// Returns a value in the unit that messages use, with digits that suit it.
std::string shown(double value, const Dimension& dimension) {
    const double in_unit = dimension.unit == "deg"     ? value * 180.0 / std::numbers::pi
                           : dimension.unit == "mm"    ? value * 1e3
                           : dimension.unit == "g/cm3" ? value * 1e-3
                                                       : value;
    return with_decimals(in_unit, dimension.unit == "g/cm3" ? 3 : 2);
}

std::string padded(std::string text, std::size_t width) {
    text.resize(std::max(width, text.size() + 1), ' ');
    return text;
}

std::string lower(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

std::string person_text(const MakeRequest& request) {
    std::string text = request.sex == Sex::female ? "a woman" : request.sex == Sex::male ? "a man" : "adults";
    if (request.age) text += ", " + with_decimals(*request.age, 0) + " years old";
    if (request.stature) text += ", " + with_decimals(100.0 * *request.stature, 0) + " cm tall";
    if (request.is_osteoporotic) text += ", with osteoporosis";
    return text;
}

std::string title_of(const MakeRequest& request) {
    std::string text = bone_kind(request.kind).title(request) + " of " + person_text(request);
    if (request.seed)
        text += ", number " + std::to_string(*request.seed);
    else if (!request.stature && request.fixed.empty())
        text += ", with mean dimensions";
    return text;
}

/// Returns an id that names what was given.
std::string name_of(const MakeRequest& request) {
    std::string name = request.kind;
    if (!request.level.empty()) name += "-" + lower(request.level);
    if (request.sex != Sex::unsaid) name += request.sex == Sex::female ? "-f" : "-m";
    if (request.stature) name += "-" + with_decimals(100.0 * *request.stature, 0) + "cm";
    if (request.age) name += "-age" + with_decimals(*request.age, 0);
    if (request.is_osteoporotic) name += "-osteoporosis";
    if (!request.fixed.empty()) name += "-set";
    return request.seed ? name + "-seed-" + std::to_string(*request.seed) : name;
}

/// Writes the whole document. The measures are those of the bone that it describes.
std::string document_of(const MadeBone& bone, const std::string& body) {
    std::string text = "# For training and research; not for diagnosis, planning or deciding treatment\n"
                       "# SPDX-License-Identifier: Apache-2.0\n#\n# " +
                       bone.title + ".\n" + wrapped(bone_kind(bone.request.kind).frame, "# ") + "#\n" +
                       table_of_dimensions(bone, "#   ");
    text += "apiVersion: kerf/v1\nkind: Anatomy\nmetadata:\n  id: " + bone.name + "\n" +
            folded("title", bone.title, 2) + "\n";
    return text + body;
}

/// Returns whether a dimension of the bone is far from the requested one.
bool differs(const Dimension& dimension, double requested, double measured) {
    using namespace literals;
    return std::abs(measured - requested) > (dimension.unit == "deg" ? 4.0_deg : 1.5_mm);
}

}  // namespace

Population population_of(MakeRequest& request) {
    if (request.seed && request.sex == Sex::unsaid)
        request.sex = NormalSource(*request.seed).uniform("sex", 0) < 0.5 ? Sex::female : Sex::male;
    return bone_kind(request.kind).population(request);
}

MadeBone make_bone(const MakeRequest& request) {
    MadeBone bone;
    bone.request = request;
    bone.population = population_of(bone.request);
    bone.name = name_of(request);
    bone.title = title_of(bone.request);
    bone.drawn = draw_bone(bone.population, bone.request);
    if (!bone.drawn.contradiction.empty()) return bone;
    const BoneKind& kind = bone_kind(request.kind);
    const std::string body = kind.text(bone.request, bone.drawn.values);
    text::Diagnostics none;
    const auto anatomy = read_anatomy_text(bone.name, document_of(bone, body)).take(none);
    if (anatomy) bone.measured = kind.measured(*anatomy);
    bone.text = document_of(bone, body);
    return bone;
}

std::string table_of_dimensions(const MadeBone& bone, const std::string& margin) {
    bool has_different = false;
    std::string text = margin + padded("dimension", 33) + padded("requested", 11) + padded("measured", 10) + "source\n";
    for (const Dimension& dimension : bone.population.dimensions) {
        const auto found = std::find_if(bone.measured.begin(), bone.measured.end(),
                                        [&](const MeasuredDimension& m) { return m.name == dimension.name; });
        const bool is_different =
            found != bone.measured.end() && differs(dimension, bone.drawn.values[dimension.name], found->value);
        has_different = has_different || is_different;
        text += margin + padded(dimension.name + " [" + dimension.unit + "]", 33) +
                padded(shown(bone.drawn.values[dimension.name], dimension), 11) +
                padded(found != bone.measured.end() ? shown(found->value, dimension) + (is_different ? " !" : "") : "",
                       10) +
                dimension.source + " [" + word_for(dimension.evidence) + "]\n";
    }
    if (has_different)
        text +=
            margin +
            "! More than 1.5 mm or 4 deg from the request: neighbouring parts of this bone overlap there, or its\n" +
            margin + "  measure is misled by them.\n";
    return text;
}

std::string described_dimensions(const MakeRequest& request) {
    MakeRequest of = request;
    const Population population = population_of(of);
    std::string text;
    for (const Dimension& d : population.dimensions) {
        text += "    " + padded(d.name, 28) + padded(shown(d.mean, d) + " ± " + shown(d.sd, d) + " " + d.unit, 22) +
                "drawn from " + shown(d.min_drawn, d) + " to " + shown(d.max_drawn, d) + ", set from " +
                shown(d.min_set, d) + " to " + shown(d.max_set, d) + " " + d.unit + "\n        " + d.help +
                "\n        source: " + d.source + " [" + word_for(d.evidence) + "]\n";
    }
    return text;
}

}  // namespace kerf::documents
