#pragma once
#include <span>
#include <utility>
#include <vector>

namespace vasa {

/// Merges two sorted parts of a row in place; what is equal keeps its order. std::inplace_merge allocates.
/// @param middle  where the second part begins
/// @param room    kept by the caller, so that only more than ever before allocates
template <class T, class Less>
void mergeInPlace(std::span<T> row, std::size_t middle, std::vector<T>& room, const Less& less) {
  if (middle == 0 || middle == row.size() || !less(row[middle], row[middle - 1])) return;
  room.assign(row.begin(), row.begin() + std::ptrdiff_t(middle));
  std::size_t first = 0, second = middle, out = 0;
  while (first < middle)
    row[out++] = second < row.size() && less(row[second], room[first]) ? std::move(row[second++])
                                                                       : std::move(room[first++]);
}

/// As std::stable_sort, which allocates.
template <class T, class Less>
void stableSort(std::span<T> row, std::vector<T>& room, const Less& less) {
  if (row.size() < 2) return;
  const std::size_t middle = row.size() / 2;
  stableSort(row.first(middle), room, less);
  stableSort(row.subspan(middle), room, less);
  mergeInPlace(row, middle, room, less);
}

}  // namespace vasa
