#pragma once
#include <cstdint>
#include <optional>

#include "surface/sweep_table.h"

namespace vasa {

/// makeSweepTable() of the network with this key (network/network_key.h) as an earlier run kept it
/// (core/kept.h); nothing where there is none.
std::optional<SweepTable> findTable(std::uint64_t key);
void keepTable(std::uint64_t key, const SweepTable& table);

}  // namespace vasa
