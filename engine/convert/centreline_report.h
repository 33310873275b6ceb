#pragma once
#include "convert/report.h"
#include "network/centrelines.h"

namespace vasa {

/// The report of a network made of centre lines: an element for each line. Its error is the distance from the
/// line's samples to the sweep at their parameters; all of it is covered; there is no way back to measure.
ConvertReport reportOfCentrelines(const Centrelines& centrelines, const CentrelineNetwork& made);

}  // namespace vasa
