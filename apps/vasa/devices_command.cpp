#include <fmt/format.h>

#include <bit>
#include <optional>

#include "commands.h"
#include "gpu/adapter.h"
#include "gpu/error.h"
#include "report.h"

// vasa devices: the Vulkan devices of this machine and what each lacks. Ends with "no usable device" where
// none can be used, after the list of them.
namespace vasa::cli {
namespace devices_command {

struct Listing {
  std::vector<gpu::Adapter> adapters;
  std::optional<std::size_t> chosen;  // what --device, or its absence, picks
  Error refusal;                      // why nothing is chosen
};

Result<Listing> list(const std::string& choice) {
  auto adapters = gpu::attempt([] { return gpu::listAdapters(); });
  if (!adapters) return adapters.error();
  Listing listing{std::move(*adapters), {}, {}};
  const auto chosen = gpu::attempt([&] { return gpu::chooseAdapter(listing.adapters, choice); });
  if (chosen)
    listing.chosen = *chosen;
  else
    listing.refusal = chosen.error();
  return listing;
}

Report limitsOf(const gpu::Adapter& adapter) {
  const VkPhysicalDeviceLimits& limits = adapter.limits;
  return {{"workgroup_invocations", limits.maxComputeWorkGroupInvocations},
          {"subgroup", adapter.subgroup},
          {"push_constant_bytes", limits.maxPushConstantsSize},
          {"bound_sets", limits.maxBoundDescriptorSets},
          {"sub_pixel_bits", limits.subPixelPrecisionBits},
          {"most_samples",
           std::bit_floor(limits.framebufferColorSampleCounts & limits.framebufferDepthSampleCounts)},
          {"image_side", limits.maxImageDimension2D},
          {"heap_bytes", adapter.largestHeap}};
}

Report asReport(const Listing& listing) {
  Report devices = Report::array();
  for (std::size_t i = 0; i < listing.adapters.size(); ++i) {
    const gpu::Adapter& adapter = listing.adapters[i];
    devices.push_back({{"index", adapter.index},
                       {"name", adapter.name},
                       {"type", gpu::typeName(adapter.type)},
                       {"api", adapter.api},
                       {"driver", adapter.driver},
                       {"usable", adapter.usable()},
                       {"lacks", adapter.lacks},
                       {"without", adapter.without},
                       {"limits", limitsOf(adapter)},
                       {"chosen", listing.chosen == i}});
  }
  return {{"devices", std::move(devices)}};
}

std::string asTable(const Listing& listing) {
  std::size_t nameWidth = 4, driverWidth = 6;
  for (const gpu::Adapter& adapter : listing.adapters) {
    nameWidth = std::max(nameWidth, adapter.name.size());
    driverWidth = std::max(driverWidth, adapter.driver.size());
  }
  const auto row = [&](const auto& index, const auto& name, const auto& type, const auto& api,
                       const auto& driver, const auto& lacks) {
    return fmt::format("{:<7}{:<{}}  {:<10}  {:<9}  {:<{}}  {}\n", index, name, nameWidth, type, api, driver,
                       driverWidth, lacks);
  };
  std::string text = row("index", "name", "type", "api", "driver", "lacks");
  for (std::size_t i = 0; i < listing.adapters.size(); ++i) {
    const gpu::Adapter& adapter = listing.adapters[i];
    const std::string lacks =
        adapter.usable() ? "nothing" : fmt::format("{}", fmt::join(adapter.lacks, ", "));
    text += row(fmt::format("{}{}", adapter.index, listing.chosen == i ? " *" : ""), adapter.name,
                gpu::typeName(adapter.type), adapter.api, adapter.driver, lacks);
    text += fmt::format(
        "       workgroups of {}, subgroups of {}, {} bytes of push constants, {} sub-pixel bits, pictures up to {} pixels, {} MiB\n",
        adapter.limits.maxComputeWorkGroupInvocations, adapter.subgroup, adapter.limits.maxPushConstantsSize,
        adapter.limits.subPixelPrecisionBits, adapter.limits.maxImageDimension2D, adapter.largestHeap >> 20);
    if (!adapter.without.empty())
      text += fmt::format("       does without {}\n", fmt::join(adapter.without, ", "));
  }
  return text;
}

Result<void> run(const Globals& globals) {
  const auto listing = list(globals.device);
  if (!listing) return listing.error();
  auto printed = globals.json ? printJson(asReport(*listing)) : printText(asTable(*listing));
  if (!printed) return printed;
  if (!listing->chosen) return listing->refusal;
  return {};
}

}  // namespace devices_command

void addDevices(CLI::App& app, Command& command) {
  using namespace devices_command;
  CLI::App* devices = app.add_subcommand("devices", "Vulkan devices, and what each lacks");
  devices->footer(
      "Examples:\n  vasa devices\n  vasa devices --json --device llvmpipe\n"
      "An asterisk marks the device that other commands use.");
  devices->callback([&command] { command.run = [&command] { return run(command.globals); }; });
}

}  // namespace vasa::cli
