#include "columns.h"

#include <charconv>
#include <cstring>

namespace standalone {
namespace {

/// 0, 1, 2 for x, y, z.
std::optional<int> axis(const std::string& name, std::size_t at) {
  constexpr const char* axes = "xyz";
  const char* found = at + 1 == name.size() ? std::strchr(axes, name[at]) : nullptr;
  return found != nullptr ? std::optional<int>(static_cast<int>(found - axes)) : std::nullopt;
}

/// Index of the solute whose number, from 1, is all of a text.
std::optional<int> solute(const std::string& number, int solutes) {
  int value = 0;
  const auto end = number.data() + number.size();
  const auto result = std::from_chars(number.data(), end, value);
  if (result.ec != std::errc() || result.ptr != end || value < 1 || value > solutes) return std::nullopt;
  return value - 1;
}

}  // namespace

std::optional<NodeColumn> node_column(const std::string& name, int solutes) {
  using Kind = NodeColumn::Kind;
  if (name == "p") return NodeColumn{Kind::value, pressure_dof};
  if (const auto i = axis(name, 0)) return NodeColumn{Kind::position, *i};
  if (const auto i = axis(name, 1); i && name[0] == 'u') return NodeColumn{Kind::value, *i};
  if (const auto i = axis(name, 1); i && name[0] == 'R') return NodeColumn{Kind::reaction, *i};
  if (name.empty() || name[0] != 'c') return std::nullopt;
  const auto k = solute(name.substr(1), solutes);
  return k ? std::optional<NodeColumn>({Kind::value, concentration_dof(*k)}) : std::nullopt;
}

std::optional<ElementColumn> element_column(const std::string& name, int solutes) {
  using Kind = ElementColumn::Kind;
  if (name.empty()) return std::nullopt;
  if (name == "p") return ElementColumn{Kind::pressure, 0, 0};
  if (const auto i = axis(name, 1)) {
    if (name[0] == 'w') return ElementColumn{Kind::solvent_flux, 0, *i};
    if (name[0] == 's') return ElementColumn{Kind::stress, 0, *i};
    if (name[0] == 'j' && solutes > 0) return ElementColumn{Kind::solute_flux, 0, *i};
  }
  if (name == "c" && solutes > 0) return ElementColumn{Kind::concentration, 0, 0};
  if (name[0] == 'c') {
    const auto k = solute(name.substr(1), solutes);
    return k ? std::optional<ElementColumn>({Kind::concentration, *k, 0}) : std::nullopt;
  }
  const auto k = solute(name.substr(1, name.size() - 2), solutes);
  const auto i = axis(name, name.size() - 1);
  return name[0] == 'j' && k && i ? std::optional<ElementColumn>({Kind::solute_flux, *k, *i}) : std::nullopt;
}

}  // namespace standalone
