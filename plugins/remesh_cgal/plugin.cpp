// SPDX-License-Identifier: GPL-3.0-or-later
#include "kerf/plugin.hpp"

#include "strategies.h"

KERF_PLUGIN("kerf.remesh_cgal", "0.1.0", "GPL-3.0-or-later", kerf::remesh_cgal::Exact, kerf::remesh_cgal::Local,
            kerf::remesh_cgal::WholeRounded)
