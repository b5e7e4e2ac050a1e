/// FEBio's codes for the equation of a degree of freedom: that of a prescribed value is -equation - 2, and -1 means
/// none.
#pragma once

/// The code of a prescribed value for an equation, and back: the map is its own inverse.
inline int prescribed(int equation) { return -equation - 2; }

/// The equation behind a code, free or prescribed; -1 where there is none.
inline int equation_of(int id) { return id < -1 ? prescribed(id) : id; }
