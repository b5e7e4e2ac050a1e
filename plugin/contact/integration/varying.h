/// Numbers and vectors with their exact first variations beside them.
///
/// Variations are taken with the nodal positions of a pair of facets, three columns per node. Where only values are
/// wanted the variations have no columns, and all operations on them are empty.
#pragma once

#include "base/types.h"

namespace mixture_contact {

/// A value with R components and its variation.
template <class Value, int R>
struct Varying {
  Value value{};
  PairVariation<R> variation;
};

using VaryingNumber = Varying<double, 1>;
/// A point or vector.
using VaryingVector = Varying<Vector3d, 3>;

template <class Value, int R>
Varying<Value, R> operator+(const Varying<Value, R>& one, const Varying<Value, R>& two) {
  return {one.value + two.value, one.variation + two.variation};
}

template <class Value, int R>
Varying<Value, R> operator-(const Varying<Value, R>& one, const Varying<Value, R>& two) {
  return {one.value - two.value, one.variation - two.variation};
}

template <class Value, int R>
Varying<Value, R> operator*(double factor, const Varying<Value, R>& varying) {
  return {factor * varying.value, factor * varying.variation};
}

template <class Value, int R>
Varying<Value, R> operator*(const VaryingNumber& factor, const Varying<Value, R>& varying) {
  return {factor.value * varying.value, factor.value * varying.variation + varying.value * factor.variation};
}

VaryingNumber operator/(const VaryingNumber& one, const VaryingNumber& two);
/// The root of a positive number.
VaryingNumber sqrt(const VaryingNumber& number);

/// n.(a x b): of two edges of a triangle twice its area seen along -n, positive where they turn counter-clockwise.
VaryingNumber triple(const VaryingVector& n, const VaryingVector& a, const VaryingVector& b);

/// A vector over its length.
VaryingVector normalized(const VaryingVector& vector);

}  // namespace mixture_contact
