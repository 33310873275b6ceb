#include "surface/kept_table.h"

#include "core/bytes.h"
#include "core/kept.h"

namespace vasa {
namespace {

constexpr const char* kKind = "surface";

// Caps have gaps between their members: they are kept as twice the sweep, and one for its last ring.
std::vector<std::uint32_t> packed(std::span<const CapEnd> caps) {
  std::vector<std::uint32_t> ends;
  for (const CapEnd& cap : caps) ends.push_back(2 * cap.sweep + cap.last);
  return ends;
}

// Calls visit with every other list and number of a table, always in the same order.
template <class Table, class Visit>
bool visitAll(Table& table, const Visit& visit) {
  auto& patches = table.patches;
  return visit(table.sweeps) && visit(table.vesselOfSweep) && visit(table.spanOfSweep) &&
         visit(table.forks) && visit(table.branches) && visit(table.vesselOfFork) &&
         visit(table.spanOfFork) && visit(patches.patches) && visit(patches.seams) &&
         visit(patches.vertices) && visit(patches.shares) && visit(patches.triangles) &&
         visit(patches.firstFan) && visit(patches.fans) && visit(table.pointCount) &&
         visit(table.knotCount) && visit(table.spanCount) && visit(table.ways.of) && visit(table.ways.apart);
}

}  // namespace

std::optional<SweepTable> findTable(std::uint64_t key) {
  const auto kept = findKept(kKind, key);
  if (!kept) return {};
  ByteReader in(*kept);
  SweepTable table;
  std::vector<std::uint32_t> ends;
  const bool whole = in.takeAll(ends) && visitAll(table, [&](auto& part) {
                       if constexpr (requires { part.size(); })
                         return in.takeAll(part);
                       else
                         return in.take(part);
                     });
  for (const std::uint32_t end : ends) table.caps.push_back({end / 2, end % 2 == 1});
  return whole && in.rest().empty() ? std::optional(std::move(table)) : std::nullopt;
}

void keepTable(std::uint64_t key, const SweepTable& table) {
  ByteWriter out;
  out.addAll(std::span<const std::uint32_t>(packed(table.caps)));
  visitAll(table, [&](const auto& part) {
    if constexpr (requires { part.size(); })
      out.addAll(std::span(part));
    else
      out.add(part);
    return true;
  });
  keep(kKind, key, out.bytes());
}

}  // namespace vasa
