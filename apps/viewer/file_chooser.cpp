#include "viewer/file_chooser.h"

#include <algorithm>
#include <cstdlib>

#include "core/letters.h"

namespace vasa::viewer {
namespace {

bool beginsWith(const std::string& name, const std::string& start) {
  return lowerCase(name).starts_with(lowerCase(start));
}

// "~/x" as shells have it; relative ones from a folder.
std::filesystem::path resolved(const std::string& typed, const std::filesystem::path& folder) {
  const char* home = std::getenv("HOME");
  if (home && (typed == "~" || typed.starts_with("~/")))
    return std::filesystem::path(home) / typed.substr(std::min<std::size_t>(2, typed.size()));
  return (folder / typed).lexically_normal();
}

}  // namespace

Result<std::vector<FileRow>> rowsOfFolder(const std::filesystem::path& folder,
                                          const std::vector<std::string>& extensions) {
  std::error_code error;
  std::filesystem::directory_iterator entries(folder, error);
  if (error) return ioError(folder.string() + ": cannot be read: " + error.message());
  std::vector<FileRow> rows;
  if (folder.has_relative_path()) rows.push_back({"..", true});
  for (; entries != std::filesystem::directory_iterator(); entries.increment(error)) {
    if (error) break;
    std::error_code unknown;  // links that lead nowhere are no files
    FileRow row{entries->path().filename().string(), entries->is_directory(unknown)};
    if (row.name.starts_with('.')) continue;
    if (!row.folder) {
      if (!entries->is_regular_file(unknown)) continue;
      const std::string extension = lowerCase(entries->path().extension().string());
      if (!extensions.empty() && std::ranges::find(extensions, extension) == extensions.end()) continue;
      row.bytes = entries->file_size(unknown);
    }
    rows.push_back(std::move(row));
  }
  std::ranges::sort(rows, {}, [](const FileRow& row) {
    return std::tuple(row.name != "..", !row.folder, lowerCase(row.name), row.name);
  });
  return rows;
}

void FileChooser::start(FilePurpose purpose, const std::filesystem::path& folder, std::string name,
                        std::vector<std::string> extensions) {
  purpose_ = purpose;
  extensions_ = std::move(extensions);
  allFiles_ = false;
  open_ = true;
  replaced_.clear();
  std::error_code ignored;
  const auto whole = std::filesystem::absolute(folder.empty() ? "." : folder, ignored).lexically_normal();
  go(whole);
  typed = std::move(name);
}

void FileChooser::list() {
  auto rows = rowsOfFolder(folder_, allFiles_ ? std::vector<std::string>{} : extensions_);
  message_ = rows ? "" : rows.error().message;
  rows_ = rows ? std::move(*rows) : std::vector<FileRow>{{"..", true}};
  marked_ = first_ = -1;
  taken_.clear();
}

void FileChooser::go(const std::filesystem::path& folder) {
  folder_ = folder;
  // "/a/b/" is the folder "/a/b".
  if (!folder_.has_filename() && folder_.has_relative_path()) folder_ = folder_.parent_path();
  if (purpose_ == FilePurpose::open) typed.clear();
  list();
}

void FileChooser::showAllFiles(bool all) {
  allFiles_ = all;
  list();
}

void FileChooser::setExtensions(std::vector<std::string> extensions) {
  extensions_ = std::move(extensions);
  typed = std::filesystem::path(typed).replace_extension(extensions_.front()).string();
  list();
}

void FileChooser::mark(int row) {
  marked_ = first_ = row;
  taken_.clear();
  message_.clear();
  replaced_.clear();
  if (purpose_ != FilePurpose::open && row >= 0 && !rows_[std::size_t(row)].folder)
    typed = rows_[std::size_t(row)].name;
}

void FileChooser::step(int way) {
  if (!rows_.empty()) mark(stepped(way));
}

int FileChooser::stepped(int way) const {
  const int from = marked_ < 0 ? (way > 0 ? -1 : int(rows_.size())) : marked_;
  return std::clamp(from + way, 0, int(rows_.size()) - 1);
}

bool FileChooser::isTaken(int row) const {
  return std::ranges::find(taken_, rows_[std::size_t(row)].name) != taken_.end();
}

void FileChooser::toggle(int row) {
  if (purpose_ != FilePurpose::open || rows_[std::size_t(row)].folder) return mark(row);
  // The line that was marked alone is one of them.
  if (taken_.empty() && marked_ >= 0 && marked_ != row && !rows_[std::size_t(marked_)].folder)
    taken_.push_back(rows_[std::size_t(marked_)].name);
  const bool out = isTaken(row);
  if (out)
    std::erase(taken_, rows_[std::size_t(row)].name);
  else
    taken_.push_back(rows_[std::size_t(row)].name);
  marked_ = first_ = out ? -1 : row;
  message_.clear();
}

void FileChooser::extend(int row) {
  if (purpose_ != FilePurpose::open || first_ < 0) return mark(row);
  taken_.clear();
  for (int r = std::min(first_, row); r <= std::max(first_, row); ++r)
    if (const FileRow& each = rows_[std::size_t(r)]; !each.folder) taken_.push_back(each.name);
  marked_ = row;
  message_.clear();
}

void FileChooser::extendStep(int way) {
  if (!rows_.empty()) extend(stepped(way));
}

std::vector<std::filesystem::path> FileChooser::withOthers(const std::filesystem::path& file) const {
  std::vector<std::filesystem::path> all{file};
  for (const std::string& name : taken_)
    if (folder_ / name != file) all.push_back(folder_ / name);
  return all;
}

void FileChooser::typing() {
  message_.clear();
  replaced_.clear();
  marked_ = first_ = -1;
  taken_.clear();
  if (typed.empty() || purpose_ != FilePurpose::open) return;
  const auto found =
      std::ranges::find_if(rows_, [&](const FileRow& row) { return beginsWith(row.name, typed); });
  if (found != rows_.end()) marked_ = int(found - rows_.begin());
}

std::string FileChooser::completed() const {
  std::optional<std::string> common;
  bool folder = false;
  for (const FileRow& row : rows_) {
    if (row.name == ".." || !beginsWith(row.name, typed)) continue;
    folder = !common && row.folder;
    if (!common) common = row.name;
    const auto ends = std::ranges::mismatch(*common, row.name);
    common->erase(ends.in1, common->end());
  }
  if (!common || common->size() < typed.size()) return typed;
  return *common + (folder ? "/" : "");
}

std::optional<std::filesystem::path> FileChooser::enter() {
  std::error_code ignored;
  // All lines may have been taken out again but for some that are not marked.
  if (marked_ < 0 && !taken_.empty())
    marked_ = int(std::ranges::find(rows_, taken_.front(), &FileRow::name) - rows_.begin());
  const auto written = resolved(typed, folder_);
  const bool there = !typed.empty() && std::filesystem::exists(written, ignored);
  const bool byRow = marked_ >= 0 && (!there || purpose_ != FilePurpose::open);
  if (!byRow && typed.empty()) return std::nullopt;
  const std::string row = byRow ? rows_[std::size_t(marked_)].name : "";
  auto meant = byRow ? (row == ".." ? folder_.parent_path() : folder_ / row) : written;
  if (!std::filesystem::is_directory(meant, ignored)) return take(std::move(meant));
  go(meant);
  if (!byRow) typed.clear();
  return std::nullopt;
}

std::optional<std::filesystem::path> FileChooser::take(std::filesystem::path file) {
  std::error_code ignored;
  if (purpose_ == FilePurpose::open) {
    if (!std::filesystem::exists(file, ignored)) {
      message_ = file.string() + ": there is no such file";
      return std::nullopt;
    }
  } else {
    // Another kind of scene cannot be opened again; what is exported says by its name what it is.
    const bool known =
        std::ranges::find(extensions_, lowerCase(file.extension().string())) != extensions_.end();
    if (!known && (purpose_ == FilePurpose::saveScene || !file.has_extension())) file += extensions_.front();
    if (!std::filesystem::is_directory(file.parent_path(), ignored)) {
      message_ = file.parent_path().string() + ": there is no such folder";
      return std::nullopt;
    }
    if (std::filesystem::exists(file, ignored) && replaced_ != file) {
      replaced_ = file;
      message_ = file.filename().string() + " is there already: once more replaces it";
      return std::nullopt;
    }
  }
  open_ = false;
  return file;
}

}  // namespace vasa::viewer
