# Run at build time: the help topics of docs/help as a C++ source.
# usage: cmake -DOUT=topics.cpp "-DTOPICS=a.md;b.md" -P embed_topics.cmake
cmake_minimum_required(VERSION 3.25)
set(entries "")
foreach(topic IN LISTS TOPICS)
  cmake_path(GET topic STEM name)
  file(READ "${topic}" text)
  if(NOT text MATCHES "^# ${name}: ")
    message(FATAL_ERROR "${topic}: the first line must begin with '# ${name}: '")
  endif()
  # A raw string holds 65,535 characters at most; a topic is far shorter.
  string(APPEND entries "      {\"${name}\", R\"topic(${text})topic\"},\n")
endforeach()
file(WRITE "${OUT}" "// Generated from docs/help.
#include \"man_page.h\"

namespace vasa::cli {

const std::vector<Topic>& topics() {
  static const std::vector<Topic> all{
${entries}  };
  return all;
}

}  // namespace vasa::cli
")
