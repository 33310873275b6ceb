#pragma once
#include "edit/draft.h"
#include "edit/journal.h"

// Operations on whole vessels and on who hangs on whom: each says what it did, or why it can not be done. A
// draft that one has failed on may be half changed: replay() (edit/replay.h) works on a copy.
namespace vasa {

Result<std::string> apply(const GraftEdit& edit, Draft& draft);
Result<std::string> apply(const BranchEdit& edit, Draft& draft);
Result<std::string> apply(const CutEdit& edit, Draft& draft);
Result<std::string> apply(const JoinEdit& edit, Draft& draft);
Result<std::string> apply(const RenameEdit& edit, Draft& draft);
Result<std::string> apply(const KindEdit& edit, Draft& draft);
Result<std::string> apply(const DeleteEdit& edit, Draft& draft);

}  // namespace vasa
