#pragma once
#include "edit/draft.h"
#include "edit/journal.h"

// Operations on whole vessels, the first of which is `edit.vessel`, and on who hangs on whom: each says what
// it did, or why it can not be done. A draft that one has failed on may be half changed: replay()
// (edit/replay.h) works on a copy.
namespace vasa {

Result<std::string> apply(const GraftEdit& edit, VesselId from, Draft& draft);
Result<std::string> apply(const BranchEdit& edit, VesselId vessel, Draft& draft);
Result<std::string> apply(const CutEdit& edit, VesselId vessel, Draft& draft);
Result<std::string> apply(const JoinEdit& edit, VesselId first, Draft& draft);
Result<std::string> apply(const RenameEdit& edit, VesselId vessel, Draft& draft);
Result<std::string> apply(const KindEdit& edit, VesselId vessel, Draft& draft);
Result<std::string> apply(const DeleteEdit& edit, VesselId vessel, Draft& draft);

}  // namespace vasa
