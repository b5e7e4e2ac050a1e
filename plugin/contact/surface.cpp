#include "surface.h"

namespace mixture_contact {

double half_diagonal(const Matrix3Xd& position) {
  return 0.5 * (position.rowwise().maxCoeff() - position.rowwise().minCoeff()).norm();
}

}  // namespace mixture_contact
