// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

#include "documents/yaml/map_shape.h"
#include "kerf/units.hpp"

/// Values of the rows of documents/shapes/shapes.h. The ranges of quantities are the plausible ones: any other value is
/// a slip of the pen or has a wrong unit.
namespace kerf::documents::shapes {

using namespace literals;
using Kind = ValueShape::Kind;
using enum Presence;

inline ValueShape of_kind(Kind kind) { return {.kind = kind}; }
inline ValueOf<std::string> text() { return {{.kind = Kind::text}}; }
inline ValueOf<std::string> words() { return {{.kind = Kind::words}}; }
inline ValueOf<std::string> id() { return {{.kind = Kind::id}}; }
inline ValueOf<std::string> version() { return {{.kind = Kind::version}}; }
inline ValueOf<std::string> path() { return {{.kind = Kind::path}}; }
inline ValueOf<bool> yes_no() { return {{.kind = Kind::yes_no}}; }
inline ValueOf<std::string> word(std::vector<std::string> words) {
    return {{.kind = Kind::word, .words = std::move(words)}};
}
inline ValueShape word_or(std::vector<std::string> words, const Shape& shape) {
    return {.kind = Kind::word, .words = std::move(words), .shape = &shape};
}
template <class V, class Words = std::initializer_list<std::pair<const char*, V>>>
ChoiceOf<V> choice(const Words& words) {
    ChoiceOf<V> shape{{.kind = Kind::word}, {}};
    for (const auto& [word, meaning] : words) {
        shape.words.push_back(word);
        shape.meanings.push_back(meaning);
    }
    return shape;
}

inline ValueShape path_or(const Shape& shape) { return {.kind = Kind::path, .shape = &shape}; }

inline ValueShape map(const Shape& shape) { return {.kind = Kind::map, .shape = &shape}; }
template <class U>
MapOf<U> map(const MapShape<U>& table, const char* name = "") {
    return {{.kind = Kind::map, .shape = &table}, &table, name};
}
/// A map whose keys fill the object of the map around it.
template <class T>
PartOf<T> part_of(const MapShape<T>& table, const char* name = "") {
    return {map(table, name)};
}
inline ValueShape map_or(const Shape& shape, const Shape& other) {
    return {.kind = Kind::map, .shape = &shape, .other = &other};
}
inline ValueShape list(ValueShape item) { return {.kind = Kind::list, .item = {std::move(item)}}; }
inline ValueOf<std::vector<std::string>> ids() { return {list(id())}; }
inline ValueShape named(ValueShape item) { return {.kind = Kind::named, .item = {std::move(item)}}; }

inline ValueOf<double> quantity(kerf_dimension dimension, const char* unit, double min, double max) {
    return {{.kind = Kind::quantity, .need = {dimension, unit, min, max}}};
}
inline ValueOf<double> number(double min, double max) { return quantity(dimension::none, "", min, max); }
inline ValueOf<double> length(double min, double max) { return quantity(dimension::length, "mm", min, max); }
inline ValueOf<double> angle(double min, double max) { return quantity(dimension::angle, "deg", min, max); }
inline ValueOf<double> speed() { return quantity(dimension::speed, "mm/s", 0.01_mm_per_s, 500.0_mm_per_s); }
inline ValueOf<double> turn_speed() { return quantity(dimension::turn_speed, "deg/s", 1.0_deg, 50.0_deg); }
inline ValueOf<double> depth() { return length(-300.0_mm, 300.0_mm); }
inline ValueOf<double> extent() { return length(0.1_mm, 2.0_m); }
inline ValueOf<double> tolerance() { return length(0.0_mm, 20.0_mm); }
inline ValueOf<Vec3> vector(kerf_dimension dimension, const char* unit, double min, double max) {
    return {{.kind = Kind::vector, .need = {dimension, unit, min, max}}};
}
inline ValueOf<Vec3> position() { return vector(dimension::length, "mm", -2.0_m, 2.0_m); }
inline DirectionShape direction() { return {vector(dimension::none, "", -1.0, 1.0)}; }

inline constexpr const char* api_version_help = "The version of the format.";

}  // namespace kerf::documents::shapes
