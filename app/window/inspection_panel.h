// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/window/inspection_view.h"
#include "app/window/panel_painter.h"
#include "run/view/viewed_run.h"

namespace kerf::window {

/// Paints the values of an inspection: channels and signals of the law, the coupling.
void paint_inspection_values(const run::ViewedInspection& inspection, const run::ViewedScene& scene,
                             const InspectionLayers& layers, PanelPainter& painter);

}  // namespace kerf::window
