// SPDX-License-Identifier: Apache-2.0
#include "bone/image/segments.h"

#include <charconv>
#include <cstddef>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "bone/image/header_checks.h"
#include "bone/image/header_fields.h"
#include "text/printable.h"

namespace kerf::bone::header {
namespace {

constexpr std::size_t max_segments = 1000, max_listed = 12;
constexpr const char* again = "Export the segmentation again from 3D Slicer 4.11 or later.";

/// The keys of one segment.
struct Written {
    std::optional<std::string> id, name;
    std::optional<int> label, layer;
};

int number_in(const std::string& key, const std::string& text) {
    const long long value = whole_of(text, key);
    if (value < 0 || value > 65535)
        refuse("E0622", "`" + key + "` is " + std::to_string(value) + ", must be 0 … 65535.", again);
    return static_cast<int>(value);
}

/// Returns the segments by number. Numbers may have gaps.
std::map<int, Written> written_in(const Remarks& remarks) {
    std::map<int, Written> segments;
    constexpr std::string_view prefix = "Segment";
    for (const auto& [key, value] : remarks) {
        if (!key.starts_with(prefix)) continue;
        int number = 0;
        const auto [end, error] = std::from_chars(key.data() + prefix.size(), key.data() + key.size(), number);
        if (error != std::errc{} || number < 0 || end == key.data() + key.size() || *end != '_') continue;
        Written& segment = segments[number];
        const std::string_view field(end + 1, static_cast<std::size_t>(key.data() + key.size() - end - 1));
        if (field == "ID") segment.id = std::string(trimmed(value));
        if (field == "Name") segment.name = std::string(trimmed(value));
        if (field == "LabelValue") segment.label = number_in(key, value);
        if (field == "Layer") segment.layer = number_in(key, value);
    }
    if (segments.size() > max_segments)
        refuse("E0622", "the segmentation has " + std::to_string(segments.size()) + " segments, at most 1000 are read.",
               "Export fewer segments.");
    return segments;
}

std::string named(const Written& segment, int number) {
    return segment.name ? "`" + text::excerpt(*segment.name) + "`" : std::to_string(number);
}

std::string names_of(const std::map<int, Written>& written) {
    std::vector<Segment> all;
    for (const auto& [number, segment] : written)
        all.push_back({segment.name.value_or("Segment" + std::to_string(number)), segment.label.value_or(0),
                       segment.layer.value_or(0)});
    std::string text;
    for (std::size_t n = 0; n < all.size() && n < max_listed; ++n)
        text += (n > 0 ? ", `" : "`") + text::excerpt(all[n].name, 40) + "`";
    if (all.size() > max_listed) text += " and " + std::to_string(all.size() - max_listed) + " more";
    return text;
}

}  // namespace

std::vector<Segment> segments_of(const Remarks& remarks, int layers) {
    const std::map<int, Written> written = written_in(remarks);
    std::size_t with_layer = 0;
    std::map<int, int> in_layer;  // number of segments in each
    for (const auto& [number, segment] : written) {
        with_layer += segment.layer.has_value();
        ++in_layer[segment.layer ? *segment.layer : layers == 1 ? 0 : number];
    }
    if (layers > 1 && with_layer > 0 && with_layer < written.size())
        refuse("E0636",
               std::to_string(written.size() - with_layer) + " of the segments " + names_of(written) +
                   " have no `Layer`, so their voxels cannot be distinguished from those of others.",
               again);

    std::vector<Segment> segments;
    for (const auto& [number, segment] : written) {
        const std::string key = "Segment" + std::to_string(number);
        if (!segment.name && !segment.id) refuse("E0622", "`" + key + "` has neither a name nor an id.", again);
        Segment one{segment.name ? *segment.name : *segment.id, 1, segment.layer.value_or(layers == 1 ? 0 : number)};
        if (one.layer >= layers)
            refuse("E0622",
                   "the segment " + named(segment, number) + " lies in layer " + std::to_string(one.layer) +
                       ", but the layers are 0 … " + std::to_string(layers - 1) + ".",
                   again);
        if (segment.label)
            one.label = *segment.label;
        else if (in_layer[one.layer] > 1)
            refuse("E0636",
                   "the segment " + named(segment, number) + " shares a layer with others of " + names_of(written) +
                       " and has no `LabelValue`.",
                   again);
        if (one.label == 0)
            refuse("E0622", "the segment " + named(segment, number) + " has the label 0, which is the background.",
                   again);
        segments.push_back(std::move(one));
    }
    return segments;
}

std::string name_to_write(const std::string& name) {
    constexpr std::size_t longest = 200;  // [bytes] no user types longer names
    return name.size() > longest ? text::excerpt(name) : text::yaml_word(name);
}

std::string list_of(const std::vector<Segment>& segments) {
    std::string text;
    for (std::size_t n = 0; n < segments.size() && n < max_listed; ++n)
        text += (n > 0 ? ", `" : "`") + name_to_write(segments[n].name) + "` (label " +
                std::to_string(segments[n].label) + ", layer " + std::to_string(segments[n].layer) + ")";
    if (segments.size() > max_listed) text += " and " + std::to_string(segments.size() - max_listed) + " more";
    return text;
}

}  // namespace kerf::bone::header
