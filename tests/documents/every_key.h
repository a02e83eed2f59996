// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "documents/shapes/shapes.h"

/// Documents made of the examples that the shapes give: with every key there is, or with one of them left out.
namespace kerf::documents {

struct EveryKey {
    static constexpr std::size_t choices = 75;

    std::size_t choice = 0;  ///< which of keys that exclude each other
    int depth = 9;           ///< how deep maps are spelled out; below that their example stands
    std::string dropped{};   ///< "shape/key" that is left out
    std::string altered{};   ///< "shape/key" that holds
    std::string other{};     ///< this instead

    std::string document(const Shape& shape) const {
        std::string text;
        for (const KeyShape& key : shape.keys)
            if (is_written(shape, key)) text += key.name + ": " + value(shape, key, depth) + "\n";
        if (depth > 0 && chosen_of(shapes::measure) == "angle") {  // the bounds on it are angles, too
            replace_all("at_least: 2 mm", "at_least: 2 deg", text);
            replace_all("at_most: 8 mm", "at_most: 8 deg", text);
        }
        return text;
    }

private:
    static void replace_all(const std::string& what, const std::string& by, std::string& text) {
        for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
            text.replace(at, what.size(), by);
    }

    /// Which of `count` ways the document goes at its top, and in every map within.
    std::size_t way(std::size_t count, bool is_top) const { return (is_top ? choice : choice / 3) % count; }

    bool is_written(const Shape& shape, const KeyShape& key) const {
        if (shape.id + "/" + key.name == dropped) return false;
        if (&shape == &shapes::procedure && key.name == "paths" && depth < 2) return false;  // no example follows one
        if (shape.id == "loft_section" && key.name == "outline") return has_outlines();
        const bool is_of_superellipse =
            key.name == "width" || key.name == "height" || key.name == "exponent" || key.name == "taper";
        if (shape.id == "loft_section" && is_of_superellipse) return !has_outlines();
        return key.presence != Presence::one_of || chosen_of(shape) == key.name;
    }

    bool has_outlines() const { return choice / 18 % 2 == 1; }  // whichever kinds of solids are chosen

    std::string chosen_of(const Shape& shape) const {
        std::vector<std::string> names;
        for (const KeyShape& key : shape.keys)
            if (key.presence == Presence::one_of) names.push_back(key.name);
        // The two ways of an implant must not go with the two ways of the canal in its mesh.
        if (&shape == &shapes::tissue_region && chosen_of(shapes::anatomy) != "phantom") return "solids";
        if (&shape == &shapes::implant) return names[choice / 12 % names.size()];
        return names[way(names.size(), &shape == &shapes::anatomy)];
    }

    std::string map(const Shape& shape, int levels) const {
        std::string text;
        for (const KeyShape& key : shape.keys)
            if (is_written(shape, key))
                text += (text.empty() ? "" : ", ") + key.name + ": " + value(shape, key, levels);
        return "{" + text + "}";
    }

    std::string value(const Shape& shape, const KeyShape& key, int levels) const {
        if (shape.id + "/" + key.name == altered) return other;
        // What a rehearsal breaks is the limit that is there, by its zone, signal or measure, or else its quantity.
        if (&shape == &shapes::expectation && key.name == std::string_view("fail") &&
            chosen_of(shapes::limit) != "clearance")
            return chosen_of(shapes::limit) == "signal"    ? shapes::signal_bound.find("id")->example
                   : chosen_of(shapes::limit) == "measure" ? shapes::measure_bound.find("of")->example
                                                           : chosen_of(shapes::limit);
        // The last tissue has no thickness, and no density of its own where the image gives it one.
        const bool has_density = chosen_of(shapes::anatomy) == "ct" && depth > 0 && dropped != "ct/density";
        const std::string base =
            ", {id: root, solids: [{box: {centre: 0 0 0 mm, size: 44 35 28 mm}}], density: 2 g/cm3}" +  // of zones, too
            std::string(has_density ? ", {id: cancellous}" : ", {id: cancellous, density: 0.25 g/cm3}");
        const bool has_tissues = !key.value.item.empty() && key.value.item[0].shape == &shapes::tissue;
        if (key.value.kind == ValueShape::Kind::yes_no)
            return "false";  // `subtract: true` has nothing to take away from
        if (levels <= 0)
            return has_tissues ? "[{id: cortical, thickness: 1 mm, density: 1.85 g/cm3}" + base + "]" : key.example;
        if (shape.id == "loft" && key.name == "sections") {  // needs two, at different positions
            const std::string one = value(key.value, key.example, levels - 1);
            std::string other_one = one;
            replace_all("-13.4 mm", "13.4 mm", other_one);
            return one.substr(0, one.size() - 1) + ", " + other_one.substr(1);
        }
        const std::string text = value(key.value, key.example, levels - 1);
        return has_tissues ? text.substr(0, text.size() - 1) + base + "]" : text;
    }

    std::string value(const ValueShape& shape, const std::string& example, int levels) const {
        using Kind = ValueShape::Kind;
        const bool has_maps =
            shape.kind == Kind::map || (!shape.item.empty() && shape.item[0].kind != Kind::id &&
                                        shape.item[0].kind != Kind::text && shape.item[0].kind != Kind::label);
        if (shape.kind == Kind::word && shape.shape != nullptr)
            return way(2, false) == 0 ? map(*shape.shape, levels) : shape.words[0];
        if (shape.kind == Kind::path && shape.shape != nullptr)
            return choice / 3 % 2 == 0 ? example : map(*shape.shape, levels);
        if (!has_maps) return example;
        if (shape.kind == Kind::map) return map(*shape.shape, levels);
        if (shape.kind == Kind::list) {
            const Shape* another = shape.item[0].other;
            return "[" + value(shape.item[0], example, levels) + (another ? ", " + map(*another, levels) : "") + "]";
        }
        const std::string name = example.substr(1, example.find(':') - 1);
        const bool is_of_others = shape.item[0].shape == &shapes::measure && chosen_of(shapes::measure) == "difference";
        const std::string others =  // that it is the difference of
            is_of_others ? "wall: {surface_distance: {of: midline}}, planned_wall: {surface_distance: {of: midline}}, "
                         : "";
        return "{" + others + name + ": " + value(shape.item[0], example, levels) + "}";
    }
};

/// Calls `visit(shape, key)` for every key of every shape under `shape`, once.
template <class Visit>
void for_every_key(const Shape& shape, Visit&& visit) {
    std::vector<const Shape*> shapes{&shape};
    const auto add = [&](const ValueShape& value, const auto& again) -> void {
        for (const Shape* found : {value.shape, value.other})
            if (found != nullptr && std::find(shapes.begin(), shapes.end(), found) == shapes.end())
                shapes.push_back(found);
        for (const ValueShape& item : value.item) again(item, again);
    };
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const Shape& here = *shapes[i];
        for (const KeyShape& key : here.keys) {
            visit(here, key);
            add(key.value, add);
        }
    }
}

}  // namespace kerf::documents
