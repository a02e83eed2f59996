// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "app/commands.h"
#include "app/options.h"
#include "app/start_picture.h"
#include "app/window/start_page.h"

namespace kerf::app {

/// Fills the start page from files: procedures of a folder, attempts of a learner, devices.   [main]
class StartPages final : public window::StartSource {
public:
    /// Pre: what `with` refers to outlives this object.
    StartPages(const WindowOptions& options, const Environment& with);

    const window::StartPage& page(window::StartSelection& selection) override;
    std::shared_ptr<const window::StartPicture> picture(const window::StartSelection& selection) override;
    [[nodiscard]] std::string picture_state() const override {
        return page_.procedures.empty() || !page_.details.error.empty() ? "" : pictures_.state();
    }
    void open_folder(const std::string& folder) override;
    void forget_message() override { page_.message.clear(); }

    /// Returns whether no picture is being made: a run may then have the processor for itself.
    [[nodiscard]] bool is_idle() { return pictures_.is_idle(); }
    void set_message(const std::string& message, bool is_bad);
    /// Reads the attempts again, before the next page.
    void read_attempts_again() { learner_.reset(); }

private:
    void read_procedures();
    void read_details(const window::StartSelection& selection);
    void find_devices(window::StartSelection& selection);

    Environment with_;
    std::string language_;  ///< of the procedures' words
    window::StartPage page_;
    StartPictures pictures_;
    std::optional<std::string> learner_;  ///< whose attempts are on the page
    std::string detailed_;                ///< procedure and variant of the details on the page
    double spacing_ = 0.0;                ///< [m] of that procedure
    std::optional<std::chrono::steady_clock::time_point> searched_;  ///< when devices were searched last
};

}  // namespace kerf::app
