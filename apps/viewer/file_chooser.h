#pragma once
#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/result.h"

namespace vasa::viewer {

/// A line of a folder.
struct FileRow {
  std::string name;
  bool folder = false;
  std::uintmax_t bytes = 0;  ///< of a file
};

/// What a folder holds: the way up, its folders, then its files with one of these extensions (all of them
/// where there are none), each by name whatever the case. Names that begin with a dot are left out. Fails
/// with ioError where the folder cannot be read.
Result<std::vector<FileRow>> rowsOfFolder(const std::filesystem::path& folder,
                                          const std::vector<std::string>& extensions);

enum class FilePurpose : std::uint8_t { open, saveScene, exportFile };

/// A dialog in which a file is chosen, apart from how it is shown: in which folder it is, which line is
/// marked, what is typed.
class FileChooser {
 public:
  /// @param extensions  of the files that are listed, with their dots; a name that is saved without one gets
  /// the first
  void start(FilePurpose purpose, const std::filesystem::path& folder, std::string name,
             std::vector<std::string> extensions);
  void close() { open_ = false; }
  bool isOpen() const { return open_; }

  FilePurpose purpose() const { return purpose_; }
  const std::filesystem::path& folder() const { return folder_; }
  const std::vector<FileRow>& rows() const { return rows_; }
  /// The line that Enter means; -1: what is typed.
  int marked() const { return marked_; }
  const std::string& message() const { return message_; }  ///< why Enter did not do; empty: it did
  bool allFiles() const { return allFiles_; }
  const std::vector<std::string>& extensions() const { return extensions_; }

  std::string typed;  ///< told by typing() when it is another
  /// What is typed is another: marks the first line that begins so.
  void typing();
  /// What Tab makes of what is typed: as far as all lines that begin so agree.
  std::string completed() const;
  void mark(int row);
  void step(int way);  ///< to the line so many further down
  /// Of files that are opened together: takes a line in, or out again; all lines from the marked one to it;
  /// one line further down, too.
  void toggle(int row);
  void extend(int row);
  void extendStep(int way);
  bool isTaken(int row) const;
  /// How many files enter() means.
  std::size_t count() const { return std::max<std::size_t>(taken_.size(), 1); }
  void showAllFiles(bool all);
  void setExtensions(std::vector<std::string> extensions);
  void go(const std::filesystem::path& folder);
  /// Into the folder that is meant, or the file itself, which ends the dialog. A file that would be replaced
  /// is asked for a second time.
  std::optional<std::filesystem::path> enter();
  /// What enter() has answered, and the files beside it that were taken in.
  std::vector<std::filesystem::path> withOthers(const std::filesystem::path& file) const;

 private:
  int stepped(int way) const;
  void list();
  std::optional<std::filesystem::path> take(std::filesystem::path file);

  bool open_ = false, allFiles_ = false;
  FilePurpose purpose_ = FilePurpose::open;
  std::filesystem::path folder_;
  std::vector<std::string> extensions_;
  std::vector<FileRow> rows_;
  int marked_ = -1, first_ = -1;  // the latter: where extending began
  std::vector<std::string> taken_;
  std::string message_;
  std::filesystem::path replaced_;  // asked about
};

}  // namespace vasa::viewer
