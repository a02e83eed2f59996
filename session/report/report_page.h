// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

/// The files of session/report/page, embedded at build time (cmake/KerfEmbed.cmake). The page loads nothing from and
/// sends nothing to the network.
namespace kerf::session {

extern const std::string_view report_skeleton;  ///< report.html, with `{{name}}` for each part of `report_html`
extern const std::string_view report_style;     ///< report.css; also used by other pages
extern const std::string_view report_script;    ///< report.js

}  // namespace kerf::session
