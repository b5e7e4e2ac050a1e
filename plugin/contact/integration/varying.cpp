#include "integration/varying.h"

#include <Eigen/Geometry>

#include <cmath>

namespace mixture_contact {

VaryingNumber operator/(const VaryingNumber& one, const VaryingNumber& two) {
  const double ratio = one.value / two.value;
  return {ratio, (one.variation - ratio * two.variation) / two.value};
}

VaryingNumber sqrt(const VaryingNumber& number) {
  const double root = std::sqrt(number.value);
  return {root, number.variation / (2 * root)};
}

VaryingNumber triple(const VaryingVector& n, const VaryingVector& a, const VaryingVector& b) {
  const Vector3d ab = a.value.cross(b.value);
  const Vector3d bn = b.value.cross(n.value);
  const Vector3d na = n.value.cross(a.value);
  return {n.value.dot(ab), ab.transpose() * n.variation + bn.transpose() * a.variation + na.transpose() * b.variation};
}

VaryingVector normalized(const VaryingVector& vector) {
  const double length = vector.value.norm();
  const Vector3d unit = vector.value / length;
  return {unit, (vector.variation - unit * (unit.transpose() * vector.variation)) / length};
}

}  // namespace mixture_contact
