#pragma once
#include "edit/draft.h"
#include "edit/journal.h"

// Operations that change the shape of one vessel, `edit.vessel`, and no topology: each says what it did, or
// why it can not be done, and then has changed nothing.
namespace vasa {

Result<std::string> apply(const RadiusEdit& edit, VesselId vessel, Draft& draft);
Result<std::string> apply(const StenosisEdit& edit, VesselId vessel, Draft& draft);
Result<std::string> apply(const AneurysmEdit& edit, VesselId vessel, Draft& draft);
Result<std::string> apply(const MoveEdit& edit, VesselId vessel, Draft& draft);
Result<std::string> apply(const StentEdit& edit, VesselId vessel, Draft& draft);
Result<std::string> apply(const OccludeEdit& edit, VesselId vessel, Draft& draft);

}  // namespace vasa
