#pragma once
#include <string>
#include <vector>

#include "command_text.h"

namespace vasa::cli {

/// A subject that help knows beside the commands: a heading line "# name: what it is about", then paragraphs,
/// "## " headings, "* " list items and blocks indented by four, which are command lines or listings.
struct Topic {
  std::string name;
  std::string text;

  std::string title() const;  ///< "what it is about"
};

/// All topics, from docs/help, in alphabetical order.
const std::vector<Topic>& topics();

/// Manual pages as troff with the man macros: vasa(1), vasa-COMMAND(1), vasa-TOPIC(7).
std::string manPage(const CommandText& command, const CommandText& program);
std::string manPage(const Topic& topic);
std::string manName(const CommandText& command);  ///< "vasa-bench-collide"
std::string manName(const Topic& topic);          ///< "vasa-formats"

}  // namespace vasa::cli
