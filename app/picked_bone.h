// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/window/landmark_page.h"
#include "bone/measure/field_surface.h"
#include "bone/report/import_report.h"
#include "core/field/grid/body.h"
#include "core/field/pieces/present_bone.h"
#include "documents/anatomy.h"
#include "text/result.h"

namespace kerf::app {

/// The bone of an anatomy file, whole and in the frame of the file, on which landmarks are picked. Points of a scan
/// that is not yet planned can be picked, too: the file needs no landmarks.   [main]
class PickedBone final : public window::LandmarkSource {
public:
    /// Reads the file and makes the bone. Error: the mistakes of the file, or why it has no bone. Warnings may come
    /// with it.
    /// @param spacing  [m]; nothing: 0.5 mm, or another one that the bone needs
    /// @param shipped  folder whose files are never changed
    [[nodiscard]] static text::Result<std::unique_ptr<PickedBone>> make(const std::string& file,
                                                                        std::optional<double> spacing,
                                                                        const std::string& shipped,
                                                                        const bone::Progress& progress = {});

    [[nodiscard]] const run::ViewedScene& scene() const noexcept override { return scene_; }
    [[nodiscard]] std::shared_ptr<const run::ViewedSurface> surface() const override { return surface_; }
    [[nodiscard]] std::string file_name() const override;
    [[nodiscard]] const std::vector<window::PickedLandmark>& written() const override { return written_; }
    [[nodiscard]] std::optional<window::SurfacePoint> surface_point(Vec3 from, Vec3 direction) const override;
    [[nodiscard]] std::string problem_of_name(const std::string& id) const override;
    [[nodiscard]] std::string description(const window::PickedLandmark& landmark) const override;
    [[nodiscard]] std::string yaml(const std::vector<window::PickedLandmark>& picked) const override;
    /// Refuses a shipped file, one without permission to write, one that has changed since it was read, and landmarks
    /// that import would refuse.
    [[nodiscard]] std::string write(const std::vector<window::PickedLandmark>& picked) override;

    [[nodiscard]] const Body& body() const noexcept { return body_; }

private:
    PickedBone(std::string file, std::string shipped, documents::Anatomy anatomy, Body body);
    void list_written();
    [[nodiscard]] std::string refusal_of_file() const;

    std::string file_, shipped_;
    documents::Anatomy anatomy_;  ///< as read, with its markups
    Body body_;
    PresentBone present_;
    bone::FieldSurface field_;
    run::ViewedScene scene_;
    std::shared_ptr<const run::ViewedSurface> surface_;
    std::vector<window::PickedLandmark> written_;
};

}  // namespace kerf::app
