#pragma once
#include "edit/draft.h"
#include "edit/journal.h"

// Operations that change the shape of one vessel and no topology: each says what it did, or why it can not be
// done, and then has changed nothing.
namespace vasa {

Result<std::string> apply(const RadiusEdit& edit, Draft& draft);
Result<std::string> apply(const StenosisEdit& edit, Draft& draft);
Result<std::string> apply(const AneurysmEdit& edit, Draft& draft);
Result<std::string> apply(const MoveEdit& edit, Draft& draft);
Result<std::string> apply(const StentEdit& edit, Draft& draft);
Result<std::string> apply(const OccludeEdit& edit, Draft& draft);

}  // namespace vasa
