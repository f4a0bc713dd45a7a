#include "circlepoint/core/instruction_set.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdlib>
#include <string>

#include "circlepoint/core/error.hpp"

namespace circlepoint {
namespace {

constexpr std::array all_paths{InstructionSet::baseline, InstructionSet::avx2, InstructionSet::avx512};

bool runs(InstructionSet path) {
#ifdef __x86_64__
  switch (path) {
    case InstructionSet::baseline: return true;
    case InstructionSet::avx2: return __builtin_cpu_supports("avx2") != 0;
    case InstructionSet::avx512:
      return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("avx512f") != 0 &&
             __builtin_cpu_supports("avx512vl") != 0;
  }
  return false;
#else
  return path == InstructionSet::baseline;
#endif
}

std::string names(const std::vector<InstructionSet>& paths) {
  std::string text;
  for (const InstructionSet path : paths) {
    text += (text.empty() ? "" : ", ") + std::string(to_string(path));
  }
  return text;
}

void require_runs(InstructionSet path, const std::string& from) {
  require(runs(path), from + " asks for the instruction set '" + std::string(to_string(path)) +
                          "', which this processor does not have; it runs " + names(available_instruction_sets()));
}

InstructionSet first_choice() {
  const char* wanted = std::getenv("CIRCLEPOINT_INSTRUCTION_SET");
  if (wanted == nullptr || *wanted == '\0') {
    return available_instruction_sets().back();
  }
  const auto found = std::find_if(all_paths.begin(), all_paths.end(), [&](auto path) { return to_string(path) == wanted; });
  require(found != all_paths.end(), "CIRCLEPOINT_INSTRUCTION_SET is '" + std::string(wanted) + "'; give one of " +
                                        names(available_instruction_sets()) + ", or unset it");
  require_runs(*found, "CIRCLEPOINT_INSTRUCTION_SET");
  return *found;
}

std::atomic<InstructionSet>& choice() {
  static std::atomic<InstructionSet> chosen{first_choice()};
  return chosen;
}

}  // namespace

std::vector<InstructionSet> available_instruction_sets() {
  std::vector<InstructionSet> paths;
  std::copy_if(all_paths.begin(), all_paths.end(), std::back_inserter(paths), runs);
  return paths;
}

InstructionSet instruction_set() { return choice().load(std::memory_order_relaxed); }

void use_instruction_set(InstructionSet path) {
  require_runs(path, "the caller");
  choice().store(path, std::memory_order_relaxed);
}

std::string_view to_string(InstructionSet path) {
  constexpr std::array<std::string_view, 3> texts{"baseline", "avx2", "avx512"};
  return texts[static_cast<std::size_t>(path)];
}

}  // namespace circlepoint
