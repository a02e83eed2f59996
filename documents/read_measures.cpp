// SPDX-License-Identifier: Apache-2.0
#include "documents/read_measures.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "documents/names.h"
#include "documents/shapes/shapes.h"
#include "text/codes.h"
#include "text/look_alike.h"
#include "text/printable.h"

namespace kerf::documents {
namespace {

/// The names that constructions and measures may use.
class Names {
public:
    Names(const std::vector<std::string>& landmarks, Report& report) : known_(landmarks), report_(&report) {}

    void add(const std::string& id) { known_.push_back(id); }
    /// Names that are defined below. They improve the message.
    void add_later(const Node& node) {
        for (const Node& child : node.children) later_.push_back(child.key);
    }
    /// Returns whether a name is known, or empty. Reports another one.
    bool check(const Node& name, const std::string& id) const {
        if (id.empty() || contains(known_, id)) return true;
        if (contains(later_, id)) {
            report_->error(text::Code::unknown_construction, name.span,
                           "The construction " + quoted_id(id) +
                               " is used above the line that makes it. Move it up, before this one.");
            return false;
        }
        const std::string meant = closest(text::straightened(id), known_, *report_);
        report_->error(text::Code::unknown_construction, name.span,
                       "The name " + quoted_id(text::excerpt(id, 40)) +
                           " is neither a landmark of `needs.landmarks` nor a construction: " +
                           (known_.empty() ? "there are none." : "expected " + listed(known_, id) + ".") +
                           or_choose(meant, known_.empty() ? "Add it to `needs.landmarks`." : "Write one of these."),
                       meant);
        return false;
    }
    /// Returns the name under a key; empty if it is refused, so that no second error is about it.
    std::string read(MapReader& map, const std::string& key) const {
        const Node* node = map.find(key);
        if (node == nullptr) return {};
        const std::string id = read_id(*node, map.name_of(key), *report_).value_or("");
        return check(*node, id) ? id : std::string();
    }
    std::vector<std::string> read_list_of(MapReader& map, const std::string& key, std::size_t least) const {
        const Node* node = map.find(key);
        return node != nullptr ? read_all(*node, map.name_of(key), least) : std::vector<std::string>{};
    }
    std::vector<std::string> read_all(const Node& node, const std::string& name, std::size_t least) const {
        std::vector<std::string> ids = read_ids(node, name, *report_);
        for (const Node& item : node.children)
            if (!check(item, item.text)) std::replace(ids.begin(), ids.end(), item.text, std::string());
        if (ids.size() > max_construction_points)
            report_->error(text::Code::out_of_range, node.key_span,
                           name + " has too many points: got " + std::to_string(ids.size()) + ", expected at most " +
                               std::to_string(max_construction_points) + ". Remove some.");
        if (!ids.empty() && ids.size() < least)
            report_->error(text::Code::degenerate, node.key_span,
                           name + " has too few points: got " + std::to_string(ids.size()) + ", expected at least " +
                               std::to_string(least) + ". Add one.");
        return ids;
    }

private:
    std::vector<std::string> known_, later_;
    Report* report_;
};

bool has_room(const Node& node, const std::string& what, Report& report) {
    if (node.children.size() <= max_measures) return true;
    report.error(text::Code::out_of_range, node.children[max_measures].key_span,
                 "There are too many " + what + ": got " + std::to_string(node.children.size()) +
                     ", expected at most " + std::to_string(max_measures) + ". Remove some.");
    return false;
}

/// Reads the value of the one key of a construction.
void read_kind(const Node& chosen, const Names& names, Construction& made, Report& report) {
    const std::string name = made.id + "." + chosen.key;
    if (chosen.key == "middle") {
        made.kind = Construction::Kind::middle;
        made.of = names.read_all(chosen, name, 1);
    } else if (chosen.key == "line") {
        made.kind = Construction::Kind::line;
        made.of = names.read_all(chosen, name, 2);
    } else if (chosen.key == "plane") {
        made.kind = Construction::Kind::plane;
        made.of = names.read_all(chosen, name, 3);
    } else if (chosen.key == "mirror") {
        made.kind = Construction::Kind::mirror;
        MapReader map(chosen, shapes::mirror, name, report);
        made.of = names.read_list_of(map, "left", 1);
        made.right = names.read_list_of(map, "right", 1);
        if (made.of.size() != made.right.size() && !made.of.empty() && !made.right.empty())
            report.error(text::Code::degenerate, map.span(),
                         name + " has points without a partner: got " + std::to_string(made.of.size()) + " left and " +
                             std::to_string(made.right.size()) + " right. Write as many on either side.");
        map.finish();
    } else if (chosen.key == "tangent") {
        made.kind = Construction::Kind::tangent;
        MapReader map(chosen, shapes::tangent, name, report);
        made.of = names.read_list_of(map, "along", 2);
        made.in = names.read(map, "in");
        shapes::tangent.fill(map, made);
        map.finish();
    } else {
        made.kind = Construction::Kind::entry;
        MapReader map(chosen, shapes::axis_entry, name, report);
        made.of = {names.read(map, "of")};
        map.finish();
    }
}

/// Returns the measure above that a difference refers to; null and reported if there is none.
const Measure* earlier(MapReader& map, const std::string& key, const std::vector<Measure>& above,
                       const std::vector<std::string>& below, std::string& id, Report& report) {
    const Node* node = map.find(key);
    if (node == nullptr) return nullptr;
    id = read_id(*node, map.name_of(key), report).value_or("");
    if (id.empty()) return nullptr;
    std::vector<std::string> known;
    for (const Measure& one : above) {
        if (one.id == id) return &one;
        known.push_back(one.id);
    }
    if (contains(below, id)) {
        report.error(
            text::Code::unknown_measure, node->span,
            "The measure " + quoted_id(id) + " is used above the line that makes it. Move it up, before this one.");
        return nullptr;
    }
    const std::string meant = closest(text::straightened(id), known, report);
    report.error(text::Code::unknown_measure, node->span,
                 "The name " + quoted_id(text::excerpt(id, 40)) + " is no measure above this one: " +
                     (known.empty() ? "there are none. Write the difference below both of its measures."
                                    : "expected " + listed(known, id) + "." + or_choose(meant, "Write one of these.")),
                 meant);
    return nullptr;
}

void read_difference(const Node& chosen, const std::vector<Measure>& above, const std::vector<std::string>& below,
                     Measure& measure, Report& report) {
    MapReader map(chosen, shapes::difference_measure, measure.id + "." + chosen.key, report);
    measure.kind = Measure::Kind::difference;
    const Measure* of = earlier(map, "of", above, below, measure.of, report);
    const Measure* from = earlier(map, "from", above, below, measure.to, report);
    map.finish();
    if (of == nullptr || from == nullptr) return;
    measure.is_of_angles = of->is_angle();
    const auto sort = [](const Measure& one) { return one.is_angle() ? "an angle" : "a length"; };
    if (of->is_angle() != from->is_angle())
        report.error(text::Code::other_sort, map.find("from")->span,
                     quoted_id(measure.id) + " is the difference of two sorts of measures: got " + quoted_id(of->id) +
                         ", which is " + sort(*of) + ", and " + quoted_id(from->id) + ", which is " + sort(*from) +
                         ", expected two angles or two lengths. Name such a pair.");
}

void read_kind(const Node& chosen, const Names& names, Measure& measure, Report& report) {
    const Shape& shape = *shapes::measure.find(chosen.key)->value.shape;
    MapReader map(chosen, shape, measure.id + "." + chosen.key, report);
    measure.kind = chosen.key == "angle"              ? Measure::Kind::angle
                   : chosen.key == "distance"         ? Measure::Kind::distance
                   : chosen.key == "thickness"        ? Measure::Kind::thickness
                   : chosen.key == "surface_distance" ? Measure::Kind::surface_distance
                   : chosen.key == "roughness"        ? Measure::Kind::roughness
                                                      : Measure::Kind::difference;
    if (measure.kind == Measure::Kind::thickness) {
        measure.of = names.read(map, "at");
        measure.to = names.read(map, "along");
    } else {
        measure.of = names.read(map, "of");
        if (shape.find("to") != nullptr) measure.to = names.read(map, "to");
    }
    if (shape.find("in") != nullptr) measure.in = names.read(map, "in");
    map.finish();
}

// ---- sorts -------------------------------------------------------------------------------------------------------

const char* words_of(Sort sort) {
    return sort == Sort::point ? "a point" : sort == Sort::line ? "a line or axis" : "a plane";
}

class SortCheck {
public:
    SortCheck(const std::vector<Construction>& constructions, const Anatomy& anatomy, const Document& document,
              Report& report)
        : document_(&document), report_(&report) {
        for (const LandmarkPoint& point : anatomy.points) sorts_[point.id] = Sort::point;
        for (const LandmarkAxis& axis : anatomy.axes) sorts_[axis.id] = Sort::line;
        for (const LandmarkPlane& plane : anatomy.planes) sorts_[plane.id] = Sort::plane;
        for (const Construction& made : constructions) {
            sorts_[made.id] = made.sort();
            if (made.kind == Construction::Kind::tangent) tangents_.push_back(made.id);
        }
    }

    void check(const Construction& made) {
        under_ = {"constructions", made.id};
        using Kind = Construction::Kind;
        const Sort wanted = made.kind == Kind::entry ? Sort::line : Sort::point;
        for (const auto* names : {&made.of, &made.right})
            for (const std::string& id : *names) need(id, {wanted});
        if (made.kind == Kind::tangent) need(made.in, {Sort::plane});
    }

    void check(const Measure& measure) {
        under_ = {"measures", measure.id};
        switch (measure.kind) {
            case Measure::Kind::angle:
                need(measure.of, {Sort::line, Sort::plane});
                need(measure.to, {Sort::line, Sort::plane});
                if (!measure.in.empty()) need(measure.in, {Sort::plane});
                break;
            case Measure::Kind::distance:
                check_distance(measure);
                break;
            case Measure::Kind::thickness:
                need(measure.of, {Sort::point});
                need(measure.to, {Sort::line});
                break;
            case Measure::Kind::surface_distance:
                need(measure.of, {Sort::point});
                break;
            case Measure::Kind::roughness:
                if (sorts_.contains(measure.of) && !contains(tangents_, measure.of))
                    refuse(measure.of, "a tangent of `constructions:`");
                break;
            case Measure::Kind::difference:  // of measures, not of things
                break;
        }
    }

private:
    void check_distance(const Measure& measure) {
        const auto one = sorts_.find(measure.of), other = sorts_.find(measure.to);
        if (one == sorts_.end() || other == sorts_.end()) return;
        if (one->second == Sort::plane)
            need(measure.to, {Sort::point});
        else if (other->second == Sort::plane)
            need(measure.of, {Sort::point});
    }

    /// A name that is unknown was refused already.
    void need(const std::string& id, const std::vector<Sort>& wanted) {
        const auto found = sorts_.find(id);
        if (found == sorts_.end() || std::find(wanted.begin(), wanted.end(), found->second) != wanted.end()) return;
        std::string words;
        for (const Sort sort : wanted) words += (words.empty() ? "" : " or ") + std::string(words_of(sort));
        refuse(id, words);
    }

    void refuse(const std::string& id, const std::string& wanted) {
        report_->error(text::Code::other_sort, span_of(id),
                       quoted_id(under_.back()) + " is made of another sort of thing: got " + quoted_id(id) +
                           ", which is " + words_of(sorts_.at(id)) + ", expected " + wanted + ". Name one of these.");
    }

    /// Where the construction or measure has this name.
    [[nodiscard]] TextSpan span_of(const std::string& id) const {
        const Node* node = &document_->root;
        for (const std::string& key : under_) node = node != nullptr ? node->find(key) : nullptr;
        TextSpan span = node != nullptr ? node->span : TextSpan{};
        const auto look = [&](const Node& in, const auto& again) -> bool {
            for (const Node& child : in.children) {
                if (child.kind == Node::Kind::scalar && child.text == id) {
                    span = child.span;
                    return true;
                }
                if (again(child, again)) return true;
            }
            return false;
        };
        if (node != nullptr) look(*node, look);
        return span;
    }

    const Document* document_;
    Report* report_;
    std::map<std::string, Sort> sorts_;
    std::vector<std::string> tangents_, under_;
};

}  // namespace

std::vector<Construction> read_constructions(const Node& node, const std::vector<std::string>& landmarks,
                                             Report& report) {
    std::vector<Construction> made;
    if (!is_kind(node, Node::Kind::map, "constructions", report)) return made;
    if (!has_room(node, "constructions", report)) return made;
    Names names(landmarks, report);
    names.add_later(node);
    for (const Node& child : node.children) {
        read_key(child, "A construction's name", report);
        if (contains(landmarks, child.key))
            report.error(text::Code::duplicate_id, child.key_span,
                         "The name " + quoted_id(child.key) +
                             " is there twice: it is a landmark, too. Write another name for the construction.");
        MapReader map(child, shapes::construction, child.key, report);
        Construction one;
        one.id = child.key;
        if (const Node* chosen = map.one_of()) read_kind(*chosen, names, one, report);
        map.finish();
        names.add(child.key);
        made.push_back(std::move(one));
    }
    return made;
}

std::vector<Measure> read_measures(const Node& node, const std::vector<std::string>& landmarks,
                                   const std::vector<Construction>& constructions, Report& report) {
    std::vector<Measure> measures;
    if (!is_kind(node, Node::Kind::map, "measures", report)) return measures;
    if (!has_room(node, "measures", report)) return measures;
    Names names(landmarks, report);
    for (const Construction& made : constructions) names.add(made.id);
    std::vector<std::string> below;
    for (const Node& child : node.children) below.push_back(child.key);
    for (const Node& child : node.children) {
        below.erase(below.begin());
        read_key(child, "A measure's name", report);
        MapReader map(child, shapes::measure, child.key, report);
        Measure measure;
        measure.id = child.key;
        if (const Node* chosen = map.one_of()) {
            if (chosen->key == "difference")
                read_difference(*chosen, measures, below, measure, report);
            else
                read_kind(*chosen, names, measure, report);
        }
        map.finish();
        measures.push_back(std::move(measure));
    }
    return measures;
}

void check_sorts(const std::vector<Construction>& constructions, const std::vector<Measure>& measures,
                 const Anatomy& anatomy, const Document& document, Report& report) {
    SortCheck check(constructions, anatomy, document, report);
    for (const Construction& made : constructions) check.check(made);
    for (const Measure& measure : measures) check.check(measure);
}

}  // namespace kerf::documents
