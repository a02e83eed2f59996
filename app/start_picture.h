// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <future>
#include <map>
#include <memory>
#include <string>

#include "app/window/start_page.h"
#include "core/plugin/loader.h"
#include "run/documents.h"

namespace kerf::app {

/// Makes pictures of procedures before their first tick on another thread, one at a time, and keeps them.   [main]
class StartPictures {
public:
    /// Pre: `plugins` outlives this object.
    explicit StartPictures(const PluginRegistry& plugins) : plugins_(&plugins) {}

    /// Returns the picture of a request; null while it is made, or if it cannot be made. The bone is drawn on a coarser
    /// grid than that of the procedure.
    /// @param key      names the request
    /// @param spacing  of the procedure [m]
    [[nodiscard]] std::shared_ptr<const window::StartPicture> of(const std::string& key,
                                                                 const run::DocumentRequest& request, double spacing);
    /// Returns why the picture that was requested last is not there.
    [[nodiscard]] std::string state() const;
    /// Returns whether no picture is being made.
    [[nodiscard]] bool is_idle();

private:
    struct Made {
        std::shared_ptr<const window::StartPicture> picture;
        std::string error;
    };
    [[nodiscard]] Made make(const run::DocumentRequest& request, double spacing);

    const PluginRegistry* plugins_;
    std::map<std::string, Made> made_;
    std::string shown_key_, making_key_;
    std::atomic<double> fraction_{0.0};
    std::future<Made> making_;  ///< last: its destructor waits for the thread
};

}  // namespace kerf::app
