/// The two surfaces of a contact.
#pragma once

#include <array>
#include <cstddef>

namespace mixture_contact {

/// The two surfaces of a contact, in the host's order.
enum class Side { primary = 0, secondary = 1 };
inline constexpr std::array<Side, 2> both_sides{Side::primary, Side::secondary};

/// One value for each surface of a contact.
template <class T>
class PerSide : public std::array<T, 2> {
 public:
  T& operator[](Side side) { return this->at(static_cast<std::size_t>(side)); }
  const T& operator[](Side side) const { return this->at(static_cast<std::size_t>(side)); }
};

/// The opposite side.
inline Side other(Side side) { return side == Side::primary ? Side::secondary : Side::primary; }

/// References to the data of both surfaces in one pass: of the primary surface, over which the pass integrates, and of
/// the secondary surface, which faces it.
template <class T>
struct Facing {
  const T& primary;
  const T& secondary;
};

/// The data of both surfaces as the pass over a side uses them: `side` is the primary surface of the pass.
template <class T>
Facing<T> seen_from(Side side, const PerSide<T>& both) {
  return {both[side], both[other(side)]};
}

}  // namespace mixture_contact
