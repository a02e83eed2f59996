// SPDX-License-Identifier: Apache-2.0
// The papers' laws as printed, as a plugin.
#include "kerf/plugin.hpp"

#include "dental_implant.h"
#include "hsieh_2006.h"
#include "implant_torque.h"
#include "mandibular_saw.h"
#include "touch_count.h"
#include "tsai_2007.h"
#include "volumetric_drilling.h"

KERF_PLUGIN("papers.as_printed", "0.1.0", "Apache-2.0", kerf::as_printed::PaperBit, kerf::as_printed::Tsai2007,
            kerf::as_printed::TouchCount, kerf::as_printed::VolumetricDrilling, kerf::as_printed::PaperSaw,
            kerf::as_printed::Hsieh2006, kerf::as_printed::DentalImplant, kerf::as_printed::PaperImplant,
            kerf::as_printed::ImplantTorque, kerf::as_printed::PaperReciprocatingSaw, kerf::as_printed::MandibularSaw)
