/// Numbers and vectors with their exact first variations beside them.
///
/// Variations are taken with the nodal positions of a pair of facets, three columns per node. Where only values are
/// wanted the variations have no columns, and all operations on them are empty.
#pragma once

#include "types.h"

namespace mixture_contact {

/// A number with its variation.
struct VaryingNumber {
  double value = 0;
  PairVariation<1> variation;
};

/// A point or vector with its variation.
struct VaryingVector {
  Vector3d value{0, 0, 0};
  PairVariation<3> variation;
};

VaryingNumber operator+(const VaryingNumber& one, const VaryingNumber& two);
VaryingNumber operator-(const VaryingNumber& one, const VaryingNumber& two);
VaryingNumber operator*(double factor, const VaryingNumber& number);
VaryingNumber operator*(const VaryingNumber& one, const VaryingNumber& two);
VaryingNumber operator/(const VaryingNumber& one, const VaryingNumber& two);
/// The root of a positive number.
VaryingNumber sqrt(const VaryingNumber& number);

VaryingVector operator+(const VaryingVector& one, const VaryingVector& two);
VaryingVector operator-(const VaryingVector& one, const VaryingVector& two);
VaryingVector operator*(double factor, const VaryingVector& vector);
VaryingVector operator*(const VaryingNumber& factor, const VaryingVector& vector);

/// n.(a x b): of two edges of a triangle twice its area seen along -n, positive where they turn counter-clockwise.
VaryingNumber triple(const VaryingVector& n, const VaryingVector& a, const VaryingVector& b);

/// A vector over its length.
VaryingVector normalized(const VaryingVector& vector);

}  // namespace mixture_contact
