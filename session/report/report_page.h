// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

/// The files of session/report/page, embedded at build time (cmake/KerfEmbed.cmake). Nothing in them is fetched, and
/// nothing is sent.
namespace kerf {

extern const std::string_view report_skeleton;  ///< report.html, with `{{name}}` where `report_html` puts a part
extern const std::string_view report_style;     ///< report.css; other pages use it, too
extern const std::string_view report_script;    ///< report.js

}  // namespace kerf
