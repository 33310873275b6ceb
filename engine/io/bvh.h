#pragma once
#include <filesystem>
#include <string_view>

#include "body/humanoid.h"
#include "body/motion.h"
#include "core/result.h"

namespace vasa {

/// A motion from a Biovision hierarchy file. Rotations may come in any order of axes; scale channels are
/// refused. A frame is a row of values, or several where the first one is. Joints other than roots whose
/// places are zero in every frame stay at their OFFSETs, with a warning. Places and OFFSETs in two units are
/// brought to one (body/motion_units.h), with a warning; so are told several people and swapped sides. What
/// stands behind the last frame is passed over with a warning. Fails with badInput, naming file and line:
/// UTF-16, a word out of place, an offset or value that is not a finite number, a channel of unknown kind,
/// nesting beyond 256 or more than 4096 joints, a row that does not fit the channels, fewer frames than
/// promised, frames times joints that take over 15 times the file's bytes and 48 MiB (28 bytes each), no
/// frames, a frame time that is not above zero or over a second.
Result<Motion> readBvh(const std::filesystem::path& path);

/// The same from text. @param name  for messages, and the motion's
Result<Motion> parseBvh(std::string_view text, const std::string& name);

/// Pairs of joints, a line each: `motion's joint = body's joint`; nothing on the right leaves the joint out;
/// what follows a # at a line's beginning or after a blank is a comment. Names that hold a = want blanks
/// around the line's own; one in double quotes stands as it is, but for \", \\ and \n. No joint is on either
/// side twice. At most 1 MiB. Fails with badInput, naming file and line.
Result<JointMap> readJointMap(const std::filesystem::path& path);
Result<JointMap> parseJointMap(std::string_view text, const std::string& name);
/// A name for a line of a joint map: in double quotes where it would not be read back otherwise.
std::string jointMapName(std::string_view name);

}  // namespace vasa
