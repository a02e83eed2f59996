// SPDX-License-Identifier: Apache-2.0
#include "app/picked_bone.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <system_error>
#include <utility>

#include "bone/import/landmark_checks.h"
#include "bone/import/make_body.h"
#include "bone/import/markups.h"
#include "documents/add_landmarks.h"
#include "documents/id.h"
#include "documents/made/anatomy_text.h"
#include "documents/names.h"
#include "documents/read_anatomy.h"
#include "documents/yaml/document.h"
#include "run/view/scene_view.h"
#include "run/view/surface_view.h"
#include "text/write_file.h"

namespace kerf::app {

namespace {

namespace fs = std::filesystem;

constexpr double tolerance = 1e-3;  // [m] of a landmark that is picked
constexpr double usual_spacing = 0.5e-3, fine_spacing = 0.25e-3, coarse_spacing = 1e-3;  // [m]

documents::NewLandmarks landmarks_of(const std::vector<window::PickedLandmark>& picked) {
    documents::NewLandmarks added;
    for (const window::PickedLandmark& one : picked)
        if (one.to)
            added.axes.push_back({.id = one.id, .from = one.at, .to = *one.to, .tolerance = tolerance});
        else
            added.points.push_back(
                {.id = one.id, .at = one.at, .tolerance = tolerance, .lies = documents::LandmarkPoint::Lies::on_bone});
    return added;
}

/// Reads an anatomy that may have no landmarks yet: it is read with one, which is removed again.
text::Result<documents::Anatomy> read_without_landmarks(const std::string& file, const std::string& text) {
    text::Diagnostics found, ignored;
    if (auto anatomy = documents::read_anatomy_text(file, text).take(found))
        return {std::move(*anatomy), std::move(found)};
    const auto with_one =
        documents::with_landmarks(file, text, {.points = {{.id = "none", .tolerance = tolerance}}}).take(ignored);
    auto anatomy = with_one ? documents::read_anatomy_text(file, *with_one).take(ignored) : std::nullopt;
    if (!anatomy) return found;
    anatomy->points.clear();
    anatomy->text = text;
    return *std::move(anatomy);
}

/// Returns the anatomy without all that concerns landmarks: what is wrong with them must not prevent that others are
/// picked. The point at which a piece of a scan is kept stays.
documents::Anatomy bone_alone(documents::Anatomy anatomy) {
    const std::string piece = anatomy.ct ? anatomy.ct->component_at : "";
    std::erase_if(anatomy.points, [&](const documents::LandmarkPoint& point) { return point.id != piece; });
    for (documents::LandmarkPoint& point : anatomy.points) {
        point.fit.reset();
        point.lies = documents::LandmarkPoint::Lies::anywhere;
    }
    anatomy.axes.clear();
    constexpr double far = 2.0;  // [m] a scan is read around its axes: around this one it is read whole
    if (anatomy.ct) anatomy.axes.push_back({.id = "whole", .from = {-far, -far, -far}, .to = {far, far, far}});
    anatomy.planes.clear();
    anatomy.zones.clear();
    return anatomy;
}

bool has_code(const text::Diagnostics& diagnostics, const std::string& code) {
    return std::any_of(diagnostics.begin(), diagnostics.end(),
                       [&](const text::Diagnostic& one) { return one.code == code; });
}

/// Makes the whole bone. Without a spacing it takes a finer one for thin bone, and a coarser one for a large bone.
text::Result<Body> make_whole(const documents::Anatomy& anatomy, std::optional<double> spacing,
                              const bone::Progress& progress) {
    const bone::ImportOptions options{.progress = progress};
    auto made = bone::make_body(anatomy, spacing.value_or(usual_spacing), nullptr, options);
    if (made || spacing) return made;
    const bool is_thin = has_code(made.diagnostics(), "E0655"), is_large = has_code(made.diagnostics(), "E0602");
    return is_thin    ? bone::make_body(anatomy, fine_spacing, nullptr, options)
           : is_large ? bone::make_body(anatomy, coarse_spacing, nullptr, options)
                      : made;
}

std::string first_error(const text::Diagnostics& diagnostics) {
    const auto found = std::find_if(diagnostics.begin(), diagnostics.end(), [](const text::Diagnostic& one) {
        return one.level == text::Diagnostic::Level::error;
    });
    return found == diagnostics.end() ? "" : found->code + " " + found->message;
}

std::string millimetres(double metres) { return documents::with_decimals(1e3 * metres, 1) + " mm"; }

}  // namespace

text::Result<std::unique_ptr<PickedBone>> PickedBone::make(const std::string& file, std::optional<double> spacing,
                                                           const std::string& shipped, const bone::Progress& progress) {
    text::Diagnostics diagnostics;
    const auto text = documents::read_text_file(file).take(diagnostics);
    if (!text) return diagnostics;
    auto anatomy = read_without_landmarks(file, *text).take(diagnostics);
    if (!anatomy) return diagnostics;
    static_cast<void>(bone::add_markups(*anatomy, diagnostics));
    auto body = make_whole(bone_alone(*anatomy), spacing, progress).take(diagnostics);
    if (!body) return diagnostics;
    std::unique_ptr<PickedBone> made(new PickedBone(file, shipped, *std::move(anatomy), *std::move(body)));
    if (made->surface_ == nullptr) {
        diagnostics.push_back(text::error_about(file, "E0601", "the bone has no surface. Check the anatomy."));
        return diagnostics;
    }
    return {std::move(made), std::move(diagnostics)};
}

PickedBone::PickedBone(std::string file, std::string shipped, documents::Anatomy anatomy, Body body)
    : file_(std::move(file)),
      shipped_(std::move(shipped)),
      anatomy_(std::move(anatomy)),
      body_(std::move(body)),
      present_(body_, 0),
      field_(body_, present_.cut()) {
    scene_.title = anatomy_.title;
    scene_.tissues = run::viewed_tissues(body_);
    scene_.spacing = body_.grid().spacing;
    run::SurfaceView view;
    surface_ = view.update(present_, {true});
    list_written();
}

void PickedBone::list_written() {
    written_.clear();
    for (const documents::LandmarkPoint& point : anatomy_.points) written_.push_back({.id = point.id, .at = point.at});
    for (const documents::LandmarkAxis& axis : anatomy_.axes)
        written_.push_back({.id = axis.id, .at = axis.from, .to = axis.to});
}

std::string PickedBone::file_name() const { return fs::path(file_).filename().string(); }

std::optional<window::SurfacePoint> PickedBone::surface_point(Vec3 from, Vec3 direction) const {
    if (!is_finite(from) || !is_finite(direction) || !(length(direction) > 0.0)) return std::nullopt;
    const bone::Line line{from, normalized(direction)};
    const auto entry = field_.entry_on(line, 0.0, std::numeric_limits<double>::max());
    if (!entry) return std::nullopt;
    window::SurfacePoint point{.position = line.point + *entry * line.direction};
    point.normal = field_.normal_at(point.position);
    double weight[KERF_MAX_TISSUES];
    material_weights(body_, locate(body_, point.position - 0.5 * body_.grid().spacing * point.normal), weight);
    const auto largest = std::max_element(weight, weight + body_.materials.size());
    point.tissue = scene_.tissues[static_cast<std::size_t>(largest - weight)].name;
    return point;
}

std::string PickedBone::problem_of_name(const std::string& id) const {
    if (!documents::is_id(id) || id == "null" || id == "Null" || id == "NULL")
        return "The name is `" + text::shown(id) +
               "`. Write letters, digits, `.`, `_` and `-`, a letter or digit first, at most 64.";
    if (documents::find_id(anatomy_.points, id) || documents::find_id(anatomy_.axes, id) ||
        documents::find_id(anatomy_.planes, id))
        return "The file has a landmark `" + id + "` already. Choose another name.";
    return {};
}

std::string PickedBone::description(const window::PickedLandmark& landmark) const {
    if (!landmark.to) return documents::vector_text(1e3 * landmark.at) + " mm";
    const std::string length_text = millimetres(length(*landmark.to - landmark.at)) + " long";
    if (length(*landmark.to - landmark.at) < 1e-6) return "no length: both ends are the same point";
    const auto [entry, fraction_in_bone, inside, is_reversed] =
        bone::axis_in_bone(body_, {.id = landmark.id, .from = landmark.at, .to = *landmark.to});
    if (entry < 0.0) return length_text + ", meets no bone";
    const bool is_off_bone = entry > 0.2e-3;  // [m] it does not begin on the surface
    return length_text + (is_off_bone ? ", bone after " + millimetres(entry) + ", " : ", ") +
           documents::with_decimals(100.0 * fraction_in_bone, 0) + " % " +
           (is_off_bone ? "of the rest in bone" : "in bone");
}

std::string PickedBone::yaml(const std::vector<window::PickedLandmark>& picked) const {
    return documents::landmarks_text(landmarks_of(picked));
}

std::string PickedBone::refusal_of_file() const {
    std::error_code ignored;
    const fs::path real = fs::canonical(file_, ignored), shipped = fs::canonical(shipped_, ignored);
    const auto [at, end] = std::mismatch(shipped.begin(), shipped.end(), real.begin(), real.end());
    if (!shipped_.empty() && !shipped.empty() && at == shipped.end())
        return "The file belongs to Kerf and is not changed. Copy it into a folder of your own, and open the copy.";
    struct stat there {};
    const bool is_protected = stat(file_.c_str(), &there) != 0 || (there.st_mode & 0222) == 0;
    if (is_protected || access(file_.c_str(), W_OK) != 0)
        return "The file is protected against writing. Permit writing, or copy the landmarks and paste them.";
    text::Diagnostics unreadable;
    const auto text = documents::read_text_file(file_).take(unreadable);
    if (!text || *text != anatomy_.text)
        return "The file has changed since it was read. Copy the landmarks, open the file again, and paste them.";
    return {};
}

std::string PickedBone::write(const std::vector<window::PickedLandmark>& picked) {
    if (std::string refusal = refusal_of_file(); !refusal.empty()) return refusal;
    text::Diagnostics diagnostics, before, after;
    const auto text = documents::with_landmarks(file_, anatomy_.text, landmarks_of(picked)).take(diagnostics);
    if (!text) return first_error(diagnostics);
    auto anatomy = documents::read_anatomy_text(file_, *text).take(diagnostics);
    if (!anatomy) return first_error(diagnostics);
    static_cast<void>(bone::add_markups(*anatomy, diagnostics));
    bone::check_landmarks(anatomy_, body_, before);
    bone::check_landmarks(*anatomy, body_, after);
    for (const text::Diagnostic& one : after)
        if (one.level == text::Diagnostic::Level::error &&
            std::none_of(before.begin(), before.end(),
                         [&](const text::Diagnostic& known) { return known.message == one.message; }))
            return one.code + " " + one.message;
    std::error_code failure;
    const fs::path real = fs::canonical(file_, failure);  // a link stays a link
    const fs::perms permissions = fs::status(real, failure).permissions();
    if (failure) return file_name() + " could not be written: " + failure.message() + ".";
    if (std::string error = text::write_file(real.string(), *text); !error.empty()) return error;
    fs::permissions(real, permissions, failure);  // succeeds for the owner
    anatomy_ = *std::move(anatomy);
    list_written();
    return {};
}

}  // namespace kerf::app
