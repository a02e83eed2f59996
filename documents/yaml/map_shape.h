// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "documents/yaml/read_map.h"
#include "documents/yaml/shape.h"
#include "kerf/math.hpp"

/// Shapes whose rows name the members that they fill. The compiler checks that value and member have the same type.
namespace kerf::documents {

template <class T>
class MapShape;

/// A value that fills a V.
template <class V>
struct ValueOf : ValueShape {};

/// Three numbers that fill a unit vector. A vector without length is an error.
struct DirectionShape : ValueShape {};

/// One of `words`, each of which means one of `meanings`.
template <class V>
struct ChoiceOf : ValueShape {
    std::vector<V> meanings;
};

/// A map that fills a U.
template <class U>
struct MapOf : ValueShape {
    const MapShape<U>* table;
    std::string name;  ///< what messages call the map; empty: its key after the name of the map around it
};

/// A map that fills the same object as the map around it.
template <class T>
struct PartOf : MapOf<T> {};

// Each reads the value under `key`. A key that is absent or wrong gives an empty text or list and `false`. It leaves a
// number or vector as it is; but a required quantity is then the least that is allowed.
void read_value(MapReader& map, const std::string& key, const ValueOf<std::string>& shape, std::string& value);
void read_value(MapReader& map, const std::string& key, const ValueOf<std::vector<std::string>>& shape,
                std::vector<std::string>& value);
void read_value(MapReader& map, const std::string& key, const ValueOf<bool>& shape, bool& value);
void read_value(MapReader& map, const std::string& key, const ValueOf<double>& shape, double& value);
void read_value(MapReader& map, const std::string& key, const ValueOf<double>& shape, std::optional<double>& value);
void read_value(MapReader& map, const std::string& key, const ValueOf<Vec3>& shape, Vec3& value);
void read_value(MapReader& map, const std::string& key, const DirectionShape& shape, Vec3& value);

template <class V>
void read_value(MapReader& map, const std::string& key, const ChoiceOf<V>& shape, V& value) {
    const std::string word = map.word(key);
    for (std::size_t i = 0; i < shape.words.size(); ++i)
        if (shape.words[i] == word) value = shape.meanings[i];
}

template <class U>
void read_value(MapReader& map, const std::string& key, const MapOf<U>& shape, U& value) {
    if (const Node* node = map.find(key))
        read_map(*node, *shape.table, shape.name.empty() ? map.name_of(key) : shape.name, value, map.report());
}

template <class U>
void read_value(MapReader& map, const std::string& key, const MapOf<U>& shape, std::optional<U>& value) {
    if (map.find(key) != nullptr) read_value(map, key, shape, value.emplace());
}

/// The member of a member.
template <class T, class M, class V>
auto within(M T::*outer, V M::*inner) {
    return [=](T& object) -> V& { return object.*outer.*inner; };
}

/// A row of a table: a key, and the member of T that it fills. A row without a member is read by code.
template <class T>
struct KeyRow {
    KeyShape key;
    std::function<void(MapReader&, T&)> read{};

    KeyRow(Presence presence, const char* name, ValueShape value, const char* help, const char* example,
           const char* fallback = "")
        : key{presence, name, std::move(value), help, example, fallback} {}

    /// @param member   of T; or a function that returns a reference into a T
    template <class Member, class Value>
    requires std::is_invocable_v<Member, T&> KeyRow(Presence presence, const char* name, Member member, Value value,
                                                    const char* help, const char* example, const char* fallback = "")
        : key{presence, name, value, help, example, fallback},
          read([member, value = std::move(value), name = std::string(name)](MapReader& map, T& object) {
              read_value(map, name, value, std::invoke(member, object));
          }) {}

    KeyRow(Presence presence, const char* name, PartOf<T> value, const char* help, const char* example)
        : KeyRow(
              presence, name, [](T& object) -> T& { return object; }, static_cast<MapOf<T>>(value), help, example) {}
};

/// The shape of a map that fills a T.
template <class T>
class MapShape : public Shape {
public:
    MapShape(const char* shape_id, const char* about, std::initializer_list<KeyRow<T>> fields)
        : Shape{shape_id, about, {}} {
        for (const KeyRow<T>& field : fields) {
            keys.push_back(field.key);
            read_.push_back(field.read);
        }
    }

    /// Reads the keys that have a member, in the order of the table. Of keys that exclude each other it reads one.
    void fill(MapReader& map, T& object) const {
        std::optional<const Node*> chosen;
        for (std::size_t i = 0; i < keys.size(); ++i) {
            if (!read_[i]) continue;
            if (keys[i].presence == Presence::one_of) {
                if (!chosen) chosen = map.one_of();
                if (*chosen == nullptr || (*chosen)->key != keys[i].name) continue;
            }
            read_[i](map, object);
        }
    }

private:
    std::vector<std::function<void(MapReader&, T&)>> read_;  ///< for each key; empty: code reads it
};

/// Reads a whole map into `object`: the keys that have a member, then `rest(map)`, which reads the others.
template <class T, class Rest>
void read_map(const Node& node, const MapShape<T>& table, const std::string& name, T& object, Report& report,
              Rest&& rest) {
    MapReader map(node, table, name, report);
    table.fill(map, object);
    rest(map);
    map.finish();
}

template <class T>
void read_map(const Node& node, const MapShape<T>& table, const std::string& name, T& object, Report& report) {
    read_map(node, table, name, object, report, [](MapReader&) {});
}

}  // namespace kerf::documents
