// SPDX-License-Identifier: Apache-2.0
#include "documents/yaml/map_shape.h"

#include "text/codes.h"

namespace kerf::documents {

void read_value(MapReader& map, const std::string& key, const ValueOf<std::string>& shape, std::string& value) {
    using Kind = ValueShape::Kind;
    value = shape.kind == Kind::id        ? map.id(key)
            : shape.kind == Kind::word    ? map.word(key)
            : shape.kind == Kind::path    ? map.data_path(key)
            : shape.kind == Kind::version ? map.version(key)
            : shape.kind == Kind::words   ? map.words(key)
                                          : map.text(key);
}

void read_value(MapReader& map, const std::string& key, const ValueOf<std::vector<std::string>>& /*shape*/,
                std::vector<std::string>& value) {
    value = map.ids(key);
}

void read_value(MapReader& map, const std::string& key, const ValueOf<bool>& /*shape*/, bool& value) {
    value = map.yes_no(key);
}

void read_value(MapReader& map, const std::string& key, const ValueOf<double>& shape, double& value) {
    if (map.shape_of(key).presence == Presence::required) value = shape.need.min;
    map.quantity(key, value);
}

void read_value(MapReader& map, const std::string& key, const ValueOf<double>& shape, std::optional<double>& value) {
    if (const Node* node = map.find(key)) value = read_quantity(*node, map.name_of(key), shape.need, map.report());
}

void read_value(MapReader& map, const std::string& key, const ValueOf<Vec3>& /*shape*/, Vec3& value) {
    value = map.vector(key).value_or(value);
}

void read_value(MapReader& map, const std::string& key, const DirectionShape& /*shape*/, Vec3& value) {
    const Vec3 direction = map.vector(key).value_or(Vec3{0, 0, 1});
    value = length(direction) > 1e-6 ? normalized(direction) : Vec3{0, 0, 1};
    if (!(length(direction) > 1e-6))
        map.report().error(text::Code::degenerate, map.span(),
                           map.name_of(key) + " has no length. Give it a direction, as in `0 0 1`.");
}

}  // namespace kerf::documents
