#pragma once

#include <string>

#include "morph/parameterization/border_union.h"
#include "morph/parameterization/disk_map.h"
#include "morph/parameterization/map_quality.h"
#include "morph/registration/registration.h"
#include "morph/report.h"

/// What the report says of the results of stages.
namespace automorph {

RegistrationReport report_of(const Registration& registration, bool used);

BorderReport report_of(const BorderUnion& border);

/// A map of `shape` ("source", ...) with these weights.
MapReport report_of(const std::string& shape, const std::string& weights, const MapQuality& quality);
MapReport report_of(const std::string& shape, const DiskMap& map);

}  // namespace automorph
