// SPDX-License-Identifier: Apache-2.0
#include "documents/yaml/key_homes.h"

#include <algorithm>
#include <cstddef>
#include <set>

#include "text/printable.h"

namespace kerf::documents {
namespace {

constexpr std::size_t max_homes = 2;

/// Searches the shapes of a document for a key, each shape once.
class HomeSearch {
public:
    HomeSearch(std::string_view key, const Shape& here) : key_(key), here_(here) {}

    void search(const Shape& shape, const std::string& under, const std::string& path, bool has_items) {
        if (!visited_.insert(&shape).second) return;
        const std::string prefix = path.empty() ? "" : path + ".";
        if (&shape != &here_ && shape.find(key_) != nullptr)
            homes_.push_back({under, has_items ? "" : prefix + std::string(key_)});
        for (const KeyShape& key : shape.keys) search(key.value, key.name, prefix + key.name, has_items);
    }

    std::vector<KeyHome> homes() && { return std::move(homes_); }

private:
    void search(const ValueShape& value, const std::string& under, const std::string& path, bool has_items) {
        for (const Shape* shape : {value.shape, value.other})
            if (shape != nullptr) search(*shape, under, path, has_items);
        for (const ValueShape& item : value.item) search(item, under, path, true);
    }

    std::string_view key_;
    const Shape& here_;
    std::set<const Shape*> visited_;
    std::vector<KeyHome> homes_;
};

/// Returns `instruments.pilot.` for the key `diameter` of `instruments.pilot.diameter: 3 mm` in a patch or a setting.
std::string path_before(const Node& child, const Report& report) {
    const text::Reason here = report.because(child.key_span, "");
    std::string path = here.source_line.substr(0, static_cast<std::size_t>(std::max(1, here.place.column)) - 1);
    path.erase(0, path.find_first_not_of(' '));
    const bool is_path = path.ends_with('.') && path.find_first_of(" {}[],:") == std::string::npos;
    return is_path ? path : std::string();
}

}  // namespace

std::vector<KeyHome> homes_of(std::string_view key, const Shape& whole, const Shape& here) {
    HomeSearch search(key, here);
    search.search(whole, "", "", false);
    std::vector<KeyHome> homes = std::move(search).homes();
    if (homes.size() > max_homes) homes.clear();
    return homes;
}

KeyAdvice advice_for(const Node& child, const Shape& here, const std::string& under, const Report& report) {
    const std::string quoted = "`" + text::excerpt(child.key, 40) + "`";
    const bool is_added = child.key_span.source != 0;  // by a patch or a setting
    if (!under.empty())
        return {quoted + " belongs under `" + under + ":`." + (is_added ? "" : " Move it there."),
                is_added ? path_before(child, report) + under + "." + child.key : ""};
    if (report.whole() == nullptr) return {};
    const std::vector<KeyHome> homes = homes_of(child.key, *report.whole(), here);
    if (homes.size() != 1) return {};  // it may mean another thing in each
    const KeyHome& home = homes.front();
    if (home.under.empty())
        return {quoted + " belongs to the document itself. Write it " +
                    (is_added ? "without a path before it." : "without indentation."),
                is_added ? child.key : ""};
    const std::string path = is_added ? home.path : "";
    return {quoted + " belongs under `" + home.under + ":`." + (path.empty() ? " Move it there." : ""), path};
}

}  // namespace kerf::documents
